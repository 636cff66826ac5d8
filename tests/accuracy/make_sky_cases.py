"""Writes the scenes of CIE 171:2006, sections 5.9 to 5.14 (light of the sky through openings), into data/, each with the
light at its probes: the integral over the opening of luminance x transmittance x cosines / distance^2, by midpoints of a
fine grid. Written apart from the program: of it only the scene's format is known here.

usage: make_sky_cases.py FOLDER
"""
import json
import math
import os
import sys

HORIZONTAL = 10000.0  # lx, of the sky
STANDARD = {12: (-1.0, -0.32, 10.0, -3.0, 0.45), 3: (1.1, -0.8, 0.0, -1.0, 0.0)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def plus(a, b, scale=1.0):
    return tuple(p + scale * q for p, q in zip(a, b))


def shape(kind, sun):
    """Returns the relative luminance as a function of a unit vector."""
    if kind == "overcast":
        return lambda w: 1.0 + 2.0 * w[2]
    a, b, c, d, e = STANDARD[kind]

    def luminance(w):
        value = 1.0 + a * math.exp(b / max(w[2], 1e-6))
        if c == 0.0:
            return value
        cosine = max(-1.0, min(1.0, dot(w, sun)))
        return value * (1.0 + c * (math.exp(d * math.acos(cosine)) - math.exp(d * math.pi / 2)) + e * cosine ** 2)
    return luminance


def horizontal(luminance, n=400):
    """The integral of luminance x cosine over the hemisphere, by midpoints in sine squared and azimuth."""
    total = 0.0
    for i in range(n):
        s2 = (i + 0.5) / n
        s, c = math.sqrt(s2), math.sqrt(1 - s2)
        for k in range(n):
            turn = 2 * math.pi * (k + 0.5) / n
            total += luminance((s * math.cos(turn), s * math.sin(turn), c))
    return math.pi * total / n ** 2


def glass(cosine, normal):
    """A clear single pane, by Fresnel's equations for index 1.52, scaled to its normal transmittance."""
    def slab(c):
        t = math.sqrt(1 - (1 - c * c) / 1.52 ** 2)
        rs, rp = ((c - 1.52 * t) / (c + 1.52 * t)) ** 2, ((1.52 * c - t) / (1.52 * c + t)) ** 2
        return 0.5 * ((1 - rs) / (1 + rs) + (1 - rp) / (1 + rp))
    return normal * slab(abs(cosine)) / slab(1.0)


class Case:
    """A black room of 4 x 4 x 3 m with one opening."""

    def __init__(self, opening, kind, tau=None, ground=0.0, masks=(), sun=None):
        self.opening, self.kind, self.tau, self.ground, self.masks, self.sun = opening, kind, tau, ground, masks, sun
        direction = None
        if sun is not None:
            h, a = math.radians(sun["elevation"]), math.radians(sun["azimuth"])
            direction = (math.cos(h) * math.sin(a), math.cos(h) * math.cos(a), math.sin(h))
        self.relative = shape(kind, direction)
        self.scale = HORIZONTAL / horizontal(self.relative)

    def luminance(self, x, w):
        """Of what a ray from x along w ends on, outside."""
        for o, u, v in self.masks:
            n = cross(u, v)
            across = dot(w, n)
            if across == 0.0:
                continue
            t = dot(plus(o, x, -1.0), n) / across
            p = plus(plus(x, w, t), o, -1.0)
            if t > 0 and 0 <= dot(p, u) <= dot(u, u) and 0 <= dot(p, v) <= dot(v, v):
                return 0.0
        return self.scale * self.relative(w) if w[2] > 0 else self.ground * HORIZONTAL / math.pi

    def light(self, x, n):
        o, u, v = self.opening
        m = cross(u, v)
        area = math.sqrt(dot(m, m))
        steps = 600 if self.masks else 240
        total = 0.0
        for i in range(steps):
            for k in range(steps):
                y = plus(plus(o, u, (i + 0.5) / steps), v, (k + 0.5) / steps)
                d = plus(y, x, -1.0)
                r2 = dot(d, d)
                r = math.sqrt(r2)
                received = dot(d, n) / r
                if received <= 0.0:
                    continue
                through = abs(dot(d, m)) / (r * area)
                value = self.luminance(x, (d[0] / r, d[1] / r, d[2] / r)) * received * through / r2
                total += value if self.tau is None else value * glass(through, self.tau)
        return total * area / steps ** 2

    def scene(self, name, description, probes):
        surfaces = [{"vertices": v, "reflectance": 0.0} for v in self.walls()]
        o, u, v = self.opening
        if self.tau is not None:
            surfaces.append({"vertices": [o, plus(o, u), plus(plus(o, u), v), plus(o, v)], "reflectance": 0.0,
                             "transmittance": self.tau, "name": "pane"})
        for a, b, c in self.masks:
            surfaces.append({"vertices": [a, plus(a, b), plus(plus(a, b), c), plus(a, c)], "reflectance": 0.0,
                             "two_sided": True, "name": "mask"})
        sky = {"type": self.kind, "horizontal_illuminance": HORIZONTAL, "ground_reflectance": self.ground}
        if self.sun:
            sky["sun"] = self.sun
        answers = [{"p": list(p), "n": list(n), "E": [self.light(p, n)]} for p, n in probes]
        answers = [probe for probe in answers if probe["E"][0] > 0.0]
        for probe in answers:
            probe["err"] = 3e-4 * probe["E"][0]
        return {"units": "m", "exitanceUnits": "lm/m2", "name": name, "description": description, "sky": sky,
                "surfaces": surfaces, "probes": answers,
                "reference": {"kind": "quadrature", "note": "midpoints of 240 x 240 parts (600 x 600 with masks) of the opening"}}

    def walls(self):
        """The room's faces, counter-clockwise seen from inside, that with the opening in four parts."""
        o, u, v = self.opening
        lo, hi = o, plus(plus(o, u), v)
        faces = [[[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], [[0, 0, 0], [0, 4, 0], [0, 4, 3], [0, 0, 3]],
                 [[4, 0, 0], [4, 0, 3], [4, 4, 3], [4, 4, 0]], [[0, 4, 0], [4, 4, 0], [4, 4, 3], [0, 4, 3]]]
        if abs(cross(u, v)[2]) > 0.5:  # in the roof
            faces.append([[0, 0, 0], [0, 0, 3], [4, 0, 3], [4, 0, 0]])
            parts = [(0, 4, 0, lo[1]), (0, 4, hi[1], 4), (0, lo[0], lo[1], hi[1]), (hi[0], 4, lo[1], hi[1])]
            faces += [[[a, c, 3], [a, d, 3], [b, d, 3], [b, c, 3]] for a, b, c, d in parts if b > a and d > c]
        else:  # in the wall y = 0
            faces.append([[0, 0, 3], [0, 4, 3], [4, 4, 3], [4, 0, 3]])
            parts = [(0, 4, 0, lo[2]), (0, 4, hi[2], 3), (0, lo[0], lo[2], hi[2]), (hi[0], 4, lo[2], hi[2])]
            faces += [[[a, 0, c], [a, 0, d], [b, 0, d], [b, 0, c]] for a, b, c, d in parts if b > a and d > c]
        return [[[float(x) for x in p] for p in face] for face in faces]


def main():
    floor = [((x, y, 0.0), (0, 0, 1)) for x, y in ((0.5, 0.5), (1.0, 1.0), (2.0, 0.5), (2.0, 1.25), (2.0, 2.0), (3.5, 2.5))]
    wall = [((4.0, 2.0, z), (-1, 0, 0)) for z in (0.5, 1.5, 2.5)] + [((1.0, 4.0, 1.0), (0, -1, 0))]
    small, wide = ((1.5, 1.5, 3), (1, 0, 0), (0, 1, 0)), ((0, 0, 3), (4, 0, 0), (0, 4, 0))
    facade = ((1, 0, 1), (2, 0, 0), (0, 0, 1))
    sun = {"elevation": 60.0, "azimuth": 180.0}
    overhang = ((-20, -1.0, 2.2), (44, 0, 0), (0, 1.0, 0))
    opposite = ((-30, -6.0, -1.0), (64, 0, 0), (0, 0, 5.0))
    cases = {
        "5_9_roof": Case(small, "overcast"), "5_9_open_roof": Case(wide, "overcast"),
        "5_9_clear": Case(small, 12, sun=sun), "5_9_type_3": Case(small, 3),
        "5_10_glazed_roof": Case(small, "overcast", tau=0.88), "5_10_glazed_open_roof": Case(wide, "overcast", tau=0.88),
        "5_11_facade": Case(facade, "overcast", ground=0.3), "5_11_facade_clear": Case(facade, 12, ground=0.3, sun=sun),
        "5_12_glazed_facade": Case(facade, "overcast", tau=0.88, ground=0.3),
        "5_13_overhang": Case(facade, "overcast", ground=0.3, masks=[overhang]),
        "5_14_opposite": Case(facade, "overcast", ground=0.3, masks=[opposite]),
        "5_14_glazed_opposite": Case(facade, "overcast", tau=0.88, ground=0.3, masks=[opposite])}
    for name, case in cases.items():
        scene = case.scene("cie_" + name, "CIE 171:2006, section " + name[:4].rstrip("_").replace("_", "."), floor + wall)
        with open(os.path.join(sys.argv[1], "cie_" + name + ".json"), "w", encoding="utf-8") as file:
            json.dump(scene, file, indent=1)
        print(name, [round(p["E"][0], 2) for p in scene["probes"]])


if __name__ == "__main__":
    main()
