#!/usr/bin/python3
"""Each luminaire's share of the light, and other lamps over the same links, as a user asks for them: against closed
forms and against solves of their own.

shares_test.py ENFILADE [unittest arguments]"""
import csv
import json
import math
import sys
import unittest

import cli_test
from cli_test import MPIRUN, enfilade
from room_scenes import block, box, lamp, prism, scene
from rooms_test import InScratch, factor_to_polygon


def two_lamps(reflectance, **more):
    """A room with two lamps, a table between them, and a point light on a switch with the second lamp."""
    lamps = [lamp(1.2, 1.1, 2.95, 0.4, 9000, "north"), lamp(3.9, 2.8, 2.95, 0.6, 5000, "south")]
    lamps[1]["switch"] = "group 2"
    return scene(prism(box(0, 0, 5, 4), 0, 3, reflectance, 0.0, "room") + block(2, 1.5, 0.7, 3.2, 2.5, 0.75, "table") +
                 lamps, lights=[{"type": "point", "p": [4.2, 1, 2], "intensity": 60, "switch": "group 2"}], **more)


PROBES = [{"p": [x, y, z], "n": n} for x, y, z, n in
          [(1.2, 1.1, 0, [0, 0, 1]), (2.6, 2.0, 0.3, [0, 0, 1]), (2.6, 2.0, 0.75, [0, 0, 1]), (4.5, 3.5, 0.1, [0, 0, 1]),
           (0.001, 2, 1.5, [1, 0, 0])]]


def only(content, name):
    """The same scene with nothing on but what is on this switch."""
    content = json.loads(json.dumps(content))
    for surface in content["surfaces"]:
        if surface.get("switch", surface["object"]) != name:
            surface["exitance"] = 0.0
    content["lights"] = [light for light in content["lights"] if light["switch"] == name]
    return content


