#!/usr/bin/python3
"""The command line as a user meets it: help, exit statuses, one line for what is wrong, nothing half-written.

cli_test.py ENFILADE [unittest arguments]; ENFILADE_SMPIRUN and ENFILADE_SMPI name the simulated side."""
import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ROOM = HERE / "room.json"
SCENES = ROOT / "tests/data/scene"
ENFILADE = os.environ.get("ENFILADE", "")
MPIRUN = ["mpirun", "--oversubscribe", "-n"]
SUBCOMMANDS = ["generate", "import", "prepare", "solve", "probe", "rooms", "walk", "render", "export", "factors", "bounds", "locate", "plan", "report", "info"]
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def enfilade(*args, ranks=0, timeout=240):
    command = [ENFILADE, *map(str, args)]
    if ranks:
        command = MPIRUN + [str(ranks)] + command
    return subprocess.run(command, capture_output=True, text=True, timeout=timeout)


def said(result):
    """What enfilade said on standard error; mpirun adds lines of its own."""
    return [line for line in result.stderr.splitlines() if line.startswith("enfilade:")]


class InScratch(unittest.TestCase):
    def setUp(self):
        self.scratch = Path(tempfile.mkdtemp(prefix="enfilade-cli-"))
        self.addCleanup(shutil.rmtree, self.scratch, ignore_errors=True)

    def scene(self, change=lambda scene: None, name="scene.json"):
        scene = json.loads(ROOM.read_text())
        change(scene)
        path = self.scratch / name
        path.write_text(json.dumps(scene))
        return path

    def assert_refused(self, result, *words):
        """Exit status 2, one line "enfilade: error: FILE: WHERE: what; hint" with these words, no output."""
        self.assertEqual(result.returncode, 2, result.stderr)
        errors = [line for line in said(result) if line.startswith("enfilade: error: ")]
        self.assertEqual(len(errors), 1, result.stderr)
        self.assertRegex(errors[0], r"^enfilade: error: [^:]+: .+: .+; .+")
        for word in words:
            self.assertIn(word, errors[0])
        self.assertEqual(result.stdout, "")

    def leftovers(self, *inputs):
        return sorted(p.name for p in self.scratch.iterdir() if p not in inputs)


class Help(unittest.TestCase):
    def test_every_subcommand_explains_itself_with_an_example(self):
        for name in SUBCOMMANDS:
            result = enfilade(name, "--help")
            self.assertEqual((result.returncode, result.stderr), (0, ""), name)
            self.assertRegex(result.stdout, r"(?s)Example.*enfilade " + name)

    def test_the_program_lists_its_subcommands(self):
        result = enfilade("--help")
        self.assertEqual(result.returncode, 0)
        for name in SUBCOMMANDS:
            self.assertRegex(result.stdout, rf"(?m)^  {name} ")

    def test_help_shows_the_defaults(self):
        text = enfilade("solve", "--help").stdout
        self.assertRegex(text, r"--target-error[^\n]*0\.02")
        self.assertRegex(text, r"--assignment[^\n]*kmeans")

    def test_version(self):
        self.assertRegex(enfilade("--version").stdout, r"^enfilade \d+\.\d+\.\d+\n$")

    def test_under_mpirun_one_rank_speaks(self):
        result = enfilade("--help", ranks=2)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stdout, enfilade("--help").stdout)


class Executables(InScratch):
    """enfilade links no MPI, and leaves solve and the ranks of mpirun to enfilade-mpi beside it."""

    def test_enfilade_links_no_mpi(self):
        libraries = subprocess.run(["ldd", ENFILADE], capture_output=True, text=True, check=True).stdout
        self.assertNotRegex(libraries, r"(?i)libmpi|pmix|open-rte")

    def test_one_rank_of_mpirun_does_the_work_of_a_single_process(self):
        self.assertEqual(enfilade("info", ROOM, ranks=3).stdout, enfilade("info", ROOM).stdout)

    def test_enfilade_mpi_is_found_through_a_link(self):
        link = self.scratch / "linked"
        link.symlink_to(ENFILADE)
        result = subprocess.run([link, "solve", "--help"], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stdout), (0, enfilade("solve", "--help").stdout))

    def test_a_missing_enfilade_mpi_is_one_line(self):
        alone = self.scratch / "enfilade"
        shutil.copy(ENFILADE, alone)
        result = subprocess.run([alone, "solve", ROOM, "-o", self.scratch / "run"], capture_output=True, text=True)
        self.assert_refused(result, "enfilade-mpi", "build the target enfilade-mpi")
        self.assertEqual(subprocess.run([alone, "info", ROOM], capture_output=True).returncode, 0)


