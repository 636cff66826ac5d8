"""Holds mean irradiances of solved scenes against form factors of pairs of polygons, known to 1e-7 or better in absolute terms: one is a
black lamp, the other a black receiver, with occluders between.

usage: form_factors_test.py ENFILADE PAIRS.json"""
import csv
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ENFILADE, PAIRS = sys.argv.pop(1), json.loads(Path(sys.argv.pop(1)).read_text())["pairs"]
SLIVER = "sliver_receiver"  # a lamp a millionth of the scene wide is left out, with a warning
STRIP = "edge_l1_w0.0001_h1"  # most of its light falls within a millimetre of the edge


def area(polygon):
    a, doubled = polygon[0], [0.0, 0.0, 0.0]
    for b, c in zip(polygon[1:], polygon[2:]):
        u, v = [p - q for p, q in zip(b, a)], [p - q for p, q in zip(c, a)]
        doubled = [doubled[i] + u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3] for i in range(3)]
    return math.hypot(*doubled) / 2


class FormFactors(unittest.TestCase):
    def solve(self, pair, *options):
        """The form factor found, the stats, and what was warned of."""
        black = {"reflectance": 0.0, "exitance": 0.0}
        surfaces = [{"vertices": pair["P"], **black, "exitance": 100.0, "name": "P"},
                    {"vertices": pair["Q"], **black, "name": "Q"}]
        surfaces += [{"vertices": polygon, **black, "two_sided": True} for polygon in pair.get("occluders", [])]
        with tempfile.TemporaryDirectory() as folder:
            scene, run = Path(folder) / "scene.json", Path(folder) / "run"
            scene.write_text(json.dumps({"format": "enfilade-scene", "version": 1, "units": "m", "surfaces": surfaces}))
            done = subprocess.run([ENFILADE, "solve", scene, "-o", run, "--no-pictures", "--target-error", "0.01", *options],
                                  capture_output=True, text=True, check=True)
            with open(run / "surfaces.csv", newline="", encoding="utf-8") as file:
                row = next(row for row in csv.DictReader(file) if row["name"] == "Q")
            stats = json.loads((run / "stats.json").read_text())
        irradiance = next(float(value) for key, value in row.items() if key.startswith("mean_irradiance"))
        return irradiance * area(pair["Q"]) / (100.0 * area(pair["P"])), stats, done.stderr

    def test_pairs(self):
        for pair in PAIRS:
            if pair["name"] in (SLIVER, STRIP):
                continue
            with self.subTest(pair["name"]):
                found, _, _ = self.solve(pair)
                self.assertAlmostEqual(found / pair["F_PQ"], 1.0, delta=1e-3)

    def test_what_is_left_out_is_told(self):
        _, _, told = self.solve(next(pair for pair in PAIRS if pair["name"] == SLIVER))
        self.assertIn("dropped", told)

    def test_what_takes_too_many_links_is_told(self):
        pair = next(pair for pair in PAIRS if pair["name"] == STRIP)
        found, stats, _ = self.solve(pair, "--patch-links", "1000")
        off = abs(found / pair["F_PQ"] - 1.0)
        self.assertGreaterEqual(stats["estimated_patch_error"], off)


if __name__ == "__main__":
    unittest.main()
