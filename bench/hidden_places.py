#!/usr/bin/python3
"""hidden_places.py ENFILADE [--kinds KIND...] [--rooms N] [--first SEED] [--targets 0.1 0.02] [--paths N] [--points-table] [--judge]

Points that see the bright part of a scene through little of their hemisphere: behind a cupboard or the panel of a desk beside a bright window, in a
dark room behind a slit, on the axis of an open tube, behind a door that stands ajar. A scene is made by its kind and seed alone; it is solved and
held against closed forms and random paths as in random_rooms.py, whose columns mean the same here. --points-table prints each point.
--judge: exit status 1 where less than 95% of a kind's points are within twice their own error at a target."""
import argparse
import math
import random
import sys
import tempfile
from pathlib import Path

import numpy as np

from random_rooms import box, judged, solve, surface
from room_paths import Room

SIDES = ("floor", "ceiling", "south", "north", "west", "east")


def room_sides(w, d, h, reflectances, skip=()):
    return [surface(name, side[::-1], r) for name, side, r in zip(SIDES, box((0, 0, 0), (w, d, h)), reflectances) if name not in skip]


def wall_with_opening(name, x, d, h, opening, reflectance):
    """A wall across x, seen from both sides, around an opening (y0, y1, z0, z1)."""
    y0, y1, z0, z1 = opening
    parts = [(0, y0, 0, h), (y1, d, 0, h), (y0, y1, 0, z0), (y0, y1, z1, h)]
    return [surface(f"{name} {i}", [[x, a, e], [x, b, e], [x, b, f], [x, a, f]], reflectance, two_sided=True)
            for i, (a, b, e, f) in enumerate(parts) if b - a > 1e-6 and f - e > 1e-6]


def lamp(x, y, z, a, b, exitance=100.0):
    return surface("lamp", [[x - a, y - b, z], [x - a, y + b, z], [x + a, y + b, z], [x + a, y - b, z]], 0.0, exitance)


def furniture(rng):
    """A cupboard, or a desk with a panel, close to the wall of a bright window; points in the gap behind it, on its back and on the wall."""
    w, d, h = rng.uniform(3, 5), rng.uniform(3, 5), rng.uniform(2.4, 3)
    surfaces = room_sides(w, d, h, [round(rng.uniform(0.2, 0.8), 2) for _ in range(6)])
    wide, y = rng.uniform(0.8, 1.6), rng.uniform(1.2, d - 1.2)
    low, high = rng.uniform(0.8, 1.1), rng.uniform(1.8, 2.2)
    surfaces.append(surface("window", [[0.01, y - wide / 2, low], [0.01, y + wide / 2, low], [0.01, y + wide / 2, high], [0.01, y - wide / 2, high]], 0.0, 1000.0))
    gap, side = rng.uniform(0.12, 0.3), rng.choice((-1, 1))
    at = y + side * rng.uniform(0.0, wide)
    lo, hi = at - rng.uniform(0.3, 0.8), at + rng.uniform(0.3, 0.8)
    lo, hi = max(lo, 0.05), min(hi, d - 0.05)
    if rng.random() < 0.5:
        top = rng.uniform(0.7, min(1.9, h - 0.3))
        parts = box((gap, lo, 0.02), (gap + 0.45, hi, top))
        surfaces += [surface("cupboard", p, round(rng.uniform(0.3, 0.7), 2)) for p in parts]
    else:
        top = 0.72
        surfaces.append(surface("panel", [[gap, lo, 0.15], [gap, hi, 0.15], [gap, hi, top], [gap, lo, top]], 0.5, two_sided=True))
        surfaces += [surface("desk", p, 0.5) for p in box((gap - 0.08, lo - 0.05, top + 0.001), (gap + 0.75, hi + 0.05, top + 0.03))]
    points = []
    for _ in range(8):
        q, e = rng.uniform(lo + 0.05, hi - 0.05), rng.uniform(0.2, top - 0.05)
        points.append(rng.choice((((gap - 0.1, q, e), (1, 0, 0)), ((gap - 0.1, q, e), (-1, 0, 0)), ((gap - rng.uniform(0.03, 0.1), q, e), (0, 0, 1)),
                                  ((0.0, q, e), (1, 0, 0)), ((gap, q, e), (-1, 0, 0)), ((gap * rng.uniform(0.2, 0.8), q, 0.0), (0, 0, 1)))))
    return surfaces, points