class CommandLine(InScratch):
    def test_no_subcommand(self):
        self.assert_refused(enfilade(), "command line", "enfilade --help")

    def test_a_misspelt_subcommand_is_guessed(self):
        self.assert_refused(enfilade("sovle", ROOM), "sovle", "did you mean 'solve'")

    def test_an_unknown_subcommand_gets_the_list(self):
        self.assert_refused(enfilade("frobnicate"), *SUBCOMMANDS)

    def test_unknown_option(self):
        self.assert_refused(enfilade("solve", ROOM, "-o", self.scratch / "run", "--sideways"),
                            "--sideways", "enfilade solve --help")

    def test_values_out_of_range(self):
        for option, value in [("--target-error", "-1"), ("--target-error", "nan"), ("--target-error", "two"),
                              ("--epsilon", "inf"), ("--basis", "cubic"), ("--assignment", "fair"),
                              ("--order", "alphabetical"), ("--max-iterations", "0"), ("--memory", "lots"),
                              ("--memory", "-5M"), ("--seed", "-1")]:
            result = enfilade("solve", ROOM, "-o", self.scratch / "run", option, value)
            with self.subTest(option=option, value=value):
                self.assert_refused(result, option)
                self.assertEqual(self.leftovers(), [])

    def test_a_scene_without_run_directory(self):
        self.assert_refused(enfilade("solve", ROOM), "-o")

    def test_under_mpirun_one_line(self):
        self.assert_refused(enfilade("solve", ROOM, "--sideways", ranks=3), "--sideways")


def put(value, *keys):
    """A change of the scene: the value under the last key."""
    def change(scene):
        for key in keys[:-1]:
            scene = scene[key]
        scene[keys[-1]] = value
    return change


class BadScenes(InScratch):
    BAD = {
        "other format": (put("other", "format"), ["format"]),
        "future version": (put(99, "version"), ["version"]),
        "no surfaces": (lambda s: s.pop("surfaces"), ["surfaces"]),
        "two vertices": (put([[0, 0, 0], [1, 0, 0]], "surfaces", 2, "vertices"), ["surfaces[2]"]),
        "word for a number": (put([0, 0, "up"], "surfaces", 3, "vertices", 1), ["surfaces[3]", "wall north"]),
        "reflectance 1": (put([1.0], "surfaces", 1, "reflectance"), ["surfaces[1]", "ceiling"]),
        "reflectance below 0": (put([-0.1], "surfaces", 1, "reflectance"), ["surfaces[1]", "ceiling"]),
        "negative exitance": (put([-3], "surfaces", 6, "exitance"), ["surfaces[6]", "lamp"]),
        "bands differ": (lambda s: (s["surfaces"][0].update(reflectance=[0.1, 0.2]),
                                   s["surfaces"][1].update(reflectance=[0.1, 0.2, 0.3])), ["surfaces["]),
        "bowtie": (put([[0, 0, 1], [1, 1, 1], [1, 0, 1], [0, 1, 1]], "surfaces", 7, "vertices"), ["table top"]),
        "unknown unit": (put("furlong", "units"), ["units"]),
        "unknown exitance unit": (put("nit", "exitanceUnits"), ["exitanceUnits"]),
        "light without place": (put([{"type": "point", "intensity": [1]}], "lights"), ["lights[0]"]),
        "probe without normal": (put([{"p": [1, 1, 1]}], "probes"), ["probes[0]"]),
    }

    def test_prepare_and_solve_refuse_and_leave_nothing(self):
        for name, (change, words) in self.BAD.items():
            path = self.scene(change)
            for command in ("prepare", "solve"):
                with self.subTest(name, command=command):
                    result = enfilade(command, path, "-o", self.scratch / "run")
                    self.addCleanup(shutil.rmtree, self.scratch / "run", ignore_errors=True)
                    self.assert_refused(result, str(path), *words)
                    self.assertFalse((self.scratch / "run").exists())

    def test_text_that_is_no_json(self):
        path = self.scratch / "scene.json"
        for text, where in [("", ""), ('{"format": "enfilade-scene",\n "surfaces": [}', "line 2"), ("\0\1\2", "")]:
            path.write_text(text)
            self.assert_refused(enfilade("solve", path, "-o", self.scratch / "run"), str(path), where)
            self.assertEqual(self.leftovers(path), [])

    def test_files_that_are_not_there(self):
        gone, run = self.scratch / "gone.json", self.scratch / "run"
        for args in [("prepare", gone, "-o", run), ("solve", gone, "-o", run), ("info", gone),
                     ("import", self.scratch / "gone.glb", "-o", run), ("solve", run, "--resume"),
                     ("probe", run, "--points", gone, "-o", run), ("locate", run, "--points", gone, "-o", run),
                     ("render", run, "-o", self.scratch / "a.png"), ("export", run, "-o", self.scratch / "a.glb"),
                     ("report", run, "-o", self.scratch / "a.html")]:
            with self.subTest(args=args[0]):
                self.assert_refused(enfilade(*args))
                self.assertEqual(self.leftovers(), [])

    def test_a_model_of_unknown_kind(self):
        path = self.scratch / "house.skp"
        path.write_text("?")
        self.assert_refused(enfilade("import", path, "-o", self.scratch / "scene.json"), "house.skp")
        self.assertEqual(self.leftovers(path), [])

    def test_three_ranks_refuse_with_one_line_and_none_hangs(self):
        path = self.scene(put([1.2], "surfaces", 1, "reflectance"))
        result = enfilade("solve", path, "-o", self.scratch / "run", ranks=3, timeout=60)
        self.assert_refused(result, "ceiling")
        self.assertEqual(self.leftovers(path), [])


