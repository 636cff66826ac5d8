#!/usr/bin/python3
"""Makes form_factors.json: form factors of polygons, open and obstructed, to 1e-10 or better. What they are and how they are computed stands in
README.md. It takes about two minutes.

usage: make_form_factors.py [NAME ...] > form_factors.json     (with names: those alone)"""
import json
import random
import sys

import numpy as np

from exact_factors import area, lambert, normal, pair_factor, point_factor, shadows_overlap

LARGEST_ERROR = 1e-10


def rectangle(lo, hi, z, up=True):
    corners = [[lo[0], lo[1], z], [hi[0], lo[1], z], [hi[0], hi[1], z], [lo[0], hi[1], z]]
    return corners if up else corners[::-1]


def turned(polygon, axis, degrees, about=(0, 0, 0)):
    """Rodrigues' rotation."""
    k, t, o = np.asarray(axis, float) / np.linalg.norm(axis), np.radians(degrees), np.asarray(about, float)
    v = np.asarray(polygon, float) - o
    return (o + v * np.cos(t) + np.cross(k, v) * np.sin(t) + np.outer(v @ k, k) * (1 - np.cos(t))).tolist()


def moved(polygon, by):
    return (np.asarray(polygon, float) + by).tolist()


def ring(corners, radius, z, up=True, start=0.1):
    turns = start + 2 * np.pi * np.arange(corners) / corners
    points = [[radius * np.cos(t), radius * np.sin(t), z] for t in turns]
    return points if up else points[::-1]


UNIT = rectangle((0, 0), (1, 1), 0)
LID = rectangle((0, 0), (1, 1), 1, up=False)
WALL = [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]  # y = 0, facing +y: shares an edge with UNIT


def bars(count, width, lo, hi, z, across=(-1, 2)):
    """Strips along y in the plane z."""
    pitch = (hi - lo) / count
    return [rectangle((lo + (i + 0.5) * pitch - width / 2, across[0]), (lo + (i + 0.5) * pitch + width / 2, across[1]), z)
            for i in range(count)]


def mesh(count, width, z):
    """A net of wires in one plane, cut into rectangles that touch and do not overlap."""
    places = [(i + 0.5) / count for i in range(count)]
    ends = [-0.5] + places + [1.5]
    whole = [rectangle((x - width / 2, -0.5), (x + width / 2, 1.5), z) for x in places]
    for y in places:
        for i, (a, b) in enumerate(zip(ends, ends[1:])):
            whole.append(rectangle((a + (width / 2 if i else 0), y - width / 2), (b - (width / 2 if i < count else 0), y + width / 2), z))
    return whole


def wall_with_hole(lo, hi, hole_lo, hole_hi, z):
    return [piece for piece in (rectangle((lo, lo), (hole_lo[0], hi), z), rectangle((hole_hi[0], lo), (hi, hi), z),
                                rectangle((hole_lo[0], lo), (hole_hi[0], hole_lo[1]), z), rectangle((hole_lo[0], hole_hi[1]), (hole_hi[0], hi), z))
            if area(piece) > 0]


