#!/usr/bin/python3
"""The light in rooms, as a user asks for it, against closed forms.

rooms_test.py ENFILADE [unittest arguments]"""
import csv
import json
import math
import re
import shutil
import sys
import unittest
from pathlib import Path

import numpy as np

import cli_test
from cli_test import enfilade
from room_scenes import block, box, lamp, prism, scene

L_SHAPE = [(0, 0), (6, 0), (6, 2), (2, 2), (2, 5), (0, 5)]


def factor_to_polygon(points, normals, corners):
    """Form factors of differential areas at `points` to a polygon that lies wholly above their horizons (Lambert)."""
    points, normals = np.atleast_2d(points).astype(float), np.atleast_2d(normals).astype(float)
    corners = np.asarray(corners, float)
    total = np.zeros(len(points))
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        u, v = a - points, b - points
        u /= np.linalg.norm(u, axis=1)[:, None]
        v /= np.linalg.norm(v, axis=1)[:, None]
        across = np.cross(u, v)
        sine = np.linalg.norm(across, axis=1)
        angle = np.arctan2(sine, (u * v).sum(1))
        total += angle * (across * normals).sum(1) / np.maximum(sine, 1e-300)
    return -total / (2 * math.pi)  # the polygon's front looks at the points


class InScratch(cli_test.InScratch):
    def write(self, name, content):
        path = self.scratch / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    def solve(self, content, *options):
        run = self.scratch / "run"
        result = enfilade("solve", self.write("scene.json", content), "-o", run, "--no-pictures", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return run

    def table(self, *args, name="rooms.csv"):
        path = self.scratch / name
        result = enfilade(*args, "-o", path)
        self.assertEqual(result.returncode, 0, result.stderr)
        with path.open(newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))


