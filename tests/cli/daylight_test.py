#!/usr/bin/python3
"""Daylight through openings and panes, as a user asks for it, against closed forms.

daylight_test.py ENFILADE [unittest arguments]"""
import csv
import json
import math
import shutil
import sys
import unittest

import cli_test
from cli_test import enfilade

WALLS = [[[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], [[0, 0, 0], [0, 4, 0], [0, 4, 3], [0, 0, 3]],
         [[4, 0, 0], [4, 0, 3], [4, 4, 3], [4, 4, 0]], [[0, 0, 0], [0, 0, 3], [4, 0, 3], [4, 0, 0]],
         [[0, 4, 0], [4, 4, 0], [4, 4, 3], [0, 4, 3]]]
ROOF = [[0, 0, 3], [0, 4, 3], [4, 4, 3], [4, 0, 3]]
SKY = {"type": "uniform", "horizontal_illuminance": 8000}


def of_corner(a, b, c):
    """Form factor of a point to a parallel rectangle a x b at distance c, whose corner stands above it."""
    x, y = a / math.hypot(a, c), b / math.hypot(b, c)
    return (x * math.atan(b / math.hypot(a, c)) + y * math.atan(a / math.hypot(b, c))) / (2 * math.pi)


def roofless(**more):
    """A black room without a roof, and two points on its floor."""
    return {"exitanceUnits": "lm/m2", "surfaces": [{"vertices": wall, "reflectance": 0} for wall in WALLS],
            "probes": [{"p": [2, 2, 0], "n": [0, 0, 1]}, {"p": [1, 3, 0], "n": [0, 0, 1]}], "sky": SKY, **more}


EXPECTED = [4 * of_corner(2, 2, 3), sum(of_corner(a, b, 3) for a in (1, 3) for b in (1, 3))]


class Daylight(cli_test.InScratch):
    def solve(self, scene, *options):
        path = self.scratch / "scene.json"
        path.write_text(json.dumps(scene))
        run = self.scratch / "run"
        result = enfilade("solve", path, "-o", run, "--no-pictures", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return run, path

    def factors(self, scene, name="answers.csv"):
        run, points = self.solve(scene)
        out = self.scratch / name
        result = enfilade("probe", run, "--points", points, "-o", out, "--daylight-factor")
        self.assertEqual(result.returncode, 0, result.stderr)
        return out

    def test_factor_of_a_room_without_a_roof(self):
        with self.factors(roofless()).open(newline="", encoding="utf-8") as file:
            for row, expected in zip(csv.DictReader(file), EXPECTED):
                self.assertAlmostEqual(float(row["daylight_factor"]), 100 * expected, delta=0.1 * expected)
                self.assertAlmostEqual(float(row["E"]), 8000 * expected, delta=8 * expected)

    def test_a_bright_sky_over_a_closed_room_costs_and_brings_nothing(self):
        lamp = {"vertices": [[x, y, 2.9] for x, y, _ in ROOF], "reflectance": 0.5, "exitance": 10}
        room = {**roofless(), "surfaces": [*roofless()["surfaces"], lamp]}
        for sky in {**SKY, "horizontal_illuminance": 100000}, {"type": 12, "horizontal_illuminance": 50000,
                                                               "sun": {"elevation": 50, "azimuth": 200}}:
            run, _ = self.solve({**room, "sky": sky})
            links = json.loads((run / "stats.json").read_text(encoding="utf-8"))["links"]
            self.assertLess(links, 2000)  # patches were split down to the sky's 2% that no point of them had seen
            for probe, (x, y) in zip(json.loads((run / "probes.json").read_text(encoding="utf-8"))["probes"],
                                     ((2, 2), (1, 3))):
                of_lamp = 10 * sum(of_corner(a, b, 2.9) for a in (x, 4 - x) for b in (y, 4 - y))
                self.assertAlmostEqual(probe["E"][0], of_lamp, delta=1e-3 * of_lamp)
            shutil.rmtree(run)

    def test_a_new_sky_over_a_closed_room_that_is_relit(self):
        lamp = {"vertices": ROOF, "reflectance": 0.5, "exitance": 10}
        room = {**roofless(), "surfaces": [*roofless()["surfaces"], lamp]}
        new = self.scratch / "new.json"
        new.write_text(json.dumps({**room, "sky": {**SKY, "horizontal_illuminance": 100000}}))
        del room["sky"]
        run, points = self.solve(room)
        before = json.loads((run / "stats.json").read_text(encoding="utf-8"))
        relit = self.scratch / "relit"
        result = enfilade("solve", run, "--relight", new, "-o", relit, "--no-pictures")
        self.assertEqual(result.returncode, 0, result.stderr)
        after = json.loads((relit / "stats.json").read_text(encoding="utf-8"))
        self.assertEqual(after["links"], before["links"])
        self.assertLess(after["estimated_error"], 0.02)
        result = enfilade("probe", relit, "--points", points, "-o", self.scratch / "answers.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        for probe, (x, y) in zip(json.loads((self.scratch / "answers.json").read_text(encoding="utf-8"))["probes"],
                                 ((2, 2), (1, 3))):
            of_lamp = 10 * sum(of_corner(a, b, 3) for a in (x, 4 - x) for b in (y, 4 - y))
            self.assertAlmostEqual(probe["E"][0], of_lamp, delta=1e-3 * of_lamp)

    def test_sky_two_doors_deep(self):
        """Three black rooms in a row, the first without its outer wall: the last one sees the sky through two doors."""
        doors = {4: (1.5, 2.5, 2.1), 8: (1.2, 2.2, 2.0)}  # x: y from, to, and height
        walls = [[[0, 0, 0], [12, 0, 0], [12, 4, 0], [0, 4, 0]], [[0, 0, 3], [0, 4, 3], [12, 4, 3], [12, 0, 3]],
                 [[0, 0, 0], [0, 0, 3], [12, 0, 3], [12, 0, 0]], [[0, 4, 0], [12, 4, 0], [12, 4, 3], [0, 4, 3]],
                 [[12, 0, 0], [12, 0, 3], [12, 4, 3], [12, 4, 0]]]
        for x, (low, high, top) in doors.items():
            walls += [[[x, y0, z0], [x, y1, z0], [x, y1, 3], [x, y0, 3]]
                      for y0, y1, z0 in ((0, low, 0), (high, 4, 0), (low, high, top))]
        points = [[11, 1.8, 0.6], [9, 2.1, 1.2], [11.5, 2.4, 0.3], [10, 0.5, 1.0]]
        run, _ = self.solve({**roofless(), "probes": [{"p": p, "n": [-1, 0, 0]} for p in points],
                             "surfaces": [{"vertices": w, "reflectance": 0, "two_sided": True} for w in walls]})
        openings = [(0, 0, 4, 3), *((x, *door) for x, door in doors.items())]
        for probe, (px, py, pz) in zip(json.loads((run / "probes.json").read_text(encoding="utf-8"))["probes"], points):
            left = max((low - py) / (px - x) for x, low, _, _ in openings)
            right = min((high - py) / (px - x) for x, _, high, _ in openings)
            top = min((height - pz) / (px - x) for x, _, _, height in openings)
            expected = 8000 * (of_corner(right, top, 1) - of_corner(left, top, 1)) if left < right else 0
            self.assertAlmostEqual(probe["E"][0], expected, delta=max(2e-3 * expected, 2 * probe["error"][0], 1e-9))
            self.assertLessEqual(probe["error"][0], 0.02 * expected)
        self.assertEqual(expected, 0)  # of the last point: it stands beside the line of the doors

    def test_tinted_pane_in_the_roof(self):
        scene = roofless()
        scene["surfaces"].append({"vertices": ROOF, "reflectance": 0, "transmittance": [0.8, 0.4]})
        answers = json.loads(self.factors(scene, "answers.json").read_text())["probes"]
        for answer, expected in zip(answers, EXPECTED):
            whole, half = answer["daylight_factor"]
            self.assertAlmostEqual(half, 0.5 * whole, delta=1e-6 * whole)
            # Dimmed by the angle, at most by a tenth here.
            self.assertLess(whole, 80 * expected)
            self.assertGreater(whole, 72 * expected)

    def rooms(self, run, *options, name="rooms.csv"):
        out = self.scratch / name
        result = enfilade("rooms", run, "-o", out, "--no-cylindrical", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        if name.endswith(".html"):
            return out.read_text(), result
        with out.open(newline="", encoding="utf-8") as file:
            return next(csv.DictReader(file)), result

    def check_room(self, row, factor, scale=1.0):
        """The row's factors against `factor(x, y)` of the points of its grid, which is square and evenly spaced."""
        side = math.isqrt(int(row["points"]))
        self.assertEqual(side * side, int(row["points"]))
        zone = float(row["wall_zone_m"])
        at = [zone + (i + 0.5) * (4 - 2 * zone) / side for i in range(side)]
        expected = sorted(100 * scale * factor(x, y) for x in at for y in at)
        middle = (expected[(len(expected) - 1) // 2] + expected[len(expected) // 2]) / 2
        for name, value in (("mean", sum(expected) / len(expected)), ("minimum", expected[0]), ("median", middle)):
            found, error = (float(row[f"daylight_factor_{name}{tail}"]) for tail in ("", "_error"))
            self.assertAlmostEqual(found, value, delta=1e-3 * value, msg=name)
            self.assertLess(error, 5e-3 * value)

    def test_rooms_under_a_uniform_sky(self):
        rooms = [{"name": "court", "outline": [[0, 0], [4, 0], [4, 4], [0, 4]], "z": [0, 3]}]
        run, _ = self.solve(roofless(rooms=rooms))

        def factor(x, y):
            return sum(of_corner(a, b, 2.25) for a in (x, 4 - x) for b in (y, 4 - y))

        self.check_room(self.rooms(run)[0], factor)
        page, result = self.rooms(run, name="rooms.html")
        self.assertIn("D median", page)
        self.assertIn("outside", result.stdout)
        report = self.scratch / "report.html"
        self.assertEqual(enfilade("report", run, "-o", report, "--no-pictures").returncode, 0)
        self.assertIn("D median", report.read_text())

    def test_rooms_under_an_overcast_sky(self):
        rooms = [{"name": "court", "outline": [[0, 0], [4, 0], [4, 4], [0, 4]], "z": [0, 3]}]
        run, _ = self.solve(roofless(rooms=rooms, sky={"type": "overcast", "horizontal_illuminance": 5000}))
        steps = 80

        def factor(x, y):
            """Cells of the opening: cos^2 / (pi r^2) times the luminance over the mean, 7/9 of the zenith's."""
            total = 0.0
            for i in range(steps):
                for k in range(steps):
                    dx, dy = (i + 0.5) * 4 / steps - x, (k + 0.5) * 4 / steps - y
                    square = dx * dx + dy * dy + 2.25 * 2.25
                    cosine = 2.25 / math.sqrt(square)
                    total += cosine ** 2 / square * (1 + 2 * cosine) / 3 * 9 / 7
            return total * (4 / steps) ** 2 / math.pi

        self.check_room(self.rooms(run)[0], factor)

    def test_rooms_with_lamps_have_none_until_these_are_off(self):
        rooms = [{"name": "court", "outline": [[0, 0], [4, 0], [4, 4], [0, 4]], "z": [0, 3]}]
        lamp = {"type": "point", "p": [2, 2, 2], "intensity": 500, "name": "lamp"}
        run, _ = self.solve(roofless(rooms=rooms, lights=[lamp]), "--shares")
        row, result = self.rooms(run)
        self.assertEqual(row["daylight_factor_mean"], "")
        self.assertIn("the scene has lamps", result.stdout)
        row, result = self.rooms(run, "--switch", "lamp=0", "--maintenance-factor", 0.8)
        self.check_room(row, lambda x, y: sum(of_corner(a, b, 2.25) for a in (x, 4 - x) for b in (y, 4 - y)))

    def test_refusals_are_one_line(self):
        lamp = {"type": "point", "p": [2, 2, 1], "intensity": 10}
        sun = {"elevation": 50, "azimuth": 180, "illuminance": 60000}
        plain = roofless()
        del plain["sky"]
        for scene, what in ((dict(plain, lights=[lamp]), "no sky"), (roofless(lights=[lamp]), "lamps"),
                            (roofless(sky=dict(SKY, sun=sun)), "sunlight")):
            run, points = self.solve(scene)
            result = enfilade("probe", run, "--points", points, "-o", self.scratch / "x.json", "--daylight-factor")
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, rf"^enfilade: error: .*--daylight-factor: the scene has {what}[^\n]*\n$")
            self.assertFalse((self.scratch / "x.json").exists())
            shutil.rmtree(run)


if __name__ == "__main__":
    cli_test.ENFILADE = cli_test.ENFILADE or sys.argv.pop(1)
    unittest.main()