def open_pairs():
    yield "opposed", UNIT, LID
    yield "opposed_gap_of_10_mm", UNIT, rectangle((0, 0), (1, 1), 0.01, up=False)
    yield "opposed_far", UNIT, rectangle((0, 0), (1, 1), 50, up=False)
    yield "opposed_offset", UNIT, rectangle((1.5, 0.5), (4, 1.25), 0.7, up=False)
    yield "edge_90", UNIT, WALL
    for degrees in (5, 30, 150, 178):
        yield f"edge_{degrees}", UNIT, turned(WALL, (1, 0, 0), degrees - 90)
    yield "edge_half_shared", UNIT, moved(WALL, (0.5, 0, 0))
    yield "corner_touching", UNIT, moved(WALL, (1, 0, 0))
    yield "corner_to_corner", UNIT, moved(turned(WALL, (0, 0, 1), 135), (1, 1, 0))
    yield "triangle_and_hexagon", ring(3, 0.8, 0), ring(6, 0.5, 0.6, up=False)
    yield "coaxial_12gons", ring(12, 1, 0), ring(12, 0.5, 0.5, up=False)
    yield "pentagon_turned_to_12gon", ring(5, 0.7, 0), moved(turned(ring(12, 0.6, 0, up=False), (1, 2, 0.5), 37), (0.6, -0.4, 1.1))
    yield "receiver_partly_behind", rectangle((-1, -1), (1, 1), 0), [[0.2, -0.3, 0.1], [0.2, 0.4, 0.1], [0.2, 0.4, 0.9], [0.2, -0.3, 0.9]]
    yield "shooter_partly_below", UNIT, [[1.2, 0, -0.5], [1.2, 0, 0.5], [1.2, 1, 0.5], [1.2, 1, -0.5]]
    yield "each_partly_behind", UNIT, turned([[0.4, 0, -0.6], [0.4, 0, 0.6], [0.4, 1, 0.6], [0.4, 1, -0.6]], (0, 1, 0.2), 25, (0.5, 0.5, 0))
    yield "receiver_behind", UNIT, rectangle((0, 0), (1, 1), 1)
    yield "shooter_below", UNIT, rectangle((0, 0), (1, 1), -1, up=False)
    yield "nearly_parallel", UNIT, turned(LID, (1, 0.3, 0), 1, (0.5, 0.5, 1))
    yield "nearly_coplanar", UNIT, turned(moved(rectangle((0, 0), (1, 1), 0), (1.2, 0, 0)), (0, 1, 0), -3, (1.2, 0, 0))
    yield "tiny_shooter", UNIT, rectangle((0.3, 0.6), (0.301, 0.601), 0.2, up=False)
    yield "tiny_receiver_huge_shooter", rectangle((0, 0), (0.01, 0.01), 0), rectangle((-50, -80), (100, 70), 3, up=False)
    yield "long_strip", UNIT, rectangle((-5, 0.45), (5, 0.55), 0.5, up=False)


def random_pairs():
    rng = random.Random(5)
    for i in range(6):
        p = ring(rng.randint(3, 9), rng.uniform(0.2, 1), 0, start=rng.random())
        q = turned(ring(rng.randint(3, 9), rng.uniform(0.2, 1), 0, up=False, start=rng.random()), [rng.gauss(0, 1) for _ in range(3)], rng.uniform(-60, 60))
        yield f"random_{i}", p, moved(q, (rng.uniform(-0.7, 0.7), rng.uniform(-0.7, 0.7), rng.uniform(0.6, 1.6)))


def obstructed_pairs():
    yield "half_hidden", UNIT, LID, [rectangle((-1, -1), (0.5, 2), 0.5)]
    yield "square_between", UNIT, LID, [rectangle((0.3, 0.35), (0.6, 0.55), 0.4)]
    yield "triangle_between", UNIT, LID, [moved(ring(3, 0.2, 0), (0.7, 0.4, 0.7))]
    yield "octagon_between", UNIT, LID, [moved(ring(8, 0.25, 0), (0.4, 0.6, 0.3))]
    yield "all_hidden", UNIT, LID, [rectangle((-0.5, -0.5), (1.5, 1.5), 0.5)]
    yield "bar_of_10_mm", UNIT, LID, [rectangle((0.5, -1), (0.51, 2), 0.5)]
    yield "upright_sheet", UNIT, LID, [[[0.4, -1, 0.2], [0.4, 2, 0.2], [0.4, 2, 0.8], [0.4, -1, 0.8]]]
    yield "slats_11_of_10_mm", UNIT, LID, bars(11, 0.01, 0, 1, 0.6)
    yield "slats_half_closed", UNIT, LID, bars(6, 1 / 12, 0, 1, 0.5)
    yield "slats_nearly_closed", UNIT, LID, bars(5, 0.19, -0.5, 1.5, 0.5)
    yield "mesh_3_by_3", UNIT, LID, mesh(3, 0.02, 0.7)
    yield "door", moved(UNIT, (0, 0, -1)), rectangle((0.2, 0.1), (1.6, 0.9), 1.4, up=False), wall_with_hole(-1, 2, (0.2, -1), (0.7, 0.8), 0)
    yield "window", UNIT, LID, wall_with_hole(-1, 2, (0.3, 0.2), (0.6, 0.8), 0.5)
    yield "slit_of_5_mm", UNIT, LID, wall_with_hole(-1, 2, (0.4, -1), (0.405, 2), 0.5)
    yield "pinhole", UNIT, LID, wall_with_hole(-1, 2, (0.52, 0.47), (0.53, 0.48), 0.5)
    yield "sheet_from_the_shooter", UNIT, LID, [[[0, 0.2, 1], [1, 0.2, 1], [1, 0.2, 0.7], [0, 0.2, 0.7]]]
    yield "partition_on_the_receiver", UNIT, LID, [[[0.3, 0, 0], [0.3, 1, 0], [0.3, 1, 0.4], [0.3, 0, 0.4]]]
    yield "sheet_through_the_receiver", UNIT, LID, [[[0.6, 0.2, -0.3], [0.6, 0.8, -0.3], [0.6, 0.8, 0.3], [0.6, 0.2, 0.3]]]
    yield "sheet_through_the_shooter", UNIT, LID, [turned([[0.6, 0.2, 0.8], [0.6, 0.8, 0.8], [0.6, 0.8, 1.3], [0.6, 0.2, 1.3]], (0, 1, 0), 20, (0.6, 0.5, 1))]
    yield "close_to_the_receiver", UNIT, LID, [rectangle((0.2, 0.2), (0.8, 0.8), 0.01)]
    yield "turned_in_space", turned(UNIT, (1, 2, 3), 40), turned(LID, (1, 2, 3), 40), [turned(o, (1, 2, 3), 40) for o in bars(3, 0.1, 0, 1, 0.5)]
    yield "edge_with_a_sheet", UNIT, WALL, [turned(rectangle((0.2, 0.2), (0.8, 0.5), 0.3), (1, 0, 0), 30, (0.5, 0.3, 0.3))]
    yield "out_of_the_way", UNIT, LID, [rectangle((1.2, 0), (2, 1), 0.5), rectangle((0, 0), (1, 1), -0.1), rectangle((0, 0), (1, 1), 1.1)]