class ClosedForm(InScratch):
    """A black room of 5 m x 4 m x 3 m with one lamp: all light is the lamp's own."""

    def setUp(self):
        super().setUp()
        self.lamp = lamp(2.1, 1.7, 2.95, 0.6, 5000.0)
        self.run_directory = self.solve(scene(prism(box(0, 0, 5, 4), 0, 3, 0.0, 0.0, "room") + [self.lamp]))

    def light(self, points, normals):
        return 5000.0 * factor_to_polygon(points, normals, self.lamp["vertices"])

    def test_the_working_plane(self):
        row = self.table("rooms", self.run_directory)[0]
        # 4 m x 3 m are left: 4 / (0.2 * 5^log10(4)) = 7.6, so 8 points along, 0.5 m apart, and 6 across.
        x, y = np.meshgrid(0.75 + 0.5 * np.arange(8), 0.75 + 0.5 * np.arange(6))
        points = np.column_stack([x.ravel(), y.ravel(), np.full(48, 0.75)])
        right = self.light(points, np.tile([0.0, 0.0, 1.0], (48, 1)))
        self.assertEqual(row["points"], "48")
        self.assertEqual(float(row["spacing_m"]), 0.5)
        self.assertEqual(row["unit"], "lx")
        for key, value in ("mean", right.mean()), ("minimum", right.min()), ("maximum", right.max()), (
                "u0", right.min() / right.mean()):
            self.assertAlmostEqual(float(row[key]) / value, 1.0, delta=1e-4, msg=key)

    def test_walls_and_ceiling(self):
        row = self.table("rooms", self.run_directory)[0]
        n = 400
        x, y = np.meshgrid((np.arange(n) + 0.5) / n * 5, (np.arange(n) + 0.5) / n * 4)
        floor = self.light(np.column_stack([x.ravel(), y.ravel(), np.zeros(n * n)]), np.tile([0.0, 0.0, 1.0], (n * n, 1)))
        on_walls = 5000.0 * 0.36 - 20.0 * floor.mean()  # what the floor does not get
        self.assertAlmostEqual(float(row["walls"]) / (on_walls / 54.0), 1.0, delta=0.01)
        self.assertEqual(float(row["ceiling"]), 0.0)

    def test_cylindrical_illuminance_of_all_directions(self):
        row = self.table("rooms", self.run_directory, "--cylindrical-height", "1.1")[0]
        x, y = np.meshgrid(0.75 + 0.5 * np.arange(8), 0.75 + 0.5 * np.arange(6))
        lamp_middle, total = np.array([2.1, 1.7, 2.95]), 0.0
        parts = [np.array([2.1 + dx, 1.7 + dy, 2.95]) for dx in np.linspace(-0.28, 0.28, 15)
                 for dy in np.linspace(-0.28, 0.28, 15)]
        self.assertAlmostEqual(np.mean(parts, axis=0)[0], lamp_middle[0])
        for px, py in zip(x.ravel(), y.ravel()):
            for part in parts:  # E_cyl = mean over azimuths of I cos / r^2 = I sin / (pi r^2)
                d = part - np.array([px, py, 1.1])
                r2 = d @ d
                intensity = 5000.0 * 0.36 / len(parts) / math.pi * d[2] / math.sqrt(r2)
                total += intensity / r2 * math.hypot(d[0], d[1]) / math.sqrt(r2) / math.pi
        error = float(row["cylindrical_error"])
        self.assertGreater(error, 0.0)
        self.assertLess(error, 0.03 * total / 48)
        self.assertLess(abs(float(row["cylindrical"]) - total / 48), 3 * error + 0.002 * total / 48)

    def test_the_maintenance_factor_and_the_height(self):
        new, old = (self.table("rooms", self.run_directory, "--height", "1.5", *more)[0]
                    for more in ((), ("--maintenance-factor", "0.8")))
        self.assertEqual(float(new["plane_m"]), 1.5)
        self.assertAlmostEqual(float(old["mean"]), 0.8 * float(new["mean"]), delta=1e-3)
        self.assertEqual(old["maintenance_factor"], "0.8")

    def test_no_glare_rating_without_a_background(self):
        places = self.write("eyes.json", {"places": [{"p": [4, 2, 1.2], "direction": [-1, 0, 0]}]})
        self.table("rooms", self.run_directory, "--ugr-at", places)
        with (self.scratch / "rooms-ugr.csv").open(newline="") as file:
            rating = list(csv.DictReader(file))[0]
        self.assertEqual((rating["ugr"], rating["sources"], rating["room"]), ("", "1", "cell 0"))


