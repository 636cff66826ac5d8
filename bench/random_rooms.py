#!/usr/bin/python3
"""random_rooms.py ENFILADE [--rooms N] [--first SEED] [--targets 0.1 0.02 0.005] [--points N] [--paths N] [--judge]

Random small rooms with random thin things in them (a louvre of slats, rods, a wire mesh, a grille, stairs with balusters, a plant; one kind a room,
in turn), solved by Enfilade to each target error, and held against closed forms and random paths (room_paths.py, which shares no code with it) at
random points of all surfaces. A room is made by its seed alone.

Of the table: `within`: points whose irradiance is within twice their own "error" (the reference's standard error added in quadrature); `L1`: the
sum of |found - true| over that of the true, less the reference's noise; `below`: of the runs that say converged, those whose L1 is below the target;
`estimate`: runs whose estimated error is at least a third of L1. --judge: exit status 1 where less than 95% of the points, all of the converged
runs, or 90% of the runs are so."""
import argparse
import json
import math
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from room_paths import Room, points_on

KINDS = ("slats", "rods", "mesh", "grille", "stairs", "plant")
MEAN_OF_NORMAL = math.sqrt(2 / math.pi)


def surface(name, vertices, reflectance, exitance=0.0, two_sided=False):
    return {"name": name, "vertices": [[round(float(c), 9) for c in p] for p in vertices], "reflectance": reflectance, "exitance": exitance,
            **({"two_sided": True} if two_sided else {})}


def box(lo, hi):
    """Outward sides."""
    (a, b, c), (d, e, f) = lo, hi
    return [[[a, b, c], [a, e, c], [d, e, c], [d, b, c]], [[a, b, f], [d, b, f], [d, e, f], [a, e, f]],
            [[a, b, c], [d, b, c], [d, b, f], [a, b, f]], [[d, e, c], [a, e, c], [a, e, f], [d, e, f]],
            [[a, e, c], [a, b, c], [a, b, f], [a, e, f]], [[d, b, c], [d, e, c], [d, e, f], [d, b, f]]]


