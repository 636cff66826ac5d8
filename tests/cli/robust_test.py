#!/usr/bin/python3
"""What a file, a disk or a neighbour does ends in a right answer or one line, soon: numbers without reason, deep files,
names that act, planted links, two commands at once, inputs that change, pipes, full outputs, little memory.

robust_test.py ENFILADE [unittest arguments]"""
import csv
import json
import math
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest

import cli_test
from cli_test import ROOM, ROOT, InScratch, enfilade, put, said
from run_directory_test import InRun, contents, solve

SOON_S = 10
CONTROL = "a\x1b]0;title\x07b\nc\u202egnp\u200f\x00d"


def answers(path):
    return [probe["E"] for probe in json.loads(path.read_text())["probes"]]


class Numbers(InRun):
    def probe(self, probes):
        points, answer = self.scratch / "points.json", self.scratch / "answer.json"
        points.write_text(json.dumps({"probes": probes}))
        return enfilade("probe", self.run_directory, "--points", points, "-o", answer, "--rays", "64", timeout=SOON_S), answer

    def test_a_normal_of_any_length_is_a_direction(self):
        lengths = (1.0, 1e300, 1e-300, 5e-324)
        result, answer = self.probe([{"p": [1, 0.8, 0.75], "n": [0, 0, length]} for length in lengths])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(all(math.isclose(e[0], answers(answer)[0][0], rel_tol=0.02) for e in answers(answer)), answers(answer))

    def test_places_beyond_reason_are_refused(self):
        for far in (1e10, -1e20, 1e39, 1e300):
            with self.subTest(far):
                result, answer = self.probe([{"p": [1, far, 0.75], "n": [0, 0, 1]}])
                self.assert_refused(result, "probes[0].p", "1e9 m")
                self.assertFalse(answer.exists())
                points = self.scratch / "points.json"
                self.assert_refused(enfilade("locate", self.run_directory, "--points", points, "-o", answer), "1e9 m")

    def test_cameras_beyond_reason_are_refused(self):
        fine = {"eye": [1, 1, 1], "look_at": [2, 2, 1]}
        for key, value in (("eye", [1, 1e39, 1]), ("look_at", [1e300, 3, 1]), ("up", [0, 0, 0]), ("look_at", [1, 1, 1 + 1e-12]),
                           ("vertical_angle_deg", 1e-300), ("parallel_height_m", 1e300), ("cut_above_m", -1e12)):
            with self.subTest(key, value=value):
                cameras = self.scratch / "cameras.json"
                cameras.write_text(json.dumps({"cameras": [dict(fine, **{key: value})]}))
                result = enfilade("render", self.run_directory, "-o", self.scratch / "x.png", "--cameras", cameras, timeout=SOON_S)
                self.assert_refused(result, "cameras[0]." + key)
        for option, value in (("--eye", "1,1,1e39"), ("--look-at", "1e300,0,0"), ("--up", "0,0,0")):
            options = {"--eye": "1,1,1", "--look-at": "2,2,1", option: value}
            result = enfilade("render", self.run_directory, "-o", self.scratch / "x.png", *sum(options.items(), ()))
            self.assert_refused(result, option)

    def scaled(self, factor):
        def scale(scene):
            for surface in scene["surfaces"]:
                surface["vertices"] = [[factor * c for c in v] for v in surface["vertices"]]
            for thing in scene["probes"] + scene.get("lights", []):
                thing["p"] = [factor * c for c in thing["p"]]
            for light in scene.get("lights", []):
                light["intensity"] = [factor * factor * i for i in light["intensity"]]
        return self.scene(scale)

    def test_a_scene_of_any_size_is_right_or_refused(self):
        want = answers(self.run_directory / "probes.json")
        for factor in (1e-18, 1e-9, 1e-6, 1e7):
            with self.subTest(factor):
                run = self.scratch / f"scaled{factor}"
                result = solve(self.scaled(factor), run)
                if result.returncode == 2:
                    self.assert_refused(result, "surfaces", "1e-6 m")
                    continue
                self.assertEqual(result.returncode, 0, result.stderr)
                for got, expected in zip(answers(run / "probes.json"), want):
                    self.assertAlmostEqual(got[0] / expected[0], 1.0, delta=0.1)

    def test_light_and_lamps_and_probes_of_a_scene(self):
        for change, word in ((put([1e-200], "surfaces", 0, "exitance"), "exitance"),
                             (put([0.5] * 2000, "surfaces", 0, "reflectance"), "bands"),
                             (put([{"type": "point", "p": [0, 0, 1e30], "intensity": [1]}], "lights"), "lights[0].p"),
                             (put([{"type": "point", "p": [0, 0, 1], "intensity": [1e-300]}], "lights"), "lights[0].intensity"),
                             (put([{"p": [1e20, 0, 0], "n": [0, 0, 1]}], "probes"), "probes[0].p")):
            with self.subTest(word):
                self.assert_refused(solve(self.scene(change), self.scratch / "other"), word)


