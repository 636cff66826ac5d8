#!/usr/bin/python3
"""Plans of a house of two rooms, 4 x 4 m and 6 x 4 m, with a door of 0.9 x 2 m between them.

plan_test.py ENFILADE [unittest arguments]"""
import json
import re
import shutil
import struct
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import cli_test
from cli_test import ROOM, InScratch, enfilade

SVG = "{http://www.w3.org/2000/svg}"


def rectangle(corner, u, v):
    def add(*vectors):
        return [sum(c) for c in zip(*vectors)]
    return [corner, add(corner, u), add(corner, u, v), add(corner, v)]


def two_rooms():
    """Inward faces of the house's box, and both sides of the wall with the door, at x = 4 m."""
    x, y, z = [10, 0, 0], [0, 4, 0], [0, 0, 2.5]
    faces = [rectangle(*face) for face in [
        ([0, 0, 0], x, y), ([0, 0, 0], y, z), ([0, 0, 0], z, x),
        (z, y, x), (x, z, y), (y, x, z)]]
    for corner, u, v in [([4, 0, 0], [0, 1, 0], z), ([4, 1.9, 0], [0, 2.1, 0], z), ([4, 1, 2], [0, 0.9, 0], [0, 0, 0.5])]:
        faces += [rectangle(corner, u, v), rectangle(corner, v, u)]
    surfaces = [{"vertices": face, "reflectance": 0.5} for face in faces]
    surfaces[3]["exitance"] = 100.0
    return {"format": "enfilade-scene", "version": 1, "units": "m", "surfaces": surfaces}


def area(points):
    return abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))) / 2


def shapes(svg, kind):
    """(tip, paths as lists of points in metres) of each shape of this kind."""
    for path in ElementTree.parse(svg).getroot().iter(SVG + "path"):
        if path.get("class") != kind:
            continue
        tip = path.find(SVG + "title")
        yield (tip.text if tip is not None else "",
               [[tuple(map(float, point.split())) for point in re.split("[LZ]", part) if point]
                for part in path.get("d").split("M") if part])


def png_size(path):
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n", head
    return struct.unpack(">II", head[16:])


