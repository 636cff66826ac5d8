#!/usr/bin/python3
"""bounds.py ENFILADE [--links N] [--seconds S] [--target-error E] SCENE.json[:REFERENCE.json] ...: do `enfilade bounds` hold the truth?

A table row a scene. Compared are, in every band: `surface_avg` of the scene file (mean irradiance by name, where a name is the only
one of its kind), and, where five or more probes of the file all have one irradiance above 0 (a furnace), each surface that a probe names;
and REFERENCE's points, area-uniform, whose mean is held against the area-weighted interval of all surfaces that reflect, with three
standard errors of that mean. A truth counts as held within the reference's own error (`err`). Widths are relative to the interval's
middle; that of the rooms is the widest of any room and band. Exit status 1 where a truth lies outside."""
import argparse
import csv
import json
import math
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade")
    parser.add_argument("scenes", nargs="+", metavar="SCENE[:REFERENCE]")
    parser.add_argument("--links", default="1000000")
    parser.add_argument("--seconds", default="120")
    parser.add_argument("--target-error", default="0.05")
    options = parser.parse_args()
    print("| scene | truths held | rooms | widest room % | median surface % | links | s | stopped |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    outside = 0
    for name in options.scenes:
        scene, _, reference = name.partition(":")
        line, missed = row(options, Path(scene), reference)
        outside += missed
        print(line, flush=True)
    return 1 if outside else 0


def row(options, path, reference):
    scene = json.loads(path.read_text())
    with tempfile.TemporaryDirectory() as folder:
        run, table = Path(folder) / "run", Path(folder) / "bounds.csv"
        solved = subprocess.run([options.enfilade, "solve", path, "-o", run, "--no-pictures", "--quiet", "--target-error",
                                 options.target_error], capture_output=True, text=True)
        if solved.returncode == 2:
            return f"| {path.stem} | refused, as it must be |  |  |  |  |  |  |", 0
        start = time.time()
        told = subprocess.run([options.enfilade, "bounds", run, "-o", table, "--links", options.links, "--seconds",
                               options.seconds], check=True, capture_output=True, text=True).stdout
        seconds = time.time() - start
        with open(table, encoding="utf-8") as lines:
            rows = [as_intervals(line) for line in csv.DictReader(lines)]
    checks = surface_checks(scene, rows) + (point_checks(scene, rows, json.loads(Path(reference).read_text())) if reference else [])
    for label, low, truth, high in [check for check in checks if not check[1] <= check[2] <= check[3]]:
        print(f"bounds.py: {path.stem}: {label}: {truth} is not in [{low}, {high}]", file=sys.stderr)
    held = sum(low <= truth <= high for _, low, truth, high in checks)
    rooms = [width(line) for line in rows if line["kind"] == "room" and line["intervals"]]
    surfaces = sorted(width(line) for line in rows if line["kind"] == "surface" and line["intervals"])
    widest = f"{100 * max(rooms):.1f}" if rooms else "no room"
    return (f"| {path.stem} | {held} of {len(checks)} | {len(rooms)} | {widest} | {100 * surfaces[len(surfaces) // 2]:.1f} | "
            f"{value_of(told, 'links')} | {seconds:.0f} | {value_of(told, 'stopped')} |"), len(checks) - held


def value_of(told, label):
    return next(line.split(label, 1)[1].strip() for line in told.splitlines() if line.strip().startswith(label + " "))


def as_intervals(line):
    low = [float(v) for k, v in line.items() if k.startswith("lower") and v]
    high = [float(v) for k, v in line.items() if k.startswith("upper") and v]
    return {"kind": line["kind"], "name": line["name"], "area": float(line["area_m2"]), "intervals": list(zip(low, high))}


def width(line):
    return max(2 * (high - low) / (high + low) if high > 0 else 0.0 for low, high in line["intervals"])


def surface_checks(scene, rows):
    """(label, low, truth, high) for each surface and band that is known."""
    counts = Counter(surface.get("name") for surface in scene["surfaces"])
    known = {entry["name"]: entry for entry in scene.get("surface_avg", [])}
    probes = [probe for probe in scene.get("probes", []) if "E" in probe and "surface" in probe]
    if not known and len(probes) >= 5 and min(probes[0]["E"]) > 0 and all(p["E"] == probes[0]["E"] for p in probes):
        known = {p["surface"]: p for p in probes}
    checks = []
    for line in rows:
        entry = known.get(line["name"]) if line["kind"] == "surface" and counts[line["name"]] == 1 else None
        if entry is None:
            continue
        for (low, high), truth in zip(line["intervals"], entry["E"]):
            off = (1e-6 + 2 * entry.get("err", 0)) * abs(truth)
            checks.append((line["name"], low - off, truth, high + off))
    return checks


def point_checks(scene, rows, reference):
    surfaces = [line for line in rows if line["kind"] == "surface"]
    lit = [line for line, surface in zip(surfaces, scene["surfaces"])
           if line["intervals"] and max(as_list(surface.get("reflectance", 0))) > 0]
    points = reference["probes"] if "reflecting_area" in reference else []
    area = sum(line["area"] for line in lit)
    checks = []
    for band in range(len(lit[0]["intervals"]) if points else 0):
        values = [point["E"][band] for point in points]
        mean = sum(values) / len(values)
        off = 3 * math.sqrt(sum((v - mean) ** 2 for v in values)) / len(values)
        low, high = (sum(line["area"] * line["intervals"][band][end] for line in lit) / area for end in (0, 1))
        checks.append((f"points, band {band}", low - off, mean, high + off))
    return checks


def as_list(value):
    return value if isinstance(value, list) else [value]


if __name__ == "__main__":
    sys.exit(main())