class Files(InRun):
    def test_a_file_that_is_deep_is_refused_by_every_reader(self):
        deep = self.scratch / "deep.json"
        deep.write_text('{"probes": ' + "[" * 100000 + "]" * 100000 + "}")
        out = self.scratch / "out"
        for command in (["info", deep], ["solve", deep, "-o", out], ["generate", deep, "-o", out.with_suffix(".json")],
                        ["probe", self.run_directory, "--points", deep, "-o", out],
                        ["locate", self.run_directory, "--points", deep, "-o", out],
                        ["render", self.run_directory, "--cameras", deep, "-o", out.with_suffix(".png")],
                        ["solve", ROOM, "-o", out, "--cost-model", deep]):
            with self.subTest(command[0]):
                self.assert_refused(enfilade(*command, timeout=SOON_S), str(deep), "100 deep")

    def test_sheets_that_all_cross_each_other_are_prepared_soon(self):
        """In the pockets between them walks find no light; one by one, that took half a minute."""
        rng = random.Random(5)
        scene = json.loads(ROOM.read_text(encoding="utf-8"))
        low, high = ([pick(v[k] for s in scene["surfaces"] for v in s["vertices"]) for k in range(3)] for pick in (min, max))
        middle = [(a + b) / 2 for a, b in zip(low, high)]
        for _ in range(20):
            u, v, shift = ([rng.gauss(0, 0.4) for _ in range(3)] for _ in range(3))
            corners = [[m + a * x + b * y + 0.2 * s for m, x, y, s in zip(middle, u, v, shift)]
                       for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            scene["surfaces"] += [{"vertices": order, "reflectance": 0.5} for order in (corners, corners[::-1])]
        path = self.scratch / "sheets.json"
        path.write_text(json.dumps(scene))
        result = enfilade("prepare", path, "-o", self.scratch / "out", timeout=SOON_S)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_no_reader_speaks_a_librarys_language(self):
        bad, out = self.scratch / "bad.json", self.scratch / "out"
        for text in ('{"probes": [1e999', '{"cameras": [{"eye": "x"}]}', "\u0000", '{"a": 1,}', '"text"', "1e999"):
            bad.write_text(text)
            for command in (["info", bad], ["solve", bad, "-o", out], ["generate", bad, "-o", out.with_suffix(".json")],
                            ["probe", self.run_directory, "--points", bad, "-o", out],
                            ["render", self.run_directory, "--cameras", bad, "-o", out.with_suffix(".png")],
                            ["solve", ROOM, "-o", out, "--cost-model", bad]):
                with self.subTest(text, command=command[0]):
                    result = enfilade(*command, timeout=SOON_S)
                    self.assert_refused(result, str(bad))
                    self.assertNotRegex(result.stderr, r"exception|std::|nlohmann|\.cpp|\.hpp")

    def test_devices_and_pipes_are_read_or_refused(self):
        for path in ("/dev/zero", "/dev/null", "/dev/tty"):
            self.assertEqual(enfilade("info", path, timeout=SOON_S).returncode, 2)
        fifo = self.scratch / "fifo"
        os.mkfifo(fifo)
        writer = threading.Thread(target=lambda: fifo.write_text(ROOM.read_text()))
        writer.start()
        result = solve(fifo, self.scratch / "piped")
        writer.join()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(answers(self.scratch / "piped/probes.json"), answers(self.run_directory / "probes.json"))
        self.assert_refused(enfilade("info", fifo, timeout=SOON_S), "nobody writes")

    def test_the_points_of_a_target_error_are_read_once(self):
        # Where each rank read them, all but the first would find an empty pipe, or another file.
        fifo = self.scratch / "points"
        for ranks in (1, 2):
            fifo.unlink(missing_ok=True)
            os.mkfifo(fifo)
            writer = threading.Thread(target=lambda: fifo.write_text('{"probes": [{"p": [2, 1.5, 0], "n": [0, 0, 1]}]}'))
            writer.start()
            command = ["mpirun", "--oversubscribe", "-n", ranks, cli_test.ENFILADE, "solve", ROOM, "-o", self.scratch / f"on_{ranks}",
                       "--no-pictures", "--target-error", "0.2", "--target-error-at", fifo]
            result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=60)
            writer.join()
            self.assertEqual(result.returncode, 0, result.stderr)
        of_one, of_two = (answers(self.scratch / f"on_{ranks}/probes.json") for ranks in (1, 2))
        self.assertAlmostEqual(of_two[0][0] / of_one[0][0], 1.0, delta=0.05)

    def test_standard_input_is_read_once(self):
        with ROOM.open() as scene:
            result = subprocess.run([cli_test.ENFILADE, "solve", "/dev/stdin", "-o", self.scratch / "in", "--no-pictures",
                                     "--target-error", "0.2"], stdin=scene, capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(answers(self.scratch / "in/probes.json"), answers(self.run_directory / "probes.json"))

    def test_the_scene_that_was_read_is_the_one_that_is_answered(self):
        for end in ("changed", "deleted"):
            scene, run = self.scene(), self.scratch / end
            command = [cli_test.ENFILADE, "solve", scene, "-o", run, "--no-pictures", "--target-error", "0.2"]
            with subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
                while not (run / "run.json").exists() and process.poll() is None:
                    time.sleep(0.002)
                scene.unlink()
                if end == "changed":
                    other = json.loads(ROOM.read_text())
                    other["probes"] = [{"p": [3, 2, 0.5], "n": [0, 0, -1]}]
                    scene.write_text(json.dumps(other))
                self.assertEqual(process.wait(60), 0)
            self.assertEqual((run / "probes.json").read_bytes(), (self.run_directory / "probes.json").read_bytes())

    def test_an_output_that_cannot_be_written_is_told(self):
        for command in (["info", self.run_directory], ["info", ROOM], ["--help"], ["solve", "--help"],
                        ["solve", self.run_directory, "--resume", "--no-pictures", "--target-error", "0.2"]):
            with self.subTest(command[0]), open("/dev/full", "w") as full:
                result = subprocess.run([cli_test.ENFILADE, *map(str, command)], stdout=full, stderr=subprocess.PIPE, text=True)
                self.assertEqual(result.returncode, 1)
                self.assertIn("standard output: cannot be written", result.stderr)

    def test_a_file_of_the_run_is_no_output(self):
        for name in ("run.json", "scene.json", "reports.json", "common/manifest.json", "clusters.bin", "graph.bin", "lock", "costs/1/rank-0"):
            for command in (["probe", self.run_directory, "--points", ROOM], ["locate", self.run_directory, "--points", ROOM],
                            *([["export", self.run_directory]] if name.endswith(".json") else [])):
                with self.subTest(name, command=command[0]):
                    self.assert_refused(enfilade(*command, "-o", self.run_directory / name), name, "the run keeps for itself")
        self.assertEqual(enfilade("info", self.run_directory).returncode, 0)

    def test_memory_that_runs_out_says_how_much_was_wanted(self):
        def info(path, mebibytes):
            limit = mebibytes << 20
            return subprocess.run([cli_test.ENFILADE, "info", path], capture_output=True, text=True, timeout=60,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        scene = json.loads(ROOM.read_text())
        scene["surfaces"] += [dict(scene["surfaces"][0], name="x" * 50) for _ in range(30000)]
        path = self.scratch / "large.json"
        path.write_text(json.dumps(scene))
        enough = next(m for m in range(64, 2048, 32) if info(ROOM, m).returncode == 0)
        result = info(path, enough + 8)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex(result.stderr, r"^enfilade: error: memory: ran out: \d+ (MiB|bytes) more wanted( for [^\n]*large\.json)?, beside the [^\n]* taken[^\n]*; [^\n]*\n$")


class Names(InScratch):
    def assert_plain(self, text):
        self.assertNotRegex(text, "[\x00-\x08\x0b-\x1f\x7f\u200e\u200f\u202a-\u202e\u2066-\u2069]")

    def test_names_do_nothing_to_terminals_pages_and_tables(self):
        def name(scene):
            for surface, text in zip(scene["surfaces"], (CONTROL, "=1+1", "+1", "@x", "-1", "\t=x")):
                surface["name"] = text
            scene["surfaces"].append(dict(scene["surfaces"][0]))  # a duplicate, which is warned of by its name
            scene["rooms"] = [{"name": CONTROL, "storey": CONTROL, "bbox": [[0, 0, 0], [4, 3, 2.7]]}]
            scene["source"] = CONTROL
            scene[CONTROL] = 1
        run = self.scratch / "run"
        result = enfilade("solve", self.scene(name), "-o", run, "--target-error", "0.2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("same outline", result.stderr)
        self.assert_plain(result.stderr + result.stdout)
        self.assert_plain((run / "report.html").read_text())
        if (run / "walk.html").exists():  # it needs npm when the program is built
            walk = (run / "walk.html").read_text()
            self.assert_plain(walk)
            self.assertNotRegex(walk, r"\\u00(1b|07|00)")
        with (run / "surfaces.csv").open(newline="") as table:
            rows = list(csv.reader(table))
        for row in rows[1:]:
            self.assertNotRegex(row[1], r"^[=+@\t-]")
            self.assert_plain(row[1].replace("\n", ""))

    def test_cameras_with_such_names(self):
        run, cameras = self.scratch / "run", self.scratch / "cameras.json"
        self.assertEqual(solve(ROOM, run).returncode, 0)
        cameras.write_text(json.dumps({"cameras": [{"name": CONTROL, "eye": [1, 1, 1], "look_at": [2, 2, 1]}]}))
        for options in ([], ["--camera", "none"]):
            result = enfilade("render", run, "-o", self.scratch / "x.png", "--cameras", cameras, "--width", 8, "--height", 8, *options)
            self.assert_plain(result.stdout + result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1 if options else 0)

    def test_paths_and_options_with_such_names(self):
        for command in (["info", "no\x1b[31m\u202e"], ["x\x1b[31m"], ["info", "--\x1b]0;t\x07"]):
            result = enfilade(*command)
            self.assertEqual(result.returncode, 2)
            self.assert_plain(result.stderr)


class Links(InRun):
    def test_links_that_were_planted_are_not_written_through(self):
        mine = self.scratch / "mine"
        mine.write_text("mine")
        for name in ("run.json.new", "stats.json.part", "common/manifest.json.new", "report.html", "surfaces.csv", "stats.json"):
            path = self.run_directory / name
            path.unlink(missing_ok=True)
            path.symlink_to(mine)
        result = solve(ROOM, self.run_directory)
        self.assertEqual((result.returncode, mine.read_text()), (0, "mine"), result.stderr)
        self.assertFalse((self.run_directory / "report.html").is_symlink())
        answer = self.scratch / "answer.json"
        for suffix in ("", f".part{os.getpid()}"):
            answer.with_name(answer.name + suffix).symlink_to(mine)
        result = enfilade("probe", self.run_directory, "--points", ROOM, "-o", answer)
        self.assertEqual((result.returncode, mine.read_text()), (0, "mine"), result.stderr)

    def test_a_segment_that_is_a_link_is_not_followed(self):
        mine = self.scratch / "mine"
        mine.write_text("mine")
        (self.run_directory / "common/manifest.json").unlink()
        planted = self.run_directory / "common/rank-0.geometry.0"
        planted.unlink()
        planted.symlink_to(mine)
        self.assertEqual(solve(ROOM, self.run_directory).returncode, 0)
        self.assertEqual(mine.read_text(), "mine")
        self.assertFalse(planted.is_symlink())

    def test_what_killed_commands_left_goes(self):
        (self.run_directory / "local/rank-7").mkdir(parents=True)
        (self.run_directory / "local/rank-7/rank-7.patches-a.0").write_text("x")
        (self.run_directory / "stats.json.part-0123456789abcdef").write_text("x")
        self.assertEqual(enfilade("prepare", ROOM, "-o", self.run_directory).returncode, 0)
        self.assertFalse((self.run_directory / "stats.json.part-0123456789abcdef").exists())
        (self.run_directory / "local/rank-7").mkdir(parents=True)
        self.assertEqual(solve(ROOM, self.run_directory).returncode, 0)
        self.assertFalse((self.run_directory / "local").exists())


class TwoAtOnce(InRun):
    def test_a_second_command_is_refused_and_the_first_ends_well(self):
        scene, run = ROOT / "scenes/two_rooms.json", self.scratch / "both"
        command = [cli_test.ENFILADE, "solve", str(scene), "-o", str(run), "--no-pictures", "--quiet"]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as first:
            while not (run / "run.json").exists() and first.poll() is None:
                time.sleep(0.001)
            first.send_signal(signal.SIGSTOP)
            try:
                for second in (command[1:], ["solve", run, "--resume"], ["prepare", ROOM, "-o", run]):
                    result = enfilade(*second, timeout=SOON_S)
                    self.assert_refused(result, "lock", f"process {first.pid} on")
                for reader in (["info", run], ["render", run, "-o", self.scratch / "x.png"]):
                    self.assertEqual(enfilade(*reader, timeout=SOON_S).returncode, 2)
            finally:
                first.kill()
            first.communicate()
        result = enfilade("solve", scene, "-o", run, "--resume", "--no-pictures", "--quiet", "--target-error", "0.1")
        self.assertEqual(result.returncode, 0, result.stderr)


class Sizes(InScratch):
    """Piles and stars: what grows with a power shows at these sizes."""

    def prepared(self, surfaces):
        scene = json.loads(ROOM.read_text())
        scene["surfaces"] += surfaces
        path = self.scratch / "scene.json"
        path.write_text(json.dumps(scene))
        shutil.rmtree(self.scratch / "run", ignore_errors=True)
        result = enfilade("prepare", path, "-o", self.scratch / "run", "--no-pictures", timeout=2 * SOON_S)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    @staticmethod
    def ring(corners, radii, height=0.5):
        return [[2 + radii[i % len(radii)] * math.cos(2 * math.pi * i / corners),
                 1.5 + radii[i % len(radii)] * math.sin(2 * math.pi * i / corners), height] for i in range(corners)]

    def test_a_pile_of_equal_polygons(self):
        square = [[1, 1, 0.5], [2, 1, 0.5], [2, 2, 0.5], [1, 2, 0.5]]
        result = self.prepared([{"vertices": square, "reflectance": [0.5], "name": f"s{i}"} for i in range(10000)])
        self.assertIn("same outline and material as an earlier surface: dropped", result.stderr)

    def test_a_pile_of_polygons_of_one_outline_and_many_materials(self):
        square = [[1, 1, 0.5], [2, 1, 0.5], [2, 2, 0.5], [1, 2, 0.5]]
        result = self.prepared([{"vertices": square, "reflectance": [0.1 + 7e-5 * i], "name": f"s{i}"} for i in range(10000)])
        self.assertIn("covered by a surface in the same plane in front of it", result.stderr)

    def test_a_star_of_many_corners(self):
        self.prepared([{"vertices": self.ring(700, (0.8, 0.4)), "reflectance": [0.5], "two_sided": True}])

    def test_a_disc_of_many_corners(self):
        self.prepared([{"vertices": self.ring(3000, (0.8,)), "reflectance": [0.5], "two_sided": True}])

    def test_discs_of_many_corners_that_hang_and_lie_on_each_other(self):
        hanging = [self.ring(3000, (0.8,), 0.5 + 0.2 * i) for i in range(4)]
        lying = [[[x + 0.2 * i, y, z] for x, y, z in self.ring(3000, (0.5,), 0.3)] for i in range(4)]
        for shape in (hanging, lying):
            self.prepared([{"vertices": ring, "reflectance": [0.5], "two_sided": True} for ring in shape])

    def test_more_corners_than_can_be_are_refused(self):
        path = self.scene(lambda scene: scene["surfaces"].append({"vertices": self.ring(20000, (0.8, 0.4)), "reflectance": [0.5]}))
        self.assert_refused(enfilade("prepare", path, "-o", self.scratch / "run", timeout=SOON_S), "vertices", "corners")


if __name__ == "__main__":
    cli_test.ENFILADE = cli_test.ENFILADE or sys.argv.pop(1)
    unittest.main()