def slit(rng):
    """A dark room behind a wall with a slit of 1 to 4 cm; a lamp in the other room."""
    w, d, h, x = rng.uniform(5, 7), rng.uniform(3, 4), rng.uniform(2.4, 2.8), rng.uniform(2.2, 3.2)
    surfaces = room_sides(w, d, h, [round(rng.uniform(0.2, 0.8), 2) for _ in range(6)])
    wide, y = rng.uniform(0.01, 0.04), rng.uniform(0.5, d - 0.5)
    opening = (y, y + wide, 0.0, rng.uniform(1.8, h)) if rng.random() < 0.6 else (y * 0.5, min(d - 0.3, 0.5 * y + 1.0), 0.0, wide)
    surfaces += wall_with_opening("wall", x, d, h, opening, 0.5)
    surfaces.append(lamp(rng.uniform(0.8, x - 0.8), rng.uniform(0.8, d - 0.8), h - 0.05, 0.3, 0.3))
    points = []
    for _ in range(8):
        p, n = rng.choice((((0, 0, 0), (0, 0, 1)), ((0, 0, 0.8), (0, 0, 1)), ((0, 0, 1.2), (-1, 0, 0)), ((0, 0, h), (0, 0, -1))))
        points.append(((rng.uniform(x + 0.2, w - 0.2), rng.uniform(0.2, d - 0.2), p[2]), n))
    return surfaces, points


def tube(rng):
    """An open tube in a room with a lamp; points on its axis."""
    w, d, h = rng.uniform(4, 5), rng.uniform(3, 4), rng.uniform(2.4, 3)
    surfaces = room_sides(w, d, h, [round(rng.uniform(0.2, 0.8), 2) for _ in range(6)])
    sides, radius, length = rng.choice((4, 6, 8, 12)), rng.uniform(0.05, 0.3), rng.uniform(0.6, 2.0)
    c = np.array([rng.uniform(0.4, w - length - 0.4), rng.uniform(0.6, d - 0.6), rng.uniform(0.5, h - 0.7)])
    rho = round(rng.uniform(0.1, 0.8), 2)
    ring = [c + [0, radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides)] for i in range(sides)]
    for a, b in zip(ring, ring[1:] + ring[:1]):
        surfaces.append(surface("tube", [a, b, b + [length, 0, 0], a + [length, 0, 0]], rho, two_sided=True))
    surfaces.append(lamp(rng.uniform(0.6, w - 0.6), rng.uniform(0.6, d - 0.6), h - 0.05, rng.uniform(0.1, 0.4), rng.uniform(0.1, 0.4)))
    points = []
    for _ in range(8):
        s = rng.uniform(0.1, 0.9) * length
        n = rng.choice(((1, 0, 0), (-1, 0, 0), (0, 0, 1), (0, 0, -1), (0, 1, 0)))
        points.append((tuple(c + [s, 0, 0]), n))
    return surfaces, points