class Plans(InScratch):
    @classmethod
    def setUpClass(cls):
        cls.home = Path(cli_test.tempfile.mkdtemp(prefix="enfilade-cli-plan-"))
        cls.addClassCleanup(shutil.rmtree, cls.home, ignore_errors=True)
        (cls.home / "house.json").write_text(json.dumps(two_rooms()))
        cls.house = cls.home / "house"
        cls.prepared = enfilade("prepare", cls.home / "house.json", "-o", cls.house)

    def plan(self, *options, name="plan.svg"):
        path = self.scratch / name
        result = enfilade("plan", self.house, "-o", path, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return path, result.stdout

    def locate(self, point):
        points, cells = self.scratch / "points.json", self.scratch / "cells.json"
        points.write_text(json.dumps({"points": [point]}))
        enfilade("locate", self.house, "--points", points, "-o", cells)
        return json.loads(cells.read_text())["cells"][0]

    def test_prepare_draws_the_cells(self):
        self.assertEqual(self.prepared.returncode, 0, self.prepared.stderr)
        self.assertEqual(sorted(p.name for p in (self.house / "pictures").iterdir()),
                         ["storey-1-cells.png", "storey-1-cells.svg"])
        width, height = png_size(self.house / "pictures/storey-1-cells.png")
        self.assertGreater(width, 1000)
        self.assertGreater(height, 300)
        bare = self.scratch / "bare"
        self.assertEqual(enfilade("prepare", ROOM, "-o", bare, "--no-pictures").returncode, 0)
        self.assertFalse((bare / "pictures").exists())

    def test_areas_of_the_cells_are_those_of_the_rooms(self):
        svg, said = self.plan()
        self.assertIn("floor at 0.00 m, cut at 1.12 m", said)
        cells = {tip.split(",")[0]: sum(map(area, paths)) for tip, paths in shapes(svg, "cell")}
        self.assertAlmostEqual(cells[f"cell {self.locate([2, 2, 1])}"], 16.0, places=3)
        self.assertAlmostEqual(cells[f"cell {self.locate([8, 2, 1])}"], 24.0, places=3)

    def test_the_door_is_where_it_is(self):
        svg, _ = self.plan()
        (tip, paths), = shapes(svg, "portal")
        self.assertIn("1.8 m2", tip)
        self.assertEqual(sorted(paths[0]), [(4.0, 1.0), (4.0, 1.9)])

    def test_what_one_room_sees(self):
        by_number, said = self.plan("--visible-from", self.locate([2, 2, 1]))
        self.assertIn("2 of 2 cells", said)
        by_point, _ = self.plan("--visible-from", "2,2,1", name="point.svg")
        self.assertEqual(by_number.read_text(), by_point.read_text())

    def test_the_shares_of_ranks(self):
        svg, said = self.plan("--ranks", 2, "--assignment", "round-robin")
        self.assertIn("on 2 ranks", said)
        ranks = {tip.rsplit(", ", 1)[1] for tip, _ in shapes(svg, "surface")}
        self.assertEqual(ranks, {"rank 0", "rank 1"})

    def test_png(self):
        self.assertEqual(png_size(self.plan(name="plan.png")[0]), png_size(self.house / "pictures/storey-1-cells.png"))

    def test_the_cut_can_be_chosen(self):
        self.assertIn("cut at 0.50 m", self.plan("--cut", 0.5)[1])

    def test_wrong_options_are_refused(self):
        plan = self.scratch / "plan.svg"
        for options in (["--visible-from", "99"], ["--visible-from", "-1"], ["--visible-from", "kitchen"],
                        ["--visible-from", "50,50,50"], ["--storey", "7"], ["--show", "visible"],
                        ["--show", "assignment"], ["--show", "rooms"], ["--ranks", "0"], ["--cut", "-1"],
                        ["--show", "cells", "--visible-from", "0"], ["--show", "cells", "--ranks", "2"],
                        ["--ranks", "2", "--assignment", "fair"]):
            with self.subTest(options):
                words = ["assignment.json", "--ranks"] if options[1] == "assignment" else [options[0]]
                if options[-1] == "fair":
                    words = ["--assignment"]
                if len(options) == 4 and options[0] == "--show":
                    words = [options[2]]
                self.assert_refused(enfilade("plan", self.house, "-o", plan, *options), *words)
                self.assertEqual(self.leftovers(), [])
        self.assert_refused(enfilade("plan", self.house, "-o", self.scratch / "plan.pdf"), ".svg")
        self.assert_refused(enfilade("plan", self.scratch, "-o", plan), "not a prepared run")

    def test_a_solve_draws_cells_and_shares(self):
        run = self.scratch / "run"
        result = enfilade("solve", ROOM, "-o", run, "--target-error", "0.3", "--max-iterations", "2", ranks=2)
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("storey-1-cells.svg", "storey-1-assignment.svg", "storey-1-assignment.png"):
            self.assertTrue((run / "pictures" / name).exists(), name)
        self.assertIn("Plans", (run / "report.html").read_text())
        result = enfilade("plan", run, "-o", self.scratch / "a.svg", "--show", "assignment")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.scratch / "a.svg").read_text(), (run / "pictures/storey-1-assignment.svg").read_text())

    def test_info_tells_what_was_found_and_what_it_took(self):
        text = enfilade("info", self.house).stdout
        self.assertRegex(text, r"(?m)^  cells +2 \(2 rooms, 0 outside\), and 0 insides of solids$")
        self.assertRegex(text, r"(?m)^  portals +1$")
        self.assertRegex(text, r"(?m)^  cells that see each other +1 of 1 pairs \(100%\)$")
        self.assertRegex(text, r"(?m)^  time to prepare .*: pieces .*, cells .*, clusters .*, visibility ")
        self.assertRegex(text, r"(?m)^  peak memory up to each step +[\d.]+ MiB: pieces ")
        self.assertRegex(text, r"(?m)^  tolerance +[\d.e-]+ m$")
        mark = json.loads((self.house / "run.json").read_text())
        self.assertEqual([step["name"] for step in mark["steps"]], ["pieces", "cells", "clusters", "visibility"])
        self.assertLessEqual(sum(step["wall_s"] for step in mark["steps"]), mark["prepare_s"])


if __name__ == "__main__":
    cli_test.ENFILADE = cli_test.ENFILADE or sys.argv.pop(1)
    unittest.main()