def thin_things(kind, rng, w, d, h, lamp):
    """Polygons, seen from both sides. `lamp`: its middle and half its sides."""
    (x, y, z), a, b = lamp
    if kind == "slats":
        count, drop, tilt = rng.randint(8, 24), rng.uniform(0.1, 0.5), math.radians(rng.uniform(-70, 70))
        pitch = 2 * a / count
        u = 0.4 * pitch * math.cos(tilt), 0.4 * pitch * math.sin(tilt)
        places = [x - a + (i + 0.5) * pitch for i in range(count)]
        return [[[p - u[0], y - b, z - drop - u[1]], [p + u[0], y - b, z - drop + u[1]], [p + u[0], y + b, z - drop + u[1]],
                 [p - u[0], y + b, z - drop - u[1]]] for p in places]
    if kind == "rods":
        rods = []
        for _ in range(rng.randint(8, 16)):
            r, px, py = rng.uniform(0.004, 0.012), rng.uniform(0.3, w - 0.3), rng.uniform(0.3, d - 0.3)
            lo, hi = rng.uniform(0.02, 0.8), rng.uniform(1.2, h - 0.2)
            rods += box((px - r, py - r, lo), (px + r, py + r, hi))[2:]
        return rods
    if kind == "mesh":
        count, t, drop = rng.randint(6, 14), rng.uniform(0.002, 0.008), rng.uniform(0.1, 0.6)
        places = [(i + 0.5) / count * 2 - 1 for i in range(count)]
        level = [z - drop, z - drop - 0.004]
        return [[[x + a * p - t, y - b, level[0]], [x + a * p + t, y - b, level[0]], [x + a * p + t, y + b, level[0]], [x + a * p - t, y + b, level[0]]]
                for p in places] + \
               [[[x - a, y + b * p - t, level[1]], [x + a, y + b * p - t, level[1]], [x + a, y + b * p + t, level[1]], [x - a, y + b * p + t, level[1]]]
                for p in places]
    if kind == "grille":
        count, t, px = rng.randint(10, 24), rng.uniform(0.005, 0.02), rng.uniform(0.35, 0.65) * w
        top = rng.uniform(1.2, h - 0.3)
        return [[[px, (i + 0.5) / count * d - t, 0.05], [px, (i + 0.5) / count * d + t, 0.05], [px, (i + 0.5) / count * d + t, top],
                 [px, (i + 0.5) / count * d - t, top]] for i in range(count)]
    if kind == "stairs":
        steps, px, py, t = rng.randint(6, 10), rng.uniform(0.2, 0.4), rng.uniform(0.2, 0.4) * d, 0.008
        parts = []
        for i in range(steps):
            s, level = px + 0.27 * i, 0.18 * (i + 1)
            parts.append([[s, py, level], [s + 0.25, py, level], [s + 0.25, py + 0.8, level], [s, py + 0.8, level]])
            parts += [[[s + 0.1, q - t, level + 0.01], [s + 0.1, q + t, level + 0.01], [s + 0.1, q + t, level + 0.6], [s + 0.1, q - t, level + 0.6]]
                      for q in (py + 0.05, py + 0.75)]
        return [p for p in parts if max(c[2] for c in p) < h - 0.1 and max(c[0] for c in p) < w - 0.1]
    leaves, middle = [], (rng.uniform(0.3, 0.7) * w, rng.uniform(0.3, 0.7) * d)
    for _ in range(rng.randint(30, 60)):
        p = np.array([middle[0] + rng.gauss(0, 0.15), middle[1] + rng.gauss(0, 0.15), rng.uniform(0.4, 1.3)])
        u, v = np.array([rng.gauss(0, 1) for _ in range(3)]), np.array([rng.gauss(0, 1) for _ in range(3)])
        u /= np.linalg.norm(u)
        v -= u * (u @ v)
        v /= np.linalg.norm(v)
        long, wide = rng.uniform(0.05, 0.12), rng.uniform(0.015, 0.04)
        leaves.append([p - long * u, p + wide * v, p + long * u, p - wide * v])
    return leaves


def make_room(seed):
    rng = random.Random(seed)
    kind = KINDS[seed % len(KINDS)]
    w, d, h = rng.uniform(2.5, 5), rng.uniform(2.5, 5), rng.uniform(2.3, 3.2)
    names = ("floor", "ceiling", "south", "north", "west", "east")
    surfaces = [surface(name, side[::-1], round(rng.uniform(0.15, 0.8), 2)) for name, side in zip(names, box((0, 0, 0), (w, d, h)))]
    a, b = rng.uniform(0.15, 0.6), rng.uniform(0.15, 0.6)
    x, y, z = rng.uniform(a + 0.1, w - a - 0.1), rng.uniform(b + 0.1, d - b - 0.1), h - rng.uniform(0.03, 0.2)
    surfaces.append(surface("lamp", [[x - a, y - b, z], [x - a, y + b, z], [x + a, y + b, z], [x + a, y - b, z]], 0.0, 100.0))
    if rng.random() < 0.5:  # a cupboard
        p, q = rng.uniform(0.1, w - 1.0), rng.uniform(0.1, d - 0.8)
        for side in box((p, q, 0.05), (p + rng.uniform(0.3, 0.8), q + rng.uniform(0.3, 0.6), rng.uniform(0.5, 1.2))):
            surfaces.append(surface("cupboard", side, 0.5))
    for i, polygon in enumerate(thin_things(kind, rng, w, d, h, ((x, y, z), a, b))):
        surfaces.append(surface(f"{kind} {i}", polygon, 0.4, two_sided=True))
    return kind, surfaces


def reference(surfaces, points, paths, seed):
    """Random points of what reflects, by area, in front of it: (probes, irradiance, standard error)."""
    room, rng = Room(surfaces), np.random.default_rng(seed)
    share = np.where(room.reflectance > 0, room.area, 0)
    which = rng.choice(len(surfaces), size=points, p=share / share.sum())
    x = np.array([points_on(room.polygons[k], 1, rng)[0] for k in which])
    n = room.n[which]
    direct = np.array([room.direct(p + 1e-7 * m, m) for p, m in zip(x, n)])
    reflected, error = room.reflected(x, n, paths, rng)
    return [{"p": p.tolist(), "n": m.tolist()} for p, m in zip(x, n)], direct + reflected, error