def crate(lo, hi):
    """Six sides of a box."""
    (a, b, c), (d, e, f) = lo, hi
    return [rectangle((a, b), (d, e), c), rectangle((a, b), (d, e), f)] + \
        [[[x, b, c], [x, e, c], [x, e, f], [x, b, f]] for x in (a, d)] + [[[a, y, c], [d, y, c], [d, y, f], [a, y, f]] for y in (b, e)]


def louvre(count, degrees, z):
    return [turned(rectangle(((i + 0.5) / count - 0.4 / count, -0.3), ((i + 0.5) / count + 0.4 / count, 1.3), z), (0, 1, 0), degrees,
                   ((i + 0.5) / count, 0, z)) for i in range(count)]


def stairs(steps):
    """Treads from x = 0 up to x = 1 and two rows of balusters on them."""
    parts = []
    for i in range(steps):
        x, z = i / steps, 0.15 + 0.5 * i / steps
        parts.append(rectangle((x, 0.1), (x + 1 / steps, 0.9), z))
        parts += [[[x + 0.3 / steps, y, z], [x + 0.34 / steps, y + 0.004, z], [x + 0.34 / steps, y + 0.004, z + 0.3], [x + 0.3 / steps, y, z + 0.3]]
                  for y in (0.15, 0.85)]
    return parts


def leaves(count, seed):
    rng = random.Random(seed)
    return [moved(turned(ring(rng.randint(3, 6), rng.uniform(0.02, 0.06), 0), [rng.gauss(0, 1) for _ in range(3)], rng.uniform(0, 180)),
                  (rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0.2, 0.9))) for _ in range(count)]