class HardScenes(InScratch):
    """The scenes of tests/data/scene, each with a fault of its own: refused by name, or solved with a warning by name."""

    # file: surface and key, what is wrong, what to do about it
    REFUSED = {
        "refused/nan_vertex.json": ('surfaces[0] "floor".vertices[0][0]', 'is "NaN", not a finite number', "write a number"),
        "refused/inf_exitance.json": ('surfaces[9] "light".exitance[0]', 'is "Infinity"', "write a number"),
        "refused/negative_exitance.json": ('surfaces[9] "light".exitance[0]', "is -1, below zero", "write 0 or more"),
        "refused/rho_1.json": ('surfaces[0] "floor".reflectance[0]', "is 1.0, outside [0, 1)", "write 0 to 0.9999"),
        "refused/rho_1p2.json": ('surfaces[0] "floor".reflectance[0]', "is 1.2, outside [0, 1)", "write 0 to 0.9999"),
        "refused/rho_negative.json": ('surfaces[0] "floor".reflectance[0]', "is -0.1, below zero", "write 0 or more"),
        "nonconvex.json": ('surfaces[11] "bowtie".vertices', "the polygon crosses itself", "split it"),
    }
    WARNED = {
        "slivers.json": (['surfaces[10] "sliver"', 'surfaces[11] "zero_area"', 'surfaces[12] "point"'], "dropped"),
        "nonplanar_quad.json": (['surfaces[10] "warped"'], "not planar: split into planar parts"),
        "duplicate_polygon.json": (['surfaces[10] "floor_dup"'], "same outline and material as an earlier surface: dropped"),
        "coplanar_overlap.json": (['surfaces[1] "x0"'], "covered part left out"),
        "reversed_normal.json": (['surfaces[2] "x1"'], "reverse the order of its vertices"),
    }

    @staticmethod
    def is_finite(value):
        if isinstance(value, list):
            return all(map(HardScenes.is_finite, value))
        return not isinstance(value, float) or math.isfinite(value)

    @staticmethod
    def irradiances(run):
        """Of every surface that is not dropped, by name; the first band."""
        rows = list(csv.reader((run / "surfaces.csv").read_text().splitlines()))
        column = next(i for i, title in enumerate(rows[0]) if title.startswith("mean_irradiance"))
        return {row[1]: float(row[column]) for row in rows[1:] if row[column]}

    def solve(self, scene, run):
        return enfilade("solve", scene, "-o", run, "--no-pictures")

    def test_every_scene_with_a_fault_is_driven(self):
        kept = {str(p.relative_to(SCENES)) for p in SCENES.rglob("*.json")
                if {"reject", "warn", "warn_or_reject"} & set(json.loads(p.read_text()).get("expect", {}))}
        self.assertEqual(kept, {*self.REFUSED, *self.WARNED})

    def test_refused_with_one_line_and_nothing_written(self):
        for name, words in self.REFUSED.items():
            for command in ("prepare", "solve"):
                with self.subTest(name, command=command):
                    result = enfilade(command, SCENES / name, "-o", self.scratch / "run")
                    self.assert_refused(result, Path(name).name + ": ", *words)
                    self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
                    self.assertEqual(self.leftovers(), [])

    def test_a_refused_scene_leaves_the_run_that_was_there_before(self):
        run = self.scratch / "run"
        self.assertEqual(self.solve(ROOM, run).returncode, 0)
        def contents():
            return {p: p.read_bytes() for p in run.rglob("*") if p.is_file()}
        before = contents()
        for name in ("refused/rho_1.json", "nonconvex.json"):  # faults found while reading, and while cutting
            self.assert_refused(self.solve(SCENES / name, run))
            self.assertEqual(contents(), before)

    def test_solved_with_a_warning_that_names_the_surface(self):
        for name, (surfaces, what) in self.WARNED.items():
            with self.subTest(name):
                run = self.scratch / Path(name).stem
                result = self.solve(SCENES / name, run)
                self.assertEqual(result.returncode, 0, result.stderr)
                lines = [line for line in said(result) if what in line]
                self.assertEqual(len(lines), 1, result.stderr)
                self.assertTrue(lines[0].startswith("enfilade: warning: "), lines[0])
                for surface in surfaces:
                    self.assertIn(surface, lines[0])
                stats = json.loads((run / "stats.json").read_text())
                self.assertTrue(self.is_finite(list(stats.values())), stats)
                self.assertTrue(self.is_finite(list(self.irradiances(run).values())))

    def test_what_is_dropped_changes_nothing(self):
        for name, extra in [("slivers.json", {"sliver", "zero_area", "point"}), ("duplicate_polygon.json", {"floor_dup"})]:
            scene = json.loads((SCENES / name).read_text())
            scene["surfaces"] = [s for s in scene["surfaces"] if s["name"] not in extra]
            clean = self.scratch / "clean.json"
            clean.write_text(json.dumps(scene))
            answers = []
            for source, run in ((SCENES / name, self.scratch / "with"), (clean, self.scratch / "without")):
                self.assertEqual(self.solve(source, run).returncode, 0)
                answers.append(self.irradiances(run))
            self.assertEqual(set(answers[0]), {s["name"] for s in scene["surfaces"]})
            for surface, irradiance in answers[0].items():
                self.assertAlmostEqual(irradiance / answers[1][surface], 1.0, delta=0.001, msg=surface)

    def test_a_reversed_wall_shows_as_light_that_is_not_absorbed(self):
        result = self.solve(SCENES / "reversed_normal.json", self.scratch / "run")
        self.assertRegex(result.stdout, r"(?m)^  light not absorbed +\d+%$")
        self.assertGreater(json.loads((self.scratch / "run/stats.json").read_text())["flux_balance"], 0.1)
        stats = json.loads((self.scratch / "run/stats.json").read_text())
        self.assertAlmostEqual(stats["escaping_share"], stats["flux_balance"], delta=0.05)


