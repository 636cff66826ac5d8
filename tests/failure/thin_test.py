#!/usr/bin/python3
"""Thin things between a lamp and a point: the light that numerical integration over the lamp finds.

thin_test.py ENFILADE [unittest arguments]"""
import json
import math
import sys
import unittest

import numpy as np
from rooms import box_faces, scene, surface
from solving import Solving

LAMP_Z, THINGS_Z, LAMP = 2.9, 2.0, (1.5, 2.5)  # a lamp of 1 m2 over the middle of a black room, 4 x 4 x 3 m
EXITANCE = 1000.0
SAMPLES = 1000  # of the lamp, along each side


def lying(x0, y0, x1, y1, z):
    return [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]


def strips(count, width, along_x):
    """Strips side by side below the lamp, as rectangles (x0, y0, x1, y1)."""
    middles = [LAMP[0] - 0.2 + 1.4 * (i + 0.5) / count for i in range(count)]
    across = [(m - width / 2, 1.0, m + width / 2, 3.0) for m in middles]
    return [(y0, x0, y1, x1) for x0, y0, x1, y1 in across] if along_x else across


def irradiance(p, things):
    """Stratified samples of the lamp; one counts where its line to p passes no rectangle."""
    random = np.random.default_rng(1)
    i, j = np.meshgrid(np.arange(SAMPLES), np.arange(SAMPLES))
    x = LAMP[0] + (i + random.random(i.shape)) / SAMPLES * (LAMP[1] - LAMP[0])
    y = LAMP[0] + (j + random.random(j.shape)) / SAMPLES * (LAMP[1] - LAMP[0])
    height = LAMP_Z - p[2]
    share = (THINGS_Z - p[2]) / height
    passes_x, passes_y = p[0] + share * (x - p[0]), p[1] + share * (y - p[1])
    hidden = np.zeros(x.shape, bool)
    for x0, y0, x1, y1 in things:
        hidden |= (passes_x > x0) & (passes_x < x1) & (passes_y > y0) & (passes_y < y1)
    r2 = (x - p[0]) ** 2 + (y - p[1]) ** 2 + height**2
    return EXITANCE / math.pi * np.sum(np.where(hidden, 0.0, height**2 / r2**2)) / SAMPLES**2 * (LAMP[1] - LAMP[0]) ** 2


class ThinThings(Solving):
    def assert_light(self, things):
        faces = [surface(face, 0.0, 0.0) for face in box_faces((0, 0, 0), (4, 4, 3))]
        lamp = lying(LAMP[0], LAMP[0], LAMP[1], LAMP[1], LAMP_Z)[::-1]
        faces.append(surface(lamp, 0.0, EXITANCE, name="lamp"))
        for thing in things:
            faces.append(surface(lying(*thing, THINGS_Z), 0.0, 0.0, two_sided=True))
        places = [(2, 2, 0.5), (2.05, 2, 0.5), (1.9, 2.1, 0.5), (2, 2, 0.2), (1.7, 2.2, 0), (3.2, 1.1, 0.8)]
        probes = [(p, (0, 0, 1)) for p in places]
        run, _ = self.solve(scene(faces, probes))
        for answer in json.loads((run / "probes.json").read_text())["probes"]:
            (found,), (error,), want = answer["E"], answer["error"], irradiance(answer["p"], things)
            self.assertAlmostEqual(found / want, 1.0, delta=0.01, msg=f"{len(things)} things, at {answer['p']}")
            self.assertLessEqual(abs(found - want), 4.0 * error + 1e-3 * want, f"{len(things)} things, at {answer['p']}")

    def test_no_thing(self):
        self.assert_light([])

    def test_few_strips(self):
        self.assert_light(strips(5, 0.05, False))

    def test_many_strips(self):
        self.assert_light(strips(60, 0.004, False))

    def test_wide_strips_with_gaps(self):
        self.assert_light(strips(40, 0.03, True))

    def test_mesh(self):
        self.assert_light(strips(30, 0.004, False) + strips(30, 0.004, True))


if __name__ == "__main__":
    Solving.enfilade = sys.argv.pop(1)
    unittest.main()
