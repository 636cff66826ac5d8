#!/usr/bin/python3
"""enfilade generate as a user meets it: presets, descriptions, options, faults, and a furnace solved.

generate_test.py ENFILADE [unittest arguments]"""
import csv
import json
import sys
import unittest

import cli_test
from cli_test import InScratch, enfilade


class Refusals(InScratch):
    def refused(self, *args, words):
        output = self.scratch / "scene.json"
        before = self.leftovers()
        self.assert_refused(enfilade("generate", *args, "-o", output), *words)
        self.assertEqual(self.leftovers(), before)

    def test_descriptions_that_are_no_buildings(self):
        path = self.scratch / "b.json"
        for text, words in [('{"floors": "many"}', ["b.json: floors: ", "many"]),
                            ('{"wings": [{"bays": 4, "turn": 120}]}', ["b.json: wings[0]: "]),
                            ('{"furniture": {"sofa": 1}}', ["b.json: furniture.sofa: ", "picture"]),
                            ('{"furniture": {"chair": 1000}}', ["b.json: furniture.chair: ", "1000"]),
                            ('{"storeys": 2}', ['b.json: "storeys": ', "floors"]),
                            ('{"floors": 2', ["b.json: line 1:"])]:
            path.write_text(text)
            self.refused(path, words=words)

    def test_options_that_cannot_be(self):
        self.refused("--floors", "0", words=["command line: --floors: "])
        self.refused("--wings", "4:120", words=["command line: --wings: "])
        self.refused("--furniture", "lamp=3,desk=1,lamp=5", words=["command line: --furniture: ", "lamp twice"])
        self.refused("--preset", "palace", words=["--preset", "demo, rr3425"])
        self.refused("--preset", "demo", cli_test.ROOM, words=["description"])
        self.refused(self.scratch / "none.json", words=["none.json", "does not exist"])

    def test_names_that_are_no_scene(self):
        result = enfilade("generate", "--preset", "demo", "-o", self.scratch / "scene.glb")
        self.assert_refused(result, "scene.glb", ".json")


class Scenes(InScratch):
    def generated(self, *args):
        path = self.scratch / "scene.json"
        result = enfilade("generate", *args, "-o", path)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout, json.loads(path.read_text())

    def test_the_building_of_the_papers_size(self):
        told, scene = self.generated("--preset", "rr3425")
        lights = sum(s["exitance"][0] > 0 for s in scene["surfaces"])
        self.assertEqual((len(scene["surfaces"]), lights), (57786, 2000))
        self.assertRegex(told, r"surfaces +57,786")
        self.assertRegex(told, r"lights +2,000")
        self.assertEqual(scene["exitanceUnits"], "lm/m2")
        self.assertEqual(self.leftovers(), ["scene.json"])

    def test_options_change_a_description(self):
        path = self.scratch / "b.json"
        path.write_text('{"floors": 3, "wings": [{"bays": 4}], "furniture": {"lamp": 5}}')
        _, plain = self.generated(path)
        _, lower = self.generated(path, "--floors", "1", "--furniture", "chair=3", "--probes", "true")
        chairs = {s["object"] for s in lower["surfaces"] if "/chair" in s["object"]}
        lamps = {s["object"] for s in lower["surfaces"] if "/lamp" in s["object"]}
        self.assertEqual((len(chairs), len(lamps)), (3, 5))
        self.assertLess(len(lower["surfaces"]), len(plain["surfaces"]) / 2)
        self.assertEqual(len(lower["probes"]), 8)

    def test_a_dark_building_is_told(self):
        result = enfilade("generate", "--wings", "2", "-o", self.scratch / "scene.json")
        self.assertEqual(result.returncode, 0)
        self.assertIn("--furniture lamp=8", result.stderr)
        self.generated("--wings", "1", "--floors", "1", "--furniture", "lamp=8")

    def test_a_preset_is_taken_by_info(self):
        self.generated("--preset", "demo")
        result = enfilade("info", self.scratch / "scene.json")
        self.assertEqual((result.returncode, result.stderr), (0, ""))


class Furnace(InScratch):
    def test_a_furnace_has_one_light_everywhere(self):
        scene, run = self.scratch / "furnace.json", self.scratch / "run"
        enfilade("generate", "--wings", "1", "--floors", "1", "--furnace", "100", "--rotate", "20", "--furniture",
                 "lamp=2,desk=1,chair=1", "-o", scene)
        result = enfilade("solve", scene, "-o", run, "--no-pictures", ranks=2)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(run / "surfaces.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(json.loads(scene.read_text())["surfaces"]))
        area = sum(float(row["area_m2"]) for row in rows)
        for column in "mean_irradiance_0 [lx]", "mean_radiosity_0 [lm/m2]":
            off = [abs(float(row[column]) / 100 - 1) for row in rows]
            mean = sum(o * float(row["area_m2"]) for o, row in zip(off, rows)) / area
            self.assertLess(mean, 0.001, column)
            # The top of a lamp, 9 cm below its ceiling, is the hardest of all.
            self.assertLess(max(off), 0.03, column)


if __name__ == "__main__":
    cli_test.ENFILADE = sys.argv.pop(1)
    unittest.main()