class Radiance(InScratch):
    """Radiance scene descriptions become scenes."""

    MATERIALS = "void plastic grey\n0 0 5 .5 .4 .3 0 0\nvoid light lamp\n0\n0\n3 10 20 30\n"
    ROOM = MATERIALS + """# a room of 4 x 3 x 2.5 m, seen from the inside
grey polygon floor 0 0 12  0 0 0  4 0 0  4 3 0  0 3 0
grey polygon ceiling 0 0 12  0 0 2.5  0 3 2.5  4 3 2.5  4 0 2.5
grey polygon south 0 0 12  0 0 0  0 0 2.5  4 0 2.5  4 0 0
grey polygon north 0 0 12  0 3 0  4 3 0  4 3 2.5  0 3 2.5
grey polygon west 0 0 12  0 0 0  0 3 0  0 3 2.5  0 0 2.5
grey polygon east 0 0 12  4 0 0  4 0 2.5  4 3 2.5  4 3 0
lamp polygon panel 0 0 12  1.5 1 2.4  1.5 2 2.4  2.5 2 2.4  2.5 1 2.4
void source sun 0 0 4 0 0 1 .5
!xform -n table -t 2 1.5 0 parts/table.rad
"""
    TABLE = "grey ring top 0 0 8  0 0 .7  0 0 1  0 .5\ngrey cylinder leg 0 0 7  0 0 0  0 0 .7  .05\n"

    def model(self, text):
        (self.scratch / "parts").mkdir(exist_ok=True)
        (self.scratch / "parts/table.rad").write_text(self.TABLE)
        path = self.scratch / "room.rad"
        path.write_text(text)
        return path

    def test_a_room_becomes_a_scene(self):
        scene = self.scratch / "scene.json"
        result = enfilade("import", self.model(self.ROOM), "-o", scene)
        self.assertEqual(result.returncode, 0, result.stderr)
        warnings = [line for line in said(result) if "warning" in line]
        self.assertEqual(len(warnings), 1, result.stderr)
        self.assertIn('source "sun"', warnings[0])
        info = enfilade("info", scene)
        self.assertEqual((info.returncode, info.stderr), (0, ""))
        self.assertRegex(info.stdout, r"(?m)^  emitted +31.42, 62.83, 94.25 W$")
        self.assertRegex(info.stdout, r"(?m)^  extent +4 x 3 x 2.5 m$")
        self.assertRegex(info.stdout, r"(?m)^  surfaces +32$")  # 6 sides, a panel, a top, 24 sides of a leg
        surfaces = json.loads(scene.read_text())["surfaces"]
        panel = next(s for s in surfaces if s["name"] == "panel")
        for got, radiance in zip(panel["exitance"], (10, 20, 30)):
            self.assertAlmostEqual(got, math.pi * radiance, places=9)
        self.assertNotIn("two_sided", panel)
        table = [s for s in surfaces if s.get("object") == "table"]
        self.assertEqual((len(table), {s["name"] for s in table}), (25, {"table.top", "table.leg"}))
        self.assertTrue(all(s["two_sided"] for s in table))

    def test_faults_name_the_line_and_leave_no_output(self):
        for last, line, words in [  # the line of the fault, counted from the first that is added
                ("!gensurf grey box 1 1 1", 0, ["gensurf", "xform -e"]),
                ("!xform -t 1 0 0 gone.rad", 0, ["gone.rad", "does not exist"]),
                ("!xform room.rad", 0, ["takes in itself"]),
                ("grey poligon p 0 0 0", 0, ["poligon"]),
                ("pink sphere s 0 0 4 0 0 0 1", 0, ["pink", "not defined"]),
                ("grey sphere s\n0\n0\n4 0 0 zero 1", 3, ["zero"]),
                ("grey sphere s 0 0 4 0 0 0", 1, ["ends before"])]:
            line += 1 + self.ROOM.count("\n")
            path = self.model(self.ROOM + last + "\n")
            with self.subTest(last):
                result = enfilade("import", path, "-o", self.scratch / "scene.json")
                self.assert_refused(result, f"{path}: line {line}: ", *words)
                self.assertEqual(self.leftovers(path, self.scratch / "parts"), [])