class Glare(InScratch):
    def test_of_one_lamp_by_hand(self):
        source = lamp(1.0, 2.0, 2.8, 0.3, 20000.0)
        run = self.solve(scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 0.0, "room") + [source]), "--target-error", "0.01")
        eye, view = np.array([4.2, 2.3, 1.2]), np.array([-1.0, 0.0, 0.0])
        places = self.write("eyes.json", {"places": [{"name": "desk, east", "p": list(eye), "direction": [-2, 0, 0]}]})
        self.table("rooms", run, "--ugr-at", places)
        with (self.scratch / "rooms-ugr.csv").open(newline="", encoding="utf-8") as file:
            rating = list(csv.DictReader(file))[0]
        probes = self.write("probe.json", {"probes": [{"p": list(eye), "n": list(view)}]})
        self.assertEqual(enfilade("probe", run, "--points", probes, "-o", self.scratch / "e.json").returncode, 0)
        whole = json.loads((self.scratch / "e.json").read_text())["probes"][0]["E"][0]
        indirect = whole - 20000.0 * factor_to_polygon(eye, view, source["vertices"])[0]
        self.assertAlmostEqual(float(rating["background_cd_m2"]), indirect / math.pi, delta=0.01 * indirect)
        d = np.array([1.0, 2.0, 2.8]) - eye
        r = np.linalg.norm(d)
        solid_angle = 0.09 * (d[2] / r) / r ** 2
        sigma = math.degrees(math.acos(d @ view / r))
        aside = d / r - (d @ view / r) * view
        tau = math.degrees(math.acos(aside[2] / np.linalg.norm(aside)))
        index = math.exp((35.2 - 0.31889 * tau - 1.22 * math.exp(-2 * tau / 9)) * 1e-3 * sigma
                         + (21 + 0.26667 * tau - 0.002963 * tau ** 2) * 1e-5 * sigma ** 2)
        luminance = 20000.0 / math.pi
        right = 8 * math.log10(0.25 / (indirect / math.pi) * luminance ** 2 * solid_angle / index ** 2)
        self.assertAlmostEqual(float(rating["ugr"]), right, delta=0.1)
        self.assertEqual((rating["place"], rating["room"]), ("desk, east", "cell 0"))
        # Something that hides the lamp ends the glare.
        screen = {"vertices": [[3.9, 1.5, 1.2], [3.9, 3.1, 1.2], [3.9, 3.1, 2.4], [3.9, 1.5, 2.4]], "reflectance": 0.5,
                  "two_sided": True}
        shutil.rmtree(run)
        run = self.solve(scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 0.0, "room") + [source, screen]))
        self.table("rooms", run, "--ugr-at", places)
        with (self.scratch / "rooms-ugr.csv").open(newline="", encoding="utf-8") as file:
            self.assertEqual(list(csv.DictReader(file))[0]["sources"], "0")

    def test_is_a_rating_of_luminances(self):
        watts = scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 10.0, "room"))
        watts["exitanceUnits"] = "W/m2"
        run = self.solve(watts)
        places = self.write("eyes.json", {"probes": [{"p": [1, 1, 1], "n": [1, 0, 0]}]})
        self.assert_refused(enfilade("rooms", run, "-o", self.scratch / "r.csv", "--ugr-at", places), "exitanceUnits")
        self.assertEqual(self.table("rooms", run)[0]["unit"], "W/m2")


class Furnace(InScratch):
    def test_is_even_in_a_room_of_any_shape(self):
        for told in [], [{"name": "=L", "storey": "EG", "outline": L_SHAPE, "z": [0, 3], "required_lx": 90}], [
                {"name": "box", "bbox": [[0, 0, 0], [6, 5, 3]], "required_lx": 110}]:
            run = self.solve(scene(prism(L_SHAPE, 0, 3, 0.6, 40.0, "room"), rooms=told))
            rows = self.table("rooms", run)
            self.assertEqual(len(rows), 1)
            row = rows[0]
            self.assertAlmostEqual(float(row["area_m2"]), 18.0, delta=1e-3)
            self.assertAlmostEqual(float(row["height_m"]), 3.0, delta=1e-3)
            for key in "mean", "minimum", "maximum", "walls", "ceiling", "cylindrical":
                self.assertAlmostEqual(float(row[key]), 100.0, delta=0.03, msg=key)  # as even as its patches
            self.assertAlmostEqual(float(row["u0"]), 1.0, delta=1e-4)
            self.assertLess(float(row["error"]), 0.05)
            wanted = {(): ("cell 0", "Storey 1", ""), ("=L",): ("'=L", "EG", "met"), ("box",): (
                "box", "Storey 1", "not met")}[tuple(room["name"] for room in told)]
            self.assertEqual((row["room"], row["storey"], row["verdict"]), wanted)
            shutil.rmtree(run)


