#!/usr/bin/python3
"""floors.py ENFILADE -o FILE.csv --chart FILE.png: how the time and memory of 'prepare', or of a whole solve, grow with a building.

Makes the building of the preset with more and more storeys, prepares it (with --solve, solves it on one core, without
pictures), and fits time and memory to powers of the surfaces. Seconds are of user time, for a solve of user and system
time; memory is the largest resident set. Through open windows, wings that face each other see each other over all storeys, so that the visible pairs themselves grow faster than the building; where windows are
closed, outer walls and stairwells alone do."""
import argparse
import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade")
    parser.add_argument("--preset", default="rr3425")
    parser.add_argument("--floors", type=lambda text: [int(n) for n in text.split(",")], default=[1, 3, 10],
                        help="storeys, rising (1,3,10)")
    parser.add_argument("--windows", choices=["open", "closed", "none"], default="open",
                        help="of the building; where they are closed, rooms see no other wing (open)")
    parser.add_argument("--solve", type=float, metavar="ERROR",
                        help="solve the buildings with this target error, such as 0.1")
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--chart", type=Path)
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for floors in options.floors:
            rows.append((measure_solve if options.solve is not None else measure)(options, Path(work), floors))
            print(rows[-1], flush=True)
    with options.output.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    for column in columns(options):
        print(f"{column} grows with surfaces to the power of {exponent(rows, column):.3f}")
    if options.chart:
        draw(rows, options)
    return 0


def columns(options):
    """What is fitted, with its label."""
    if options.solve is not None:
        return {"links": "links", "cpu_s": "CPU seconds", "memory_mib": "MiB"}
    return {"pairs": "visible pairs", "user_s": "user seconds", "memory_mib": "MiB"}


def measure_solve(options, work, floors):
    scene, run = make_scene(options, work, floors), work / f"{floors}"
    process = subprocess.Popen(["taskset", "-c", "0", options.enfilade, "solve", scene, "-o", run, "--no-pictures", "--quiet",
                                "--target-error", str(options.solve)], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"floors.py: solve of {floors} storeys failed")
    stats = json.loads((run / "stats.json").read_text())
    received = sum(float(row["area_m2"]) * float(row[next(k for k in row if k.startswith("mean_irradiance"))])
                   for row in csv.DictReader((run / "surfaces.csv").open(encoding="utf-8")))
    shutil.rmtree(run)
    return {"floors": floors, "surfaces": stats["surfaces"], "clusters": stats["clusters"], "links": stats["links"],
            "iterations": stats["iterations"], "estimated": round(stats["estimated_error"], 4),
            "received_a_floor": round(received / floors), "prepare_s": round(stats["prepare_s"], 1),
            "cpu_s": round(usage.ru_utime + usage.ru_stime, 1), "memory_mib": round(usage.ru_maxrss / 1024, 1)}


def make_scene(options, work, floors):
    scene = work / f"{floors}.json"
    subprocess.run([options.enfilade, "generate", "--preset", options.preset, "--floors", str(floors),
                    "--windows", options.windows, "-o", scene],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return scene


def measure(options, work, floors):
    scene, run = make_scene(options, work, floors), work / f"{floors}"
    process = subprocess.Popen([options.enfilade, "prepare", scene, "-o", run, "--no-pictures",
                                "--hierarchy", "clusters"], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL, text=True)
    table = dict(line.strip().rsplit("  ", 1) for line in process.stdout if "  " in line.strip())
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"floors.py: prepare of {floors} storeys failed")
    counts = {name: int(table[key].replace(",", "")) for name, key in
              (("surfaces", "surfaces"), ("cells", "cells"), ("clusters", "clusters"), ("pairs", "visible pairs"))
              for key in [next(k for k in table if k.strip() == key)]}
    return {"floors": floors, **counts, "user_s": round(usage.ru_utime, 2), "memory_mib": round(usage.ru_maxrss / 1024, 1)}


def exponent(rows, column):
    """Least squares of the logarithms."""
    x = [math.log(row["surfaces"]) for row in rows]
    y = [math.log(row[column]) for row in rows]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def draw(rows, options):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6, 4))
    surfaces = [row["surfaces"] for row in rows]
    for column, label in columns(options).items():
        axes.loglog(surfaces, [row[column] for row in rows], "o-",
                    label=f"{label}: surfaces to the power of {exponent(rows, column):.2f}")
    axes.set_xlabel("surfaces")
    axes.set_title(f"{'solve' if options.solve is not None else 'prepare'} of {options.preset} by storeys, windows {options.windows}")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(options.chart, dpi=110)


if __name__ == "__main__":
    sys.exit(main())
