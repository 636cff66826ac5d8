#!/usr/bin/python3
"""What RUN directories and outputs survive: other people's files, other scenes, damage, and wrong names.

run_directory_test.py ENFILADE [unittest arguments]"""
import json
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import cli_test
from cli_test import ROOM, ROOT, InScratch, enfilade, put, said


def contents(directory):
    return {str(p.relative_to(directory)): p.read_bytes() for p in Path(directory).rglob("*") if p.is_file()}


def faults(result):
    """Errors, and warnings of anything but the room's extra keys."""
    return [line for line in said(result) if "unknown keys" not in line]


def solve(scene, run, *options, **how):
    return enfilade("solve", scene, "-o", run, "--no-pictures", "--target-error", "0.2", *options, **how)


class InRun(InScratch):
    """A solved run of the room in a directory of its own; made once."""

    @classmethod
    def setUpClass(cls):
        cls.kept = Path(cli_test.tempfile.mkdtemp(prefix="enfilade-cli-run-"))
        cls.addClassCleanup(shutil.rmtree, cls.kept, ignore_errors=True)
        result = solve(ROOM, cls.kept / "run")
        assert result.returncode == 0, result.stderr

    def setUp(self):
        super().setUp()
        self.run_directory = self.scratch / "run"
        shutil.copytree(self.kept / "run", self.run_directory)

    def assert_failed(self, result, *words):
        """Exit status 1 and one line that says where and what to do."""
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(len(faults(result)), 1, result.stderr)
        for word in (*words, "; "):
            self.assertIn(word, faults(result)[0])


class OwnFiles(InRun):
    def test_a_directory_of_somebody_else_is_left_alone(self):
        for name in ("pictures/me.png", "common/a", "local/b", "scene.json", "run.json"):
            mine = self.scratch / "mine"
            (mine / name).parent.mkdir(parents=True)
            (mine / name).write_text("{}")
            for command in ("prepare", "solve"):
                with self.subTest(name, command=command):
                    self.assert_refused(enfilade(command, ROOM, "-o", mine), str(mine), "no RUN directory")
                    self.assertEqual(contents(mine), {name: b"{}"})
            shutil.rmtree(mine)

    def test_an_empty_directory_and_a_run_are_filled(self):
        empty = self.scratch / "empty"
        empty.mkdir()
        for run in (empty, empty, self.run_directory):
            result = enfilade("prepare", ROOM, "-o", run)
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_preparation_that_was_killed_can_be_done_again(self):
        (self.run_directory / "run.json").write_text('{"format": "enfilade-run", "version": 1, "prepared": false}')
        shutil.rmtree(self.run_directory / "common")
        self.assert_refused(enfilade("info", self.run_directory), "enfilade prepare")
        self.assertEqual(solve(ROOM, self.run_directory, "--resume").returncode, 0)

    def test_resume_with_another_scene_keeps_the_solution(self):
        other = self.scene(put([0.31], "surfaces", 0, "reflectance"))
        before = contents(self.run_directory)
        self.assert_refused(solve(other, self.run_directory, "--resume"), "another scene", "without --resume")
        self.assertEqual(contents(self.run_directory), before)
        self.assertEqual(solve(ROOM, self.run_directory, "--resume").returncode, 0)

    def test_prepare_takes_the_outputs_of_the_old_solution_away(self):
        (self.run_directory / "notes.txt").write_text("mine")
        (self.run_directory / "pictures").mkdir()
        (self.run_directory / "pictures/storey-1-assignment.svg").write_text("of the old solution")
        self.assertEqual(enfilade("prepare", ROOM, "-o", self.run_directory).returncode, 0)
        self.assertEqual(sorted(p.name for p in self.run_directory.iterdir()),
                         ["cells.bin", "clusters.bin", "graph.bin", "leaks.json", "lock", "notes.txt", "pictures", "run.json",
                          "scene.json"])
        self.assertEqual(sorted(p.name for p in (self.run_directory / "pictures").iterdir()),
                         ["storey-1-cells.png", "storey-1-cells.svg"])

    def test_the_scene_is_kept_to_the_byte(self):
        self.assertEqual((self.run_directory / "scene.json").read_bytes(), ROOM.read_bytes())