class Furniture(InScratch):
    def test_points_in_it_do_not_count(self):
        surfaces = prism(box(0, 0, 5, 4), 0, 3, 0.5, 50.0, "room") + block(1, 1, 0, 2, 2, 1.0, "cupboard")
        row = self.table("rooms", self.solve(scene(surfaces)))[0]
        # Of the grid 0.75, 1.25, ... the points at 1.25 and 1.75 lie within, both along and across.
        self.assertEqual((row["points"], row["points_in_furniture"]), ("44", "4"))
        self.assertAlmostEqual(float(row["height_m"]), 3.0, delta=1e-3)

    def test_nor_do_points_in_a_cupboard_that_shows_its_front_inside(self):
        cupboard = block(1, 1, 0, 2, 2, 0.9, "cupboard")
        for surface in cupboard:
            surface["two_sided"] = True
        row = self.table("rooms", self.solve(scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 50.0, "room") + cupboard)))[0]
        self.assertEqual((row["points"], row["points_in_furniture"]), ("44", "4"))

    def test_a_table_top_is_a_fine_place(self):
        surfaces = prism(box(0, 0, 5, 4), 0, 3, 0.5, 50.0, "room") + block(1, 1, 0.7, 4, 3, 0.75, "table")
        row = self.table("rooms", self.solve(scene(surfaces)))[0]
        self.assertEqual((row["points"], row["points_in_furniture"]), ("48", "0"))
        self.assertGreater(float(row["minimum"]), 50.0)

    def test_nor_do_points_without_a_floor(self):
        # A shaft of 1 m x 1 m goes down 3 m in the room's middle; the room is told as a rectangle.
        outline = box(0, 0, 5, 4)
        room = [s for s in prism(outline, 0, 3, 0.5, 50.0, "room") if not s["name"].endswith("floor")]
        for x0, y0, x1, y1 in (0, 0, 5, 1), (0, 2, 5, 4), (0, 1, 1, 2), (2, 1, 5, 2):
            room.append({"vertices": [[x, y, 0] for x, y in box(x0, y0, x1, y1)], "reflectance": 0.5, "exitance": 50.0,
                         "name": "floor", "object": "room"})
        room += [s for s in prism(box(1, 1, 2, 2), -3, 0, 0.5, 0.0, "shaft") if not s["name"].endswith("ceiling")]
        run = self.solve(scene(room, rooms=[{"name": "hall", "outline": outline, "z": [0, 3]}]))
        row = self.table("rooms", run)[0]
        self.assertEqual((row["points"], row["points_without_floor"]), ("44", "4"))


class Bands(InScratch):
    def test_three_bands_are_one_lux_as_the_eye_weights_them(self):
        surfaces = prism(box(0, 0, 5, 4), 0, 3, 0.5, 0.0, "room")
        for surface in surfaces:
            surface["exitance"] = [50.0, 100.0, 25.0]
        row = self.table("rooms", self.solve(scene(surfaces)))[0]
        self.assertAlmostEqual(float(row["mean"]), 0.2126 * 100 + 0.7152 * 200 + 0.0722 * 50, delta=0.05)
        self.assertEqual(row["weights"], "0.2126 R + 0.7152 G + 0.0722 B")


class Refusals(InScratch):
    def test_what_is_wrong_is_said_and_nothing_written(self):
        run = self.solve(scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 50.0, "room")))
        out = self.scratch / "rooms.csv"
        self.assert_refused(enfilade("rooms", run, "-o", self.scratch / "rooms.txt"), "rooms.txt", ".csv or .html")
        self.assert_refused(enfilade("rooms", self.scratch / "none", "-o", out), "none")
        self.assert_refused(enfilade("rooms", run, "-o", out, "--height", "-1"), "--height")
        self.assert_refused(enfilade("rooms", run, "-o", out, "--maintenance-factor", "1.2"), "--maintenance-factor")
        for content, where in ({"places": []}, "places"), ({"places": [{"p": [0, 0, 1]}]}, "direction"), (
                {"places": [{"p": [0, 0], "direction": [1, 0, 0]}]}, "places[0].p"):
            self.assert_refused(enfilade("rooms", run, "-o", out, "--ugr-at", self.write("p.json", content)), where)
        self.assertFalse(out.exists())

    def test_rooms_of_a_scene_are_checked(self):
        for room, where in ({"name": "a"}, "rooms[0]"), ({"name": "a", "bbox": [0, 1]}, "rooms[0].bbox"), (
                {"name": "a", "outline": [[0, 0], [1, 0], [1, 1]]}, "rooms[0]"), (
                {"name": ["a"], "bbox": [[0, 0, 0], [1, 1, 1]]}, "rooms[0].name"), (
                {"name": "a", "bbox": [[0, 0, 0], [1, 1, 1]], "required_lx": -3}, "rooms[0].required_lx"):
            bad = self.write("bad.json", scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 50.0, "room"), rooms=[room]))
            self.assert_refused(enfilade("info", bad), where)


