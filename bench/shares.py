#!/usr/bin/python3
"""What the shares of N luminaires cost, in solves: the seconds that 'solve --shares' takes for them over those of the solve.

usage: shares.py ENFILADE OUT.csv [--luminaires 10,40] [--scenes SCENE.json,...] [--target-error E] [--repeats 3]

The lamps of each scene (without --scenes: of a storey of offices that is generated) are dealt out among N switches. A row has the
medians over the repeats, on one core: `solve_s` and `shares_s` (stats.json), `solves` = 1 + shares_s / solve_s, and
`limit` = 1 + 0.05 N."""
import argparse
import csv
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path


def with_switches(scene, count):
    """Deals the emitting surfaces' objects out among `count` switches."""
    objects = {}
    for surface in scene["surfaces"]:
        exitance = surface.get("exitance", 0)
        if max(exitance if isinstance(exitance, list) else [exitance]) > 0:
            objects.setdefault(surface.get("object") or surface.get("name", ""), []).append(surface)
    if len(objects) < count:
        sys.exit(f"the scene has {len(objects)} lamps, not {count}")
    for i, surfaces in enumerate(objects.values()):
        for surface in surfaces:
            surface["switch"] = f"switch {i % count}"
    return scene


def measure(enfilade, path, target_error, run):
    subprocess.run(["taskset", "-c", "0", enfilade, "solve", path, "-o", run, "--shares", "--no-pictures", "--quiet",
                    "--target-error", target_error], check=True)
    stats = json.loads((Path(run) / "stats.json").read_text())
    return {key: stats[key] for key in ("clusters", "links", "patches", "share_iterations", "share_difference", "solve_s",
                                        "shares_s")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade")
    parser.add_argument("out")
    parser.add_argument("--luminaires", default="10,40")
    parser.add_argument("--scenes", default="")
    parser.add_argument("--target-error", default="0.02")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        scenes = options.scenes.split(",") if options.scenes else []
        if not scenes:
            scenes = [os.path.join(folder, "office.json")]
            subprocess.run([options.enfilade, "generate", "--preset", "demo", "--floors", "1", "-o", scenes[0]], check=True,
                           stdout=subprocess.DEVNULL)
        for name in scenes:
            for count in map(int, options.luminaires.split(",")):
                with open(name, encoding="utf-8") as file:
                    scene = with_switches(json.load(file), count)
                path = os.path.join(folder, "scene.json")
                with open(path, "w", encoding="utf-8") as file:
                    json.dump(scene, file)
                runs = [measure(options.enfilade, path, options.target_error, os.path.join(folder, "run"))
                        for _ in range(options.repeats)]
                middle = {key: statistics.median(r[key] for r in runs) for key in runs[0]}
                rows.append({"scene": Path(name).stem, "clusters": int(middle["clusters"]), "links": int(middle["links"]),
                             "patches": int(middle["patches"]), "luminaires": count,
                             "iterations": int(middle["share_iterations"]),
                             "difference": f"{middle['share_difference']:.2g}", "solve_s": f"{middle['solve_s']:.2f}",
                             "shares_s": f"{middle['shares_s']:.2f}",
                             "solves": f"{1 + middle['shares_s'] / middle['solve_s']:.2f}",
                             "limit": f"{1 + 0.05 * count:.2f}"})
                print(*(f"{key} {value}" for key, value in rows[-1].items()), flush=True)
                with open(options.out, "w", encoding="utf-8", newline="") as file:
                    writer = csv.DictWriter(file, rows[0], lineterminator="\n")
                    writer.writeheader()
                    writer.writerows(rows)


if __name__ == "__main__":
    main()