class BrokenRuns(InScratch):
    def test_an_output_that_cannot_be_written_is_refused(self):
        (self.scratch / "run").write_text("a file is in the way")
        result = enfilade("prepare", ROOM, "-o", self.scratch / "run")
        self.assert_refused(result, "is a file")
        self.assertEqual((self.scratch / "run").read_text(), "a file is in the way")

    def test_ranks_fail_together(self):
        (self.scratch / "run").write_text("a file is in the way")
        result = enfilade("solve", ROOM, "-o", self.scratch / "run", ranks=2, timeout=60)
        self.assertNotEqual(result.returncode, 0)
        self.assertEqual(len([line for line in said(result) if "error" in line]), 1, result.stderr)


class Workflow(InScratch):
    """One small room all the way through."""

    @classmethod
    def setUpClass(cls):
        cls.home = Path(tempfile.mkdtemp(prefix="enfilade-cli-run-"))
        cls.run_directory = cls.home / "run"
        cls.solved = enfilade("solve", ROOM, "-o", cls.run_directory, ranks=2)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.home, ignore_errors=True)

    def stats(self, run=None):
        return json.loads(((run or self.run_directory) / "stats.json").read_text())

    def test_solve_fills_the_run_directory(self):
        self.assertEqual(self.solved.returncode, 0, self.solved.stderr)
        for name in ["stats.json", "probes.json", "surfaces.csv", "solution.glb", "report.html"]:
            self.assertGreater((self.run_directory / name).stat().st_size, 0, name)
        self.assertTrue(list(self.run_directory.rglob("*.png")))
        self.assertEqual([p for p in self.run_directory.rglob("*.tmp*")], [])

    def test_it_ends_with_a_table_and_no_progress_when_piped(self):
        self.assertRegex(self.solved.stdout, r"(?m)^  iterations +\d+$")
        self.assertRegex(self.solved.stdout, r"(?m)^  ranks +2$")
        self.assertNotIn("\r", self.solved.stdout + self.solved.stderr)

    def test_stats_have_the_keys_that_scripts_rely_on(self):
        keys = """surfaces lights cells portals clusters cluster_edges patches links bands basis iterations
            converged residual estimated_error flux_balance rays form_factors ranks steals steal_requests messages
            message_bytes bytes_read bytes_written peak_rss_bytes wall_s prepare_s solve_s""".split()
        stats = self.stats()
        self.assertEqual([k for k in keys if k not in stats], [])
        self.assertEqual((stats["surfaces"], stats["ranks"], stats["bands"]), (8, 2, 1))
        self.assertFalse([k for k, v in stats.items() if isinstance(v, dict)])

    def test_probe_answers_keep_extra_keys_and_agree_with_the_solve(self):
        answer = self.scratch / "answer.json"
        result = enfilade("probe", self.run_directory, "--points", ROOM, "-o", answer)
        self.assertEqual(result.returncode, 0, result.stderr)
        got, own = json.loads(answer.read_text()), json.loads((self.run_directory / "probes.json").read_text())
        self.assertEqual((got["from"], got["unit"]), ("gather", "lx"))
        self.assertEqual([p["label"] for p in got["probes"]], ["middle", "corner", "on the table", "under the table"])
        self.assertEqual([p["E"] for p in got["probes"]], [p["E"] for p in own["probes"]])
        self.assertEqual([p["error"] for p in got["probes"]], [p["error"] for p in own["probes"]])
        for point in got["probes"]:
            for light, error in zip(point["E"], point["error"]):
                self.assertTrue(0.0 <= error < 0.2 * light, point)
        middle, corner, on, under = [p["E"][0] for p in got["probes"]]
        self.assertGreater(middle, corner)
        self.assertGreater(on, 3 * under)

    def test_patches_answer_like_a_gather(self):
        answers = []
        for method in ("gather", "patches"):
            path = self.scratch / f"{method}.json"
            result = enfilade("probe", self.run_directory, "--points", ROOM, "--from", method, "-o", path)
            self.assertEqual(result.returncode, 0, result.stderr)
            document = json.loads(path.read_text())
            self.assertEqual(document["from"], method)
            answers.append(document["probes"][0]["E"][0])
        self.assertNotEqual(answers[0], answers[1])
        self.assertAlmostEqual(answers[1] / answers[0], 1.0, delta=0.05)

    def test_bad_probes_are_refused(self):
        points = self.scratch / "points.json"
        points.write_text('{"probes": [{"p": [0, 0], "n": [0, 0, 1]}]}')
        self.assert_refused(enfilade("probe", self.run_directory, "--points", points, "-o", self.scratch / "a.json"),
                            "probes[0]")
        points.write_text('{"probes": []}')
        self.assert_refused(enfilade("probe", self.run_directory, "--points", points, "-o", self.scratch / "a.json"),
                            "probes: is empty")
        self.assertEqual(self.leftovers(points), [])

    def test_numbers_out_of_range_are_refused(self):
        points = self.scratch / "points.json"
        points.write_text('{"probes": [{"p": [1, 1, 1], "n": [0, 0, 1]}]}')
        for option, value in (("--seed", "-3"), ("--seed", "2.5"), ("--seed", "9" * 20), ("--noise", "nan"),
                              ("--noise", "1.1"), ("--rays", "0")):
            self.assert_refused(enfilade("probe", self.run_directory, "--points", points, "-o",
                                         self.scratch / "a.json", option, value), option)

    def test_bounds_hold_the_estimate_of_every_surface(self):
        table = self.scratch / "bounds.csv"
        result = enfilade("bounds", self.run_directory, "-o", table, "--links", "2000")
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(table, encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        scene = json.loads(ROOM.read_text())
        self.assertEqual([row["name"] for row in rows if row["kind"] == "surface"],
                         [surface.get("name", "") for surface in scene["surfaces"]])
        self.assertEqual(sum(row["kind"] == "scene" for row in rows), 1)
        self.assertGreaterEqual(sum(row["kind"] == "room" for row in rows), 1)
        bounded = 0
        for row in rows:
            for key in (key for key in row if key.startswith("lower") and row[key]):
                low, high = float(row[key]), float(row[key.replace("lower", "upper")])
                self.assertLessEqual(0.97 * low, float(row[key.replace("lower", "estimate")]), row)
                self.assertGreaterEqual(1.03 * high, float(row[key.replace("lower", "estimate")]), row)
                bounded += 1
        self.assertGreaterEqual(bounded, len(scene["surfaces"]))

    def test_bounds_refuse_what_they_cannot_do(self):
        out = self.scratch / "bounds.csv"
        for option, value in (("--bounds", "0"), ("--bounds", "nan"), ("--links", "0"), ("--seconds", "-1")):
            self.assert_refused(enfilade("bounds", self.run_directory, "-o", out, option, value), option)
        self.assert_refused(enfilade("bounds", self.scratch, "-o", out))
        self.assertFalse(out.exists())

    def test_locate(self):
        points, cells = self.scratch / "points.json", self.scratch / "cells.json"
        points.write_text('{"points": [[2, 1.5, 1.5], [1, 1, 0.3], [500, 500, 500]]}')
        result = enfilade("locate", self.run_directory, "--points", points, "-o", cells)
        self.assertEqual(result.returncode, 0, result.stderr)
        found = json.loads(cells.read_text())["cells"]
        self.assertEqual(len(found), 3)
        self.assertTrue(all(isinstance(c, int) and c >= -1 for c in found))
        self.assertNotEqual(found[0], -1)
        self.assertEqual(found[0], found[1])

    def test_locate_takes_points_or_probes_not_both(self):
        points = self.scratch / "points.json"
        points.write_text('{"points": [[2, 1.5, 1.5]], "probes": [{"p": [1, 1, 0.3]}]}')
        self.assert_refused(enfilade("locate", self.run_directory, "--points", points, "-o", self.scratch / "c.json"),
                            "both points and probes")
        self.assertEqual(self.leftovers(points), [])

    def test_export_graph_names_every_surface(self):
        path = self.scratch / "graph.json"
        self.assertEqual(enfilade("export", self.run_directory, "-o", path).returncode, 0)
        graph = json.loads(path.read_text())
        self.assertEqual({s for c in graph["clusters"] for s in c["surfaces"]}, set(range(8)))
        ids = [c["id"] for c in graph["clusters"]]
        self.assertEqual(ids, list(range(len(ids))))
        self.assertTrue(all(a < b < len(ids) for a, b in graph["visible"]))
        self.assertTrue(graph["visible"])

    def test_export_model_is_gltf_binary(self):
        path = self.scratch / "light.glb"
        self.assertEqual(enfilade("export", self.run_directory, "-o", path).returncode, 0)
        data = path.read_bytes()
        self.assertEqual(data[:4], b"glTF")
        self.assertEqual(int.from_bytes(data[8:12], "little"), len(data))

    def test_export_of_another_kind_is_refused(self):
        self.assert_refused(enfilade("export", self.run_directory, "-o", self.scratch / "light.fbx"), "light.fbx")

    def test_render(self):
        path = self.scratch / "room.png"
        result = enfilade("render", self.run_directory, "-o", path, "--width", 64, "--height", 48)
        self.assertEqual(result.returncode, 0, result.stderr)
        data = path.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual([int.from_bytes(data[i:i + 4], "big") for i in (16, 20)], [64, 48])

    def test_report_of_two_runs(self):
        path = self.scratch / "report.html"
        result = enfilade("report", self.run_directory, self.run_directory, "-o", path)
        self.assertEqual(result.returncode, 0, result.stderr)
        text = path.read_text()
        self.assertIn("</html>", text)
        self.assertFalse(re.search(r'(src|href)="https?:', text), "not self-contained")

    def test_info(self):
        scene, run = enfilade("info", ROOM), enfilade("info", self.run_directory)
        self.assertEqual((scene.returncode, run.returncode), (0, 0), scene.stderr + run.stderr)
        self.assertRegex(scene.stdout, r"(?m)^  surfaces +8$")
        self.assertRegex(run.stdout, r"(?m)^  iterations +\d+$")
        self.assertRegex(run.stdout, r"(?m)^  clusters +\d+$")

    def test_quiet_says_nothing_and_no_pictures_makes_none(self):
        run = self.scratch / "run"
        result = enfilade("solve", ROOM, "-o", run, "--quiet", "--no-pictures")
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        self.assertEqual(list(run.rglob("*.png")), [])
        self.assertTrue((run / "stats.json").exists())

    def test_a_prepared_run_is_solved_in_place(self):
        run = self.scratch / "run"
        self.assertEqual(enfilade("prepare", ROOM, "-o", run).returncode, 0)
        self.assert_refused(enfilade("export", run, "-o", self.scratch / "a.glb"))
        result = enfilade("solve", run, "--no-pictures")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.stats(run)["surfaces"], 8)

    def test_options_reach_the_solver(self):
        rough, constant = self.scratch / "rough", self.scratch / "constant"
        for run, *options in [(rough, "--target-error", "0.2"), (constant, "--basis", "constant")]:
            result = enfilade("solve", ROOM, "-o", run, "--no-pictures", *options)
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(self.stats(rough)["links"], self.stats()["links"])
        self.assertEqual(self.stats(constant)["basis"], "constant")

    def test_target_points_take_fewer_links(self):
        points = self.scratch / "points.json"
        points.write_text(json.dumps({"probes": [{"p": [2.0, 1.8, 0.75], "n": [0, 0, 1]}, {"p": [1.0, 1.0, 0.75], "n": [0, 0, 1]}]}))
        light, links = {}, {}
        for name, ranks, options in [("all", 1, []), ("points", 1, ["--target-error-at", points]), ("ranks", 3, ["--target-error-at", points])]:
            run, answers = self.scratch / name, self.scratch / (name + ".json")
            result = enfilade("solve", ROOT / "scenes/two_rooms.json", "-o", run, "--no-pictures", "--quiet", "--target-error", "0.01", *options, ranks=ranks)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(enfilade("probe", run, "--points", points, "-o", answers).returncode, 0)
            light[name] = [q["E"][0] for q in json.loads(answers.read_text())["probes"]]
            links[name] = self.stats(run)["links"]
        self.assertLess(links["points"], 0.7 * links["all"])
        for name in ("points", "ranks"):
            for found, known in zip(light[name], light["all"]):
                self.assertAlmostEqual(found / known, 1.0, delta=0.01)
        blind = self.scratch / "blind.csv"
        blind.write_text("x,y,z\n1,1,-5\n")
        self.assertIn("1 of 1 points see nothing", enfilade("solve", ROOM, "-o", self.scratch / "blind", "--target-error-at", blind).stderr)
        self.assert_refused(enfilade("solve", ROOM, "-o", self.scratch / "none", "--target-error-at", self.scratch / "none.json"), "none.json")

    def test_resume_of_a_finished_run_changes_nothing(self):
        run = self.scratch / "run"
        shutil.copytree(self.run_directory, run)
        result = enfilade("solve", run, "--resume", "--no-pictures")
        self.assertEqual(result.returncode, 0, result.stderr)
        before, after = [json.loads((r / "probes.json").read_text())["probes"] for r in (self.run_directory, run)]
        for a, b in zip(before, after):
            self.assertAlmostEqual(b["E"][0] / a["E"][0], 1.0, delta=0.005)