class Page(InScratch):
    def test_has_the_rooms_in_one_file(self):
        run = self.solve(scene(prism(L_SHAPE, 0, 3, 0.5, 0.0, "room") + [lamp(1, 1, 2.9, 0.4, 5000.0)], rooms=[
            {"name": "<b>7", "outline": L_SHAPE, "z": [0, 3], "required_lx": 500}]))
        page = self.scratch / "rooms.html"
        self.assertEqual(enfilade("rooms", run, "-o", page).returncode, 0)
        html = page.read_text(encoding="utf-8")
        self.assertIn("&lt;b&gt;7", html)
        self.assertNotIn("<b>7", html)
        self.assertNotRegex(html, r'(?:src|href)="(?:https?:|//)')
        self.assertIn('class="isolux"', html)
        self.assertGreater(len(re.findall(r'class="light"', html)), 5)


class Tables(InScratch):
    """probe takes tables and gives them."""

    def setUp(self):
        super().setUp()
        self.run_directory = self.solve(scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 50.0, "room")))

    def probe(self, name, text, out="e.csv"):
        return self.table("probe", self.run_directory, "--points", self.write(name, text), name=out)

    def test_columns_are_kept(self):
        text = '\ufeffdesk,X,y,Z,nx,ny,nz,"note, long"\r\n"a, b",1,1,1,0,0,2,=1\r\nc,2.5,+1e0,0,0,0,1,\r\n'
        rows = self.probe("desks.csv", text)
        self.assertEqual(list(rows[0]), ["desk", "X", "y", "Z", "nx", "ny", "nz", "note, long", "E", "error", "unit", "from"])
        self.assertEqual([row["desk"] for row in rows], ["a, b", "c"])
        for row in rows:
            self.assertAlmostEqual(float(row["E"]), 100.0, delta=0.05)
            self.assertEqual(row["unit"], "lx")

    def test_a_header_is_not_needed_and_normals_point_up(self):
        rows = self.probe("desks.csv", "1,1,1\n# a comment\n\n2,1,1\n")
        self.assertEqual(list(rows[0])[:4], ["x", "y", "z", "E"])
        self.assertEqual(len(rows), 2)
        rows = self.probe("walls.csv", "0,2,1,1,0,0,west wall\n")
        self.assertEqual((rows[0]["nx"], rows[0]["column_7"]), ("1", "west wall"))

    def test_from_a_table_to_json_and_back(self):
        out = self.scratch / "e.json"
        points = self.write("desks.csv", "name,x,y,z\na,1,1,1\n")
        self.assertEqual(enfilade("probe", self.run_directory, "--points", points, "-o", out).returncode, 0)
        probe = json.loads(out.read_text())["probes"][0]
        self.assertEqual((probe["name"], probe["p"], probe["n"]), ("a", [1.0, 1.0, 1.0], [0.0, 0.0, 1.0]))
        rows = self.table("probe", self.run_directory, "--points", out, name="again.csv")
        self.assertEqual((rows[0]["name"], rows[0]["x"]), ("a", "1"))
        self.assertAlmostEqual(float(rows[0]["E"]), probe["E"][0], delta=1e-5)

    def test_faults_name_line_and_column(self):
        for text, *words in (("x,y,z\n1,2,3\n1,two,3\n", "line 3, column 2", "two"), ("1,2,3\n4,5\n", "line 2", "2 fields"),
                             ("1,2,3\n4,5,nan\n", "line 2, column 3", "nan"), ("a,b,c\n1,2,3\n", "line 1", '"x"'),
                             ("x,y,z,nx\n1,2,3,4\n", "line 1", "nz"), ("", "is empty"), ("x,y,z\n", "line 2"),
                             ("1,2,3\n4,5,1e12\n", "line 2, column 1"), ("x,y,z,nx,ny,nz\n1,1,1,0,0,0\n", "line 2, column 4"),
                             ('"1,2,3\n', "line 1", "quote"), ("1 2 3\n", "line 1"), ("1;2;3;4,5\n1;2;x;4\n", "line 2, column 3")):
            points = self.write("bad.csv", text)
            result = enfilade("probe", self.run_directory, "--points", points, "-o", self.scratch / "out.csv")
            self.assert_refused(result, "bad.csv", *words)
            self.assertFalse((self.scratch / "out.csv").exists())