class SaidAgain(InRun):
    def test_warnings_of_the_scene_stay_with_its_run(self):
        scene, run = ROOT / "tests/data/scene/duplicate_polygon.json", self.scratch / "warned"
        first = solve(scene, run)
        kept = json.loads((run / "warnings.json").read_text())
        self.assertTrue(any("floor_dup" in line for line in kept), kept)
        for again in (solve(scene, run), enfilade("solve", run, "--no-pictures", "--target-error", "0.2")):
            self.assertEqual(said(again), said(first))
            self.assertEqual(json.loads((run / "warnings.json").read_text()), kept)

    def test_giving_up_is_told_with_the_estimate_and_the_remedy(self):
        run = self.scratch / "hasty"
        result = enfilade("solve", ROOM, "-o", run, "--no-pictures", "--quiet", "--max-iterations", "2")
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertEqual(len(faults(result)), 1, result.stderr)
        self.assertRegex(faults(result)[0], r"warning: .*2 iterations.*estimated error .*%.*, asked 2%.*--max-iterations")
        self.assertIn("--max-iterations", (run / "warnings.json").read_text())
        more = enfilade("solve", run, "--no-pictures", "--quiet", "--resume")
        self.assertEqual((more.returncode, faults(more)), (0, []))

    def test_probe_answers_have_one_unit(self):
        points, answer = self.scratch / "points.json", self.scratch / "answer.json"
        points.write_text('{"exitanceUnits": "W/m2", "note": 1, "probes": [{"p": [2, 1.5, 0], "n": [0, 0, 1]}]}')
        result = enfilade("probe", self.run_directory, "--points", points, "-o", answer)
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(answer.read_text())
        self.assertEqual([document[k] for k in ("exitanceUnits", "unit", "note")], ["lm/m2", "lx", 1])