class SharesCase(InScratch):
    def solve_in(self, name, content, *options, ranks=0):
        run = self.scratch / name
        result = enfilade("solve", self.write(name + ".json", content), "-o", run, "--no-pictures", *options, ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        return run

    def probe(self, run, *options, probes=None):
        points = self.write("points.json", {"probes": probes or PROBES})
        output = self.scratch / "answers.json"
        result = enfilade("probe", run, "--points", points, "-o", output, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(output.read_text())["probes"]

    def refused(self, result, *words, status=2):
        self.assertEqual(result.returncode, status, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith("enfilade: error:")]
        self.assertEqual(len(lines), 1, result.stderr)
        for word in words:
            self.assertIn(word, lines[0])


class Shares(SharesCase):
    def test_in_a_black_room_each_is_the_lamps_closed_form(self):
        content = two_lamps(0.0)
        content["surfaces"] = [s for s in content["surfaces"] if s["object"] != "table"]
        run = self.solve_in("run", content, "--shares")
        for probe, answer in zip(PROBES, self.probe(run, "--shares")):
            p, n = probe["p"], probe["n"]
            by_lamp = {s["object"]: s["exitance"] * factor_to_polygon(p, n, s["vertices"])[0]
                       for s in content["surfaces"] if s["exitance"] > 0}
            d = [4.2 - p[0], 1 - p[1], 2 - p[2]]
            r2 = sum(x * x for x in d)
            bulb = 60 * max(0.0, sum(x * y for x, y in zip(d, n))) / r2 ** 1.5
            self.assertEqual(set(answer["shares"]), {"north", "group 2"})
            self.assertAlmostEqual(answer["shares"]["north"][0], by_lamp["north"], delta=1e-3 * by_lamp["north"])
            south = by_lamp["south"] + bulb
            self.assertAlmostEqual(answer["shares"]["group 2"][0], south, delta=1e-3 * south)

    def test_each_is_the_light_of_a_scene_with_that_lamp_alone(self):
        content = two_lamps(0.6)
        run = self.solve_in("run", content, "--shares", "--target-error", "0.01")
        answers = self.probe(run, "--shares")
        plain = self.probe(run)
        for name in ("north", "group 2"):
            alone = self.probe(self.solve_in("alone", only(content, name), "--target-error", "0.01"))
            for whole, one in zip(answers, alone):
                # Three standard deviations of both.
                error = 3 * math.hypot(whole["error"][0], one["error"][0])
                self.assertAlmostEqual(whole["shares"][name][0], one["E"][0], delta=error, msg=name)
        for whole, same in zip(answers, plain):
            self.assertEqual(whole["E"], same["E"])  # by the same rays
            self.assertAlmostEqual(sum(e[0] for e in whole["shares"].values()), whole["E"][0],
                                   delta=1e-6 * whole["E"][0])

    def test_read_off_patches_they_sum_to_the_light_as_well(self):
        run = self.solve_in("run", two_lamps(0.5), "--shares")
        for answer in self.probe(run, "--shares", "--from", "patches"):
            self.assertAlmostEqual(sum(e[0] for e in answer["shares"].values()), answer["E"][0],
                                   delta=1e-6 * answer["E"][0])
            self.assertGreater(min(e[0] for e in answer["shares"].values()), 0)

    def test_a_dimmed_switch_takes_its_part_of_the_light(self):
        run = self.solve_in("run", two_lamps(0.5), "--shares")
        for answer, dim, off in zip(self.probe(run, "--shares"), self.probe(run, "--switch", "group 2=0.25"),
                                    self.probe(run, "--switch", "group 2=0", "--switch", "north=2")):
            north, south = answer["shares"]["north"][0], answer["shares"]["group 2"][0]
            error = 4 * answer["error"][0]  # which node is integrated in closed form may differ
            self.assertAlmostEqual(dim["E"][0], north + 0.25 * south, delta=error)
            self.assertAlmostEqual(off["E"][0], 2 * north, delta=2 * error)
        for command, output in (("render", "x.png"), ("export", "x.glb"), ("rooms", "x.csv")):
            size = ["--width", "64", "--height", "48"] if command == "render" else []
            both = []
            for factor in ("1", "0.2"):
                result = enfilade(command, run, "-o", self.scratch / output, "--switch", "north=" + factor, *size)
                self.assertEqual(result.returncode, 0, result.stderr)
                both.append((self.scratch / output).read_bytes())
            self.assertNotEqual(both[0], both[1], command)

    def test_they_are_the_same_on_any_number_of_ranks(self):
        first = None
        for ranks in (0, 2, 4):
            answers = self.probe(self.solve_in("run%d" % ranks, two_lamps(0.7), "--shares", ranks=ranks), "--shares")
            first = first or answers
            for a, b in zip(first, answers):
                for name, light in a["shares"].items():
                    self.assertAlmostEqual(light[0], b["shares"][name][0], delta=1e-6 * a["E"][0])

    def test_three_bands_have_shares_of_three_bands(self):
        content = two_lamps(0.5)
        for surface in content["surfaces"]:
            surface["reflectance"] = [0.5, 0.4, 0.3]
        run = self.solve_in("run", content, "--shares")
        for answer in self.probe(run, "--shares"):
            for band in range(3):
                total = sum(e[band] for e in answer["shares"].values())
                self.assertAlmostEqual(total, answer["E"][band], delta=1e-6 * answer["E"][band])
        table = self.scratch / "answers.csv"
        self.assertEqual(enfilade("probe", run, "--shares", "--points", self.scratch / "points.json", "-o",
                                  table).returncode, 0)
        with table.open(newline="", encoding="utf-8") as file:
            row = next(csv.DictReader(file))
        self.assertGreater(float(row["E by group 2_1"]), 0)

    def test_of_a_solved_run_they_come_later_and_change_nothing_else(self):
        run = self.solve_in("run", two_lamps(0.5))
        self.refused(enfilade("probe", run, "--shares", "--points", self.write("p.json", {"probes": PROBES}), "-o",
                              self.scratch / "a.json"), "shares", "--resume --shares")
        before = {f: f.read_bytes() for f in run.rglob("*") if f.is_file()}
        result = enfilade("solve", run, "--resume", "--shares", "--no-pictures")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual({f: f.read_bytes() for f in before}, before)
        self.assertEqual([f.name for f in run.iterdir() if f not in before and f.is_dir() and
                          not any(f in old.parents for old in before)], ["shares"])
        self.assertEqual(len(self.probe(run, "--shares")[0]["shares"]), 2)
        self.solve_in("run", two_lamps(0.4))
        self.assertFalse((run / "shares").exists(), "shares of another solution")

    def test_what_is_wrong_is_one_line(self):
        run = self.solve_in("run", two_lamps(0.5), "--shares")
        points = ["--points", self.write("p.json", {"probes": PROBES}), "-o", self.scratch / "a.json"]
        self.refused(enfilade("probe", run, *points, "--switch", "east=0.5"), "--switch", "'east'", "group 2, north")
        for bad in ("north", "north=", "north=-1", "north=nan", "north=1e9", "=1"):
            self.refused(enfilade("probe", run, *points, "--switch", bad), "--switch")
        self.refused(enfilade("solve", self.write("dark.json", scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 0.0, "room"))),
                              "-o", self.scratch / "dark", "--no-pictures", "--shares"), "emits")
        file = sorted((run / "shares").glob("rank-*"))[0]
        content = bytearray(file.read_bytes())
        content[len(content) // 2] ^= 1
        file.write_bytes(bytes(content))
        self.refused(enfilade("probe", run, *points, "--shares"), file.name, "damaged", status=1)


class Relight(SharesCase):
    def changed(self):
        """Other reflectances, one lamp off, one brighter, the bulb where it was with half its light."""
        content = two_lamps(0.6)
        for surface in content["surfaces"]:
            if surface["object"] == "room":
                surface["reflectance"] = 0.75 if "wall" in surface["name"] else 0.2
            surface["exitance"] *= {"north": 0.0, "south": 1.7}.get(surface["object"], 1)
        content["lights"][0]["intensity"] = 30
        return content

    def compare(self, relit, solved):
        for a, b in zip(self.probe(relit), self.probe(solved)):
            self.assertAlmostEqual(a["E"][0], b["E"][0], delta=3 * math.hypot(a["error"][0], b["error"][0]))

    def stats(self, run):
        return json.loads((run / "stats.json").read_text())

    def test_other_lamps_and_reflectances_give_the_light_of_a_whole_solve(self):
        run = self.solve_in("run", two_lamps(0.6), "--target-error", "0.01")
        new = self.write("new.json", self.changed())
        first = self.stats(run)
        result = enfilade("solve", run, "--relight", new, "-o", self.scratch / "relit", "--no-pictures")
        self.assertEqual(result.returncode, 0, result.stderr)
        relit, solved = self.scratch / "relit", self.solve_in("solved", self.changed(), "--target-error", "0.01")
        self.compare(relit, solved)
        self.assertEqual(self.stats(relit)["target_error"], 0.01)
        self.assertEqual(self.stats(relit)["links"], first["links"])
        self.assertLess(self.stats(relit)["form_factors"], 0.1 * first["form_factors"])
        self.assertEqual(self.stats(run), first)
        # In place: the same light, and nothing is left of the run before.
        result = enfilade("solve", run, "--relight", new, "--no-pictures", ranks=2)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertFalse((run / "before-relight").exists())
        for a, b in zip(self.probe(run), self.probe(relit)):
            self.assertAlmostEqual(a["E"][0], b["E"][0], delta=1e-6 * b["E"][0])
        self.assertEqual(enfilade("solve", run, "--resume", "--shares", "--no-pictures").returncode, 0)
        self.assertEqual(list(self.probe(run, "--shares")[0]["shares"]), ["group 2"])

    def test_a_lamp_that_was_off_gets_links(self):
        content = two_lamps(0.6)
        bright = json.loads(json.dumps(content))
        content["surfaces"] = [s if s["object"] != "south" else {**s, "exitance": 0.0} for s in content["surfaces"]]
        content["lights"][0]["intensity"] = 0
        bright["lights"].append({"type": "spot", "p": [1, 3, 2.9], "intensity": 500, "direction": [0, 0, -1]})
        run = self.solve_in("run", content)
        result = enfilade("solve", run, "--relight", self.write("new.json", bright), "-o", self.scratch / "relit",
                          "--no-pictures")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.compare(self.scratch / "relit", self.solve_in("solved", bright))

    def test_where_the_target_is_missed_it_says_so(self):
        run = self.solve_in("run", two_lamps(0.3), "--target-error", "0.1")
        content = self.changed()
        for surface in content["surfaces"]:
            surface["exitance"] = 5000.0 if surface["object"] == "table" else 0.0
        content["lights"] = []
        result = enfilade("solve", run, "--relight", self.write("new.json", content), "-o", self.scratch / "relit",
                          "--no-pictures", "--target-error", "0.002")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater(self.stats(self.scratch / "relit")["estimated_error"], 0.002)
        self.assertIn("without --relight", result.stderr)
        self.assertIn("refined for other light", result.stderr)

    def test_other_geometry_is_refused_and_named(self):
        run = self.solve_in("run", two_lamps(0.5))

        def refuse(change, *words):
            content = two_lamps(0.5)
            change(content)
            before = {f: f.read_bytes() for f in run.rglob("*") if f.is_file()}
            self.refused(enfilade("solve", run, "--relight", self.write("new.json", content), "--no-pictures"), *words)
            self.assertEqual({f: f.read_bytes() for f in run.rglob("*") if f.is_file()}, before)

        def move(content):
            content["surfaces"][7]["vertices"][2][0] += 0.01
            content["surfaces"][9]["vertices"][2][0] += 0.01

        refuse(move, "surfaces[7]", "another geometry", "without --relight")
        refuse(lambda c: c["surfaces"].pop(), "surfaces", "13")
        refuse(lambda c: c.update(exitanceUnits="W/m2"), "exitanceUnits")
        refuse(lambda c: c["surfaces"][3].update(two_sided=True), "surfaces[3]")
        refuse(lambda c: [s.update(reflectance=[0.5, 0.4]) for s in c["surfaces"]], "bands")
        self.refused(enfilade("solve", self.write("scene.json", two_lamps(0.5)), "--relight",
                              self.scratch / "new.json", "-o", self.scratch / "x"), "--relight", "solved RUN")
        self.refused(enfilade("solve", run, "--relight", self.scratch / "new.json", "--resume"), "--resume")


if __name__ == "__main__":
    cli_test.ENFILADE = sys.argv.pop(1)
    unittest.main(module="__main__")