class Factors(InScratch):
    """View factors, and the forms of other programs."""

    def prepare(self, content):
        run = self.scratch / "run"
        result = enfilade("prepare", self.write("scene.json", content), "-o", run)
        self.assertEqual(result.returncode, 0, result.stderr)
        return run

    def test_of_an_l_shaped_room_with_a_cupboard_are_closed_and_reciprocal(self):
        run = self.prepare(scene(prism(L_SHAPE, 0, 3, 0.6, 0.0, "room") + block(0.5, 3, 0, 1.5, 4, 2, "cupboard")))
        rows = self.table("factors", run)
        factor = {(row["from"], row["to"]): float(row["view_factor"]) for row in rows}
        area = {row["from"]: float(row["area_from_m2"]) for row in rows}
        self.assertAlmostEqual(area["room floor"], 17.0, delta=0.02)  # less what the cupboard stands on
        for name in area:
            if name == "cupboard floor":
                continue
            self.assertAlmostEqual(sum(factor[name, other] for other in area), 1.0, delta=1e-4, msg=name)
            for other in area:
                self.assertAlmostEqual(area[name] * factor[name, other], area[other] * factor[other, name], delta=1e-6)
        # The long wall and the one round the corner do not see each other; opposite walls do.
        self.assertEqual(factor["room wall 1", "room wall 4"], 0.0)
        self.assertGreater(factor["room wall 0", "room wall 2"], 0.1)

    def test_objects_and_rooms_are_groups(self):
        two = prism(box(0, 0, 4, 3), 0, 3, 0.5, 0.0, "a") + prism(box(4.2, 0, 8, 3), 0, 3, 0.5, 0.0, "b")
        run = self.prepare(scene(two, rooms=[{"name": name, "bbox": corners} for name, corners in (
            ("east", [[4.2, 0, 0], [8, 3, 3]]), ("west", [[0, 0, 0], [4, 3, 3]]))]))
        for by, names in ("object", {"a", "b"}), ("room", {"east", "west"}):
            rows = self.table("factors", run, "--by", by)
            self.assertEqual({row["from"] for row in rows}, names)
            for row in rows:
                self.assertAlmostEqual(float(row["view_factor"]), float(row["from"] == row["to"]), delta=1e-6)

    def test_forms_of_other_programs(self):
        run = self.prepare(scene(prism(box(0, 0, 1, 1), 0, 1, 0.5, 0.0, "cube")))
        idf, moose = self.scratch / "f.idf", self.scratch / "f.i"
        self.assertEqual(enfilade("factors", run, "-o", idf, "--zone", "Zone 1").returncode, 0)
        text = "\n".join(line for line in idf.read_text().splitlines() if not line.startswith("!"))
        fields = [field.strip() for field in text.strip().rstrip(";").split(",")]
        self.assertEqual(fields[:2], ["ZoneProperty:UserViewFactors:BySurfaceName", "Zone 1"])
        triples = list(zip(fields[2::3], fields[3::3], map(float, fields[4::3])))
        self.assertEqual(len(triples), 36)
        self.assertAlmostEqual(dict(((a, b), f) for a, b, f in triples)["cube floor", "cube ceiling"], 0.199825, delta=1e-4)
        self.assertEqual(enfilade("factors", run, "-o", moose).returncode, 0)
        matrix = re.search(r"view_factors = '([^']*)'", moose.read_text()).group(1)
        matrix = np.array([[float(x) for x in row.split()] for row in matrix.split(";")])
        self.assertEqual(matrix.shape, (6, 6))
        np.testing.assert_allclose(matrix.sum(1), 1.0, atol=1e-4)
        self.assertEqual(len(re.search(r"boundary = '([^']*)'", moose.read_text()).group(1).split()), 6)

    def test_too_many_are_refused(self):
        many = [{"vertices": [[i, 0, 0], [i + 1, 0, 0], [i + 1, 1, 0], [i, 1, 0]], "reflectance": 0.5,
                 "object": f"o{i % 7}"} for i in range(2001)]
        run = self.prepare(scene(many))
        out = self.scratch / "f.csv"
        self.assert_refused(enfilade("factors", run, "-o", out), "2,001", "--by object")
        self.assert_refused(enfilade("factors", run, "-o", self.scratch / "f.txt"), "f.txt", ".idf")
        self.assertFalse(out.exists())