def points():
    up, x = [0, 0, 1], [0.37, 0.58, 0]
    tilted = (np.asarray([1, -2, 4]) / np.sqrt(21)).tolist()
    yield "point_below", x, up, LID, []
    yield "point_below_tilted", x, tilted, LID, []
    yield "point_at_1_mm", [0.37, 0.58, 0.999], up, LID, []
    yield "point_at_the_edge", [0.5, 1e-6, 0], up, WALL, []
    yield "point_at_a_corner", [1e-4, 1e-4, 0], up, WALL, []
    yield "point_across_the_horizon", [0.4, 0.7, 0.3], up, WALL, []
    yield "point_in_its_plane", [1.5, 0.5, 1], [-1, 0, 0], LID, []
    yield "point_behind_it", [0.5, 0.5, 2], [0, 0, -1], LID, []
    yield "point_below_a_12gon", [0.3, 0.2, 0], tilted, ring(12, 0.7, 0.4, up=False), []
    yield "point_far_from_a_sliver", [3, 4, 0], tilted, rectangle((0, 0), (2, 0.001), 5, up=False), []
    yield "point_half_hidden", [0.5, 0.5, 0], up, LID, [rectangle((0.5, -1), (2, 2), 0.5)]
    yield "point_all_hidden", x, up, LID, [rectangle((-0.5, -0.5), (1.5, 1.5), 0.5)]
    yield "point_behind_two_halves", x, up, LID, [rectangle((-1, -1), (0.4, 2), 0.5), rectangle((0.4, -1), (2, 2), 0.5)]
    yield "point_edge_on", [0.4, 0.5, 0], up, LID, [[[0.4, -1, 0.2], [0.4, 2, 0.2], [0.4, 2, 0.8], [0.4, -1, 0.8]]]
    yield "point_occluder_1_mm_below_the_shooter", x, up, LID, [rectangle((0.2, 0.2), (0.7, 0.9), 0.999)]
    yield "point_occluders_elsewhere", x, up, LID, [rectangle((0, 0), (1, 1), 1.2), rectangle((0, 0), (1, 1), -0.2), rectangle((2, 0), (3, 1), 0.5)]
    yield "point_occluder_through_the_shooter", x, up, LID, [[[0.1, 0.2, 0.6], [0.9, 0.4, 0.6], [0.9, 0.4, 1.4], [0.1, 0.2, 1.4]]]
    yield "point_overlapping_shadows", x, up, LID, [rectangle((0.2, 0.3), (0.6, 0.7), 0.4), rectangle((0.5, 0.5), (0.9, 0.8), 0.7)]
    yield "point_crate", x, up, LID, crate((0.45, 0.4, 0.2), (0.8, 0.7, 0.6))
    yield "point_slats_11", x, up, LID, bars(11, 0.01, 0, 1, 0.6)
    yield "point_slats_40", x, tilted, LID, bars(40, 0.004, 0, 1, 0.3)
    yield "point_crossed_slats", x, up, LID, bars(7, 0.03, 0, 1, 0.5) + [turned(o, (0, 0, 1), 90, (0.5, 0.5, 0)) for o in bars(7, 0.03, 0, 1, 0.55)]
    yield "point_louvre", x, up, LID, louvre(20, 60, 0.6)
    yield "point_mesh", x, up, LID, mesh(6, 0.006, 0.5)
    yield "point_stairs", [0.9, 0.3, 0], up, LID, stairs(8)
    yield "point_leaves", x, up, LID, leaves(40, 3)
    yield "point_dense_leaves", x, tilted, LID, leaves(150, 4)
    yield "point_three_doors", [0.3, 0.4, -1], up, LID, wall_with_hole(-4, 4, (0.1, 0.1), (0.6, 0.8), -0.6) + \
        wall_with_hole(-4, 4, (0.25, 0.1), (0.7, 0.8), 0) + wall_with_hole(-4, 4, (0.3, 0.2), (0.8, 0.9), 0.6)
    yield "point_pinhole", x, up, LID, wall_with_hole(-4, 4, (0.5, 0.5), (0.505, 0.505), 0.5)
    yield "point_turned", turned([x], (3, 1, 2), 70)[0], turned([up], (3, 1, 2), 70)[0], turned(LID, (3, 1, 2), 70), \
        [turned(o, (3, 1, 2), 70) for o in leaves(12, 5) + bars(4, 0.05, 0, 1, 0.1)]


def main():
    named, found = set(sys.argv[1:]), []
    for name, x, n, q, occluders in points():
        if named and name not in named:
            continue
        factor, moment = point_factor(x, n, q, occluders)
        error = abs(factor - moment[0])  # Lambert's sum against the integral of the kernel
        found.append({"name": name, "x": x, "n": n, "Q": q, "occluders": occluders, "F": 0.0 if abs(factor) < 1e-15 else factor, "moment": moment[1:].tolist(), "error": error})
    rng = np.random.default_rng(1)
    pairs = [(*pair, []) for pair in (*open_pairs(), *random_pairs())] + list(obstructed_pairs())
    for name, p, q, occluders in pairs:
        if named and name not in named:
            continue
        if shadows_overlap(np.asarray(p, float), np.asarray(q, float), occluders, rng) > 1e-12:
            sys.exit(f"{name}: shadows overlap, so that what two occluders hide would count twice")
        factor, error = pair_factor(p, q, occluders)
        found.append({"name": name, "P": p, "Q": q, "occluders": occluders, "F_PQ": 0.0 if abs(factor) < 1e-15 else factor, "error": error})
    bad = [entry["name"] for entry in found if entry["error"] > LARGEST_ERROR]
    if bad:
        sys.exit(f"not known to {LARGEST_ERROR}: {', '.join(bad)}")
    print(json.dumps({"note": "made by make_form_factors.py; see README.md", "largest_error": LARGEST_ERROR}, indent=0)[:-2] + ',\n"pairs": [')
    print(",\n".join(json.dumps(entry) for entry in found) + "\n]}")


if __name__ == "__main__":
    main()