def solve(enfilade, folder, surfaces, probes, target):
    scene, run, asked, answers = (folder / name for name in ("scene.json", "run", "points.json", "answers.json"))
    scene.write_text(json.dumps({"format": "enfilade-scene", "version": 1, "units": "m", "surfaces": surfaces}))
    asked.write_text(json.dumps({"probes": probes}))
    begin = time.time()
    subprocess.run([enfilade, "solve", scene, "-o", run, "--no-pictures", "--quiet", "--target-error", str(target)], check=True, capture_output=True)
    subprocess.run([enfilade, "probe", run, "--points", asked, "-o", answers, "--from", "gather"], check=True, capture_output=True)
    found = json.loads(answers.read_text())["probes"]
    stats = json.loads((run / "stats.json").read_text())
    return np.array([p["E"][0] for p in found]), np.array([p["error"][0] for p in found]), stats, time.time() - begin


def judged(true, sigma, found, error, stats, target):
    off = np.abs(found - true)
    floor = 1e-4 * true.mean()  # below this nothing is seen
    l1 = max(0.0, off.sum() - MEAN_OF_NORMAL * sigma.sum()) / true.sum()
    noise = 2 * math.sqrt(float((sigma ** 2).sum())) / true.sum()  # of l1, by the reference
    return {"within": float(np.mean(off <= 2 * np.hypot(error, sigma) + floor)), "l1": l1, "noise": noise, "converged": bool(stats["converged"]),
            "estimate": stats["estimated_error"], "below": l1 <= target + noise, "covered": stats["estimated_error"] >= (l1 - noise) / 3}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade")
    parser.add_argument("--rooms", type=int, default=300)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--targets", type=float, nargs="+", default=[0.1, 0.02, 0.005])
    parser.add_argument("--points", type=int, default=40)
    parser.add_argument("--paths", type=int, default=4000)
    parser.add_argument("--judge", action="store_true")
    options = parser.parse_args()
    rows = []
    for seed in range(options.first, options.first + options.rooms):
        kind, surfaces = make_room(seed)
        probes, true, sigma = reference(surfaces, options.points, options.paths, seed)
        for target in options.targets:
            with tempfile.TemporaryDirectory() as folder:
                found, error, stats, seconds = solve(options.enfilade, Path(folder), surfaces, probes, target)
            row = judged(true, sigma, found, error, stats, target)
            rows.append({"seed": seed, "kind": kind, "target": target, "seconds": seconds, **row})
            print(f"room {seed}, {kind}, {len(surfaces)} surfaces, target {target:g}: within {row['within']:.3f}, L1 {row['l1']:.4f} +- {row['noise']:.4f}, "
                  f"estimate {row['estimate']:.4f}, converged {row['converged']}, {seconds:.1f} s", file=sys.stderr, flush=True)
    print("| target | kind | rooms | points within | converged | of these below | estimate at least a third | median L1 | largest L1 |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    good = True
    for target in options.targets:
        for kind in (*KINDS, "all"):
            some = [r for r in rows if r["target"] == target and kind in (r["kind"], "all")]
            if not some:
                continue
            within, converged = float(np.mean([r["within"] for r in some])), [r for r in some if r["converged"]]
            below, covered = sum(r["below"] for r in converged), sum(r["covered"] for r in some)
            l1 = [r["l1"] for r in some]
            print(f"| {target:g} | {kind} | {len(some)} | {100 * within:.1f}% | {len(converged)} | {below} | {covered} | {100 * np.median(l1):.2f}% | {100 * max(l1):.2f}% |")
            if kind == "all":
                good &= within >= 0.95 and below == len(converged) and covered >= 0.9 * len(some)
    return 0 if good or not options.judge else 1


if __name__ == "__main__":
    sys.exit(main())