class Damage(InRun):
    def test_a_mark_that_is_none(self):
        for text in ('{"format":3}', "[]", "{", '{"format": "enfilade-run"}', '{"format": "enfilade-run", "version": 1e999}'):
            (self.run_directory / "run.json").write_text(text)
            with self.subTest(text):
                self.assert_refused(enfilade("solve", self.run_directory), "run.json", "enfilade prepare")
                self.assert_refused(solve(ROOM, self.run_directory, "--resume"))
                self.assertTrue((self.run_directory / "common/manifest.json").exists())

    def test_files_that_are_cut_off_are_named(self):
        for name in ("clusters.bin", "cells.bin", "graph.bin"):
            path = self.run_directory / name
            whole = path.read_bytes()
            path.write_bytes(whole[:len(whole) // 2])
            with self.subTest(name):
                self.assert_failed(enfilade("solve", self.run_directory, "--resume"), str(path), "prepare the run again")
            path.write_bytes(whole)

    def test_one_bit_that_is_wrong_is_told(self):
        for name in ("clusters.bin", "cells.bin"):
            path = self.run_directory / name
            whole = path.read_bytes()
            for at in (len(whole) // 3, len(whole) // 2, len(whole) - 1):
                path.write_bytes(whole[:at] + bytes([whole[at] ^ 0x40]) + whole[at + 1:])
                with self.subTest(f"{name}, byte {at}"):
                    self.assert_failed(enfilade("info", self.run_directory), str(path), "prepare the run again")
            path.write_bytes(whole)

    def test_a_damaged_manifest_is_told_once_on_any_ranks(self):
        manifest = self.run_directory / "common/manifest.json"
        for text in ("{", "{}", manifest.read_text().replace('"history":[[', '"history":[[1],[')):
            manifest.write_text(text)
            with self.subTest(text[:20]):
                result = enfilade("solve", self.run_directory, "--resume", ranks=3, timeout=60)
                self.assert_failed(result, "solve again without --resume")
                self.assertTrue((self.run_directory / "stats.json").exists())

    def test_a_run_of_another_version_is_named_so(self):
        manifest = self.run_directory / "common/manifest.json"
        manifest.write_text(re.sub(r'"version":[0-9]+', '"version":1', manifest.read_text()))
        self.assert_failed(enfilade("solve", self.run_directory, "--resume"), str(manifest), "another version of enfilade",
                           "solve again without --resume")

    def test_cost_models_that_are_none(self):
        model = self.scratch / "model.json"
        shipped = (ROOT / "platforms/cost_model.json").read_text()
        for text in ('{"format":3}', "[]", "{", "", shipped.replace('"ray": 3000', '"ray": 1e999')):
            model.write_text(text)
            with self.subTest(text[:20]):
                run = self.scratch / "other"
                self.assert_refused(solve(ROOM, run, "--cost-model", model), str(model))
                self.assertFalse(run.exists())


class WrongNames(InRun):
    def test_a_run_that_cannot_be_made(self):
        (self.scratch / "file").write_text("in the way")
        for run in (self.scratch / "file", self.scratch / "file/run", "/proc/foo", "/dev/null"):
            for command in ("prepare", "solve"):
                with self.subTest(run=str(run), command=command):
                    self.assert_refused(enfilade(command, ROOM, "-o", run), str(run), "name another directory")
        self.assertEqual((self.scratch / "file").read_text(), "in the way")

    def test_a_local_directory_on_another_disk(self):
        other = Path("/dev/shm")
        if not other.is_dir() or other.stat().st_dev == self.scratch.stat().st_dev:
            self.skipTest("no second file system")
        local = Path(cli_test.tempfile.mkdtemp(prefix="enfilade-cli-local-", dir=other))
        self.addCleanup(shutil.rmtree, local, ignore_errors=True)
        for ranks in 1, 2:
            here, there = self.scratch / f"here{ranks}", self.scratch / f"there{ranks}"
            self.assertEqual(solve(ROOM, here, "--no-steal", ranks=ranks).returncode, 0)
            result = solve(ROOM, there, "--no-steal", "--local-dir", local, ranks=ranks)
            self.assertEqual(result.returncode, 0, result.stderr)
            # The runs differ by their own number, which the sections name; their light and links do not.
            sizes = {name: len(data) for name, data in contents(there / "common").items() if "rank-" in name}
            self.assertTrue(sizes)
            self.assertEqual(sizes, {name: len(data) for name, data in contents(here / "common").items()
                                     if "rank-" in name})
            lights = [json.loads((run / "probes.json").read_text()) for run in (here, there)]
            self.assertEqual(*lights)
            self.assertEqual(list(local.iterdir()), [])
            result = enfilade("solve", there, "--resume", "--target-error", "0.1", "--no-pictures", "--no-steal",
                              "--local-dir", local, ranks=ranks)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(list(local.iterdir()), [])

    def test_a_local_directory_that_cannot_be_made(self):
        result = solve(ROOM, self.run_directory, "--local-dir", ROOM)
        self.assert_refused(result, "--local-dir", str(ROOM))

    def test_a_rival_scheme_refuses_what_it_would_not_heed(self):
        self.assert_refused(solve(ROOM, self.run_directory, "--scheme", "master-slave", "--assignment", "metis"), "--assignment")
        self.assert_refused(solve(ROOM, self.run_directory, "--scheme", "replicated", "--order", "random"), "--order")

    def test_a_replay_refuses_what_the_light_depends_on(self):
        for option in (["--target-error", "0.1"], ["--no-coarse-correction"], ["--basis", "constant"]):
            result = enfilade("solve", "--replay", self.run_directory, "-o", self.scratch / "again", *option)
            self.assert_refused(result, option[0], "--replay")

    def test_a_file_that_cannot_be_made(self):
        points = ROOM
        for command, name, *options in [("render", "x.png"), ("export", "x.glb"), ("export", "x.json"), ("report", "x.html"),
                                        ("probe", "x.json", "--points", points), ("locate", "x.json", "--points", points)]:
            (self.scratch / "d" / name).mkdir(parents=True, exist_ok=True)
            for path in (self.scratch / "nosuch" / name, self.scratch / "d" / name):
                with self.subTest(command, path=str(path)):
                    result = enfilade(command, self.run_directory, "-o", path, *options)
                    self.assert_refused(result, str(path), "directory")

    def test_a_run_that_is_not_there(self):
        for options in ([], ["--resume"]):
            result = enfilade("solve", self.scratch / "nosuch", *options)
            self.assert_refused(result, "nosuch", "does not exist")

    def test_a_run_without_rights(self):
        """Root may do everything, so the command runs as somebody else."""
        if os.geteuid() == 0 and not os.access(cli_test.ENFILADE, os.X_OK):
            self.skipTest("the program cannot be run by others")
        self.scratch.chmod(0o755)
        locked = self.scratch / "locked"
        locked.mkdir(mode=0o555)
        other = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        for run in (locked, locked / "run"):
            try:
                result = subprocess.run([cli_test.ENFILADE, "prepare", ROOM, "-o", run], capture_output=True, text=True,
                                        timeout=60, **other)
            except PermissionError:
                self.skipTest("the program cannot be run by others")
            self.assert_refused(result, str(run), "permission")


class Coordinates(InScratch):
    def test_a_vertex_out_of_this_world_is_refused_by_name(self):
        for far in (1e300, -2e9):
            path = self.scene(put(far, "surfaces", 3, "vertices", 1, 0))
            result = enfilade("solve", path, "-o", self.scratch / "run")
            self.assert_refused(result, str(path), 'surfaces[3] "wall north".vertices', "1e9 m")
            self.assertEqual(self.leftovers(path), [])

    def test_a_scene_of_which_nothing_is_left_is_refused(self):
        def flatten(scene):
            for surface in scene["surfaces"]:
                surface["vertices"] = [[1, 1, 1]] * 3
        path = self.scene(flatten)
        self.assert_refused(enfilade("prepare", path, "-o", self.scratch / "run"), str(path), "surfaces", "area")
        self.assertEqual(self.leftovers(path), [])


@unittest.skipUnless(os.environ.get("ENFILADE_SMPI"), "built without SimGrid")
class SimulatedInputs(InScratch):
    def smpirun(self, ranks, *args, platform=None):
        environment = dict(os.environ, PLATFORM=str(platform)) if platform else None
        command = [ROOT / ".ci/smpirun.sh", str(ranks), os.environ["ENFILADE_SMPI"], *map(str, args)]
        return subprocess.run(command, capture_output=True, text=True, timeout=240, cwd=self.scratch, env=environment)

    def test_without_smpirun_it_says_how_to_start_it(self):
        for arguments in ([], ["--help"], ["solve", ROOM, "-o", self.scratch / "run"]):
            result = subprocess.run([os.environ["ENFILADE_SMPI"], *map(str, arguments)], capture_output=True, text=True)
            self.assert_refused(result, "smpirun -platform")

    def test_any_number_of_ranks_finds_hosts(self):
        for ranks in (3, 7):
            result = self.smpirun(ranks, "--version")
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_seek_time_that_is_none_is_refused(self):
        platform = self.scratch / "office.xml"
        text = (ROOT / "platforms/office.xml").read_text()
        for seek in ("soon", "-1", "nan"):
            platform.write_text(text.replace('"seek_s" value="0.0001"', f'"seek_s" value="{seek}"'))
            result = self.smpirun(4, "solve", ROOM, "-o", self.scratch / "run", platform=platform)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertEqual(len(said(result)), 1, result.stderr)
            self.assertIn("server-disk: seek_s", said(result)[0])
            self.assertFalse((self.scratch / "run").exists())

    def test_a_misspelt_property_is_refused(self):
        platform = self.scratch / "office.xml"
        text = (ROOT / "platforms/office.xml").read_text()
        for right, wrong, told in (('id="seek_s"', 'id="seeks"', "did you mean 'seek_s'?"),
                                   ('id="serves"', 'id="server"', "did you mean 'serves'?"),
                                   ('id="serves"', 'id="seek_s"', "put it into the host's <disk>"),
                                   ('value="common"', 'value="comon"', "neither common nor alone")):
            self.assertIn(right, text)
            platform.write_text(text.replace(right, wrong))
            result = self.smpirun(4, "solve", ROOM, "-o", self.scratch / "run", platform=platform)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertEqual(len(said(result)), 1, result.stderr)
            self.assertIn(told, said(result)[0])
            self.assertFalse((self.scratch / "run").exists())

    def test_a_replay_is_not_taken_for_a_run(self):
        run, replayed = self.scratch / "run", self.scratch / "replayed"
        self.assertEqual(solve(ROOM, run).returncode, 0)
        result = self.smpirun(2, "solve", "--replay", run, "-o", replayed, "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        for command in (["info", replayed], ["solve", replayed], ["render", replayed, "-o", self.scratch / "x.png"]):
            with self.subTest(command[0]):
                self.assert_refused(enfilade(*command), str(replayed), "a replay", "name the run that was replayed")


if __name__ == "__main__":
    cli_test.ENFILADE = cli_test.ENFILADE or sys.argv.pop(1)
    unittest.main()