def door(rng):
    """Two rooms and a door that stands ajar by 2 to 60 degrees; points just behind the door and in the dark room."""
    w, d, h, x = rng.uniform(5, 7), rng.uniform(3, 4), rng.uniform(2.4, 2.8), rng.uniform(2.4, 3.2)
    surfaces = room_sides(w, d, h, [round(rng.uniform(0.2, 0.8), 2) for _ in range(6)])
    y, wide = rng.uniform(0.4, d - 1.5), 0.9
    surfaces += wall_with_opening("wall", x, d, h, (y, y + wide, 0.0, 2.0), 0.5)
    angle = math.radians(rng.uniform(2, 60))
    u = np.array([math.sin(angle), math.cos(angle), 0.0])  # along the leaf, from its hinge
    hinge = np.array([x + 0.01, y, 0.0])
    leaf = [hinge + 0.01 * u, hinge + 0.89 * u, hinge + 0.89 * u + [0, 0, 1.99], hinge + 0.01 * u + [0, 0, 1.99]]
    leaf = [p + [0, 0, 0.005] for p in leaf]
    surfaces.append(surface("door", leaf, 0.6, two_sided=True))
    surfaces.append(lamp(rng.uniform(0.8, x - 0.8), rng.uniform(0.8, d - 0.8), h - 0.05, 0.3, 0.3))
    behind = np.array([math.cos(angle), -math.sin(angle), 0.0])  # away from the lamp's room
    points = []
    for _ in range(8):
        off, s, z = rng.uniform(0.02, 0.2), rng.uniform(0.1, 0.8), rng.uniform(0.1, 1.9)
        p = hinge + s * u + off * behind
        choice = rng.randrange(4)
        if choice == 0:
            points.append(((p[0], p[1], 0.0), (0, 0, 1)))
        elif choice == 1:
            points.append(((p[0], p[1], z), tuple(-behind)))
        elif choice == 2:
            points.append(((p[0], p[1], z), (0, 0, 1)))
        else:
            q = hinge + s * u + [0, 0, z]
            points.append((tuple(q), tuple(behind)))
    return surfaces, [(p, n) for p, n in points if 0 <= p[1] <= d and x < p[0] < w]


KINDS = {"furniture": furniture, "slit": slit, "tube": tube, "door": door}


def make(kind, seed):
    return KINDS[kind](random.Random(1000 * list(KINDS).index(kind) + seed))


def reference(surfaces, points, paths, seed):
    room, rng = Room(surfaces), np.random.default_rng(seed)
    x, n = (np.array([p[i] for p in points], float) for i in (0, 1))
    direct = np.array([room.direct(p + 1e-7 * m, m) for p, m in zip(x, n)])
    reflected, error = room.reflected(x, n, paths, rng)
    return direct + reflected, error


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade")
    parser.add_argument("--kinds", nargs="+", default=list(KINDS), choices=list(KINDS))
    parser.add_argument("--rooms", type=int, default=10)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--targets", type=float, nargs="+", default=[0.1, 0.02])
    parser.add_argument("--paths", type=int, default=20000)
    parser.add_argument("--points-table", action="store_true")
    parser.add_argument("--judge", action="store_true")
    options = parser.parse_args()
    rows = []
    for kind in options.kinds:
        for seed in range(options.first, options.first + options.rooms):
            surfaces, points = make(kind, seed)
            true, sigma = reference(surfaces, points, options.paths, seed)
            probes = [{"p": [float(c) for c in p], "n": [float(c) for c in n]} for p, n in points]
            for target in options.targets:
                with tempfile.TemporaryDirectory() as folder:
                    found, error, stats, seconds = solve(options.enfilade, Path(folder), surfaces, probes, target)
                row = judged(true, sigma, found, error, stats, target)
                rows.append({"kind": kind, "target": target, "z": np.abs(found - true) / np.hypot(error, sigma), **row})
                print(f"{kind} {seed}, target {target:g}: within {row['within']:.3f}, converged {row['converged']}, {seconds:.1f} s", file=sys.stderr,
                      flush=True)
                for p, t, s, f, e in zip(points, true, sigma, found, error):
                    if options.points_table:
                        print(f"  {np.round(p[0], 3)} {np.round(p[1], 2)} true {t:.4g} +- {100 * s / t:.2f}%, found {100 * (f / t - 1):+.2f}%, "
                              f"told {100 * e / t:.2f}%")
    print("| kind | target | points | within | 95% of |found - true| over the error |")
    print("| --- | --- | --- | --- | --- |")
    good = True
    for kind in options.kinds:
        for target in options.targets:
            some = [r for r in rows if r["kind"] == kind and r["target"] == target]
            z = np.concatenate([r["z"] for r in some])
            within = float(np.average([r["within"] for r in some], weights=[len(r["z"]) for r in some]))
            print(f"| {kind} | {target:g} | {len(z)} | {100 * within:.1f}% | {np.quantile(z, 0.95):.2f} |")
            good &= within >= 0.95
    return 0 if good or not options.judge else 1


if __name__ == "__main__":
    sys.exit(main())