class Again(InScratch):
    """A run that is finished is left as it is."""

    def files(self, run):
        return {path.relative_to(run): path.read_bytes() for path in sorted(run.rglob("*")) if path.is_file()}

    def test_resuming_a_finished_run_changes_nothing(self):
        run = self.scratch / "run"
        content = self.write("scene.json", scene(prism(box(0, 0, 5, 4), 0, 3, 0.7, 0.0, "room") + [lamp(1, 1, 2.9, 0.4, 900.0)]))
        self.assertEqual(enfilade("solve", content, "-o", run, "--rooms", "--target-error", "0.2").returncode, 0)
        before = self.files(run)
        self.assertIn(Path("rooms.csv"), before)
        result = enfilade("solve", run, "--resume", "--rooms", "--target-error", "0.2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("left as it is", result.stderr)
        self.assertEqual(self.files(run), before)
        # What is missing or was changed is made again.
        (run / "report.html").write_text("scribbled over")
        result = enfilade("solve", run, "--resume", "--rooms", "--target-error", "0.2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Rooms", (run / "report.html").read_text(encoding="utf-8"))
        # A smaller error is a reason to go on.
        result = enfilade("solve", run, "--resume", "--target-error", "0.001", "--no-pictures")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("left as it is", result.stderr)

    def test_a_report_takes_the_pictures_that_there_are(self):
        run = self.scratch / "run"
        content = self.write("scene.json", scene(prism(box(0, 0, 5, 4), 0, 3, 0.5, 50.0, "room"), rooms=[
            {"name": "seven", "bbox": [[0, 0, 0], [5, 4, 3]]}]))
        self.assertEqual(enfilade("solve", content, "-o", run).returncode, 0)
        page = self.scratch / "report.html"
        self.assertEqual(enfilade("report", run, "-o", page).returncode, 0)
        html = page.read_text(encoding="utf-8")
        self.assertLess(html.index("seven"), html.index('<div class="tiles">'))
        pictures = re.findall(r'src="data:image/png;base64,([^"]*)"', html)
        own = re.findall(r'src="data:image/png;base64,([^"]*)"', (run / "report.html").read_text(encoding="utf-8"))
        self.assertEqual(pictures, own)
        self.assertGreater(len(pictures), 0)


if __name__ == "__main__":
    cli_test.ENFILADE = sys.argv.pop(1)
    unittest.main()