@unittest.skipUnless(os.environ.get("ENFILADE_SMPI"), "built without SimGrid")
class Simulated(InScratch):
    """The same command line on a simulated cluster."""

    def test_without_smpirun_one_line_says_how_to_start_it(self):
        for words in ([], ["--help"], ["solve", ROOM, "-o", self.scratch / "run"]):
            result = subprocess.run([os.environ["ENFILADE_SMPI"], *words], capture_output=True, text=True)
            self.assert_refused(result, "smpirun -platform")

    def smpirun(self, ranks, *args):
        command = [ROOT / ".ci/smpirun.sh", str(ranks), os.environ["ENFILADE_SMPI"], *map(str, args)]
        return subprocess.run(command, capture_output=True, text=True, timeout=240, cwd=self.scratch)

    def solve(self, ranks, name):
        run = self.scratch / name
        result = self.smpirun(ranks, "solve", ROOM, "-o", run, "--no-pictures", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        return run

    def test_bad_input_is_refused_with_one_line(self):
        path = self.scene(put([1.2], "surfaces", 1, "reflectance"))
        result = self.smpirun(4, "solve", path, "-o", self.scratch / "run")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(said(result)), 1, result.stderr)
        self.assertFalse((self.scratch / "run").exists())

    def test_two_runs_are_equal_to_the_byte(self):
        first, second = self.solve(2, "first"), self.solve(2, "second")
        for name in ["probes.json", "surfaces.csv", "solution.glb", "history.json", "assignment.json"]:
            self.assertEqual((first / name).read_bytes(), (second / name).read_bytes(), name)
        a, b = [json.loads((run / "stats.json").read_text()) for run in (first, second)]
        for clock in ("prepare_s", "solve_s", "wall_s"):
            a.pop(clock), b.pop(clock)
        self.assertEqual(a, b)
        self.assertGreater(a["simulated_s"], 0)
        self.assertEqual([len(a[k]) for k in ("compute_s", "io_s", "idle_s")], [2, 2, 2])

    def test_the_light_is_that_of_a_real_run(self):
        real = self.scratch / "real"
        self.assertEqual(enfilade("solve", ROOM, "-o", real, "--no-pictures", ranks=2).returncode, 0)
        probes = [json.loads((run / "probes.json").read_text())["probes"] for run in (real, self.solve(4, "four"))]
        for a, b in zip(*probes):
            self.assertAlmostEqual(b["E"][0] / a["E"][0], 1.0, delta=0.005)


if __name__ == "__main__":
    ENFILADE = ENFILADE or sys.argv.pop(1)
    unittest.main()
