"""Iterations to a given bound of the iteration error, at several reflectances and numbers of (simulated) ranks, with the
coarse correction, as in RR-3425 (section 8), and by Jacobi's method.

usage: iterations.py BIN_DIRECTORY SCENE.json OUT.csv [--reflectances 0.5,0.9,0.99] [--ranks 1,2,4,8,32] [--tolerance 1e-6]
                     [--epsilon E] [--schemes corrected,paper,jacobi] [--append]

Every surface of the scene gets the reflectance; --epsilon is that of `enfilade solve`; --append keeps the rows that OUT.csv has.
Runs on SimGrid, so that many ranks need no cores."""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

SCHEMES = {"corrected": [], "paper": ["--no-coarse-correction"], "jacobi": ["--no-coarse-correction", "--iteration", "jacobi"]}
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("bin")
    parser.add_argument("scene")
    parser.add_argument("out")
    parser.add_argument("--reflectances", default="0.5,0.9,0.99")
    parser.add_argument("--ranks", default="1,2,4,8,32")
    parser.add_argument("--tolerance", default="1e-6")
    parser.add_argument("--epsilon")
    parser.add_argument("--append", action="store_true")
    parser.add_argument("--schemes", default=",".join(SCHEMES))
    options = parser.parse_args()
    with open(options.scene, encoding="utf-8") as file:
        scene = json.load(file)
    rows = []
    if options.append:
        with open(options.out, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    for reflectance in map(float, options.reflectances.split(",")):
        for ranks in map(int, options.ranks.split(",")):
            row = {"reflectance": reflectance, "ranks": ranks}
            for scheme in options.schemes.split(","):
                row[scheme] = iterations(options, scene, reflectance, ranks, SCHEMES[scheme])
            rows.append(row)
            print(*(f"{key} {value}" for key, value in row.items()), flush=True)
            with open(options.out, "w", encoding="utf-8", newline="") as file:
                writer = csv.DictWriter(file, rows[0], lineterminator="\n")
                writer.writeheader()
                writer.writerows(rows)


def iterations(options, scene, reflectance, ranks, words):
    """Of a run that converged; none of one that gave up is a figure."""
    for surface in scene["surfaces"]:
        surface["reflectance"] = reflectance
    scene.pop("probes", None)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        platforms = os.path.join(ROOT, "platforms")
        subprocess.run(["smpirun", "-np", str(ranks), "-platform", os.path.join(platforms, "office.xml"), "-hostfile",
                        os.path.join(platforms, "office-4.hosts"), os.path.join(options.bin, "enfilade-smpi"), "solve",
                        path, "-o", os.path.join(folder, "run"), "--tolerance", options.tolerance,
                        "--max-iterations", "5000", "--no-pictures", "--quiet", "--hierarchy", "clusters", *words,
                        *(["--epsilon", options.epsilon] if options.epsilon else [])],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(os.path.join(folder, "run", "stats.json"), encoding="utf-8") as file:
            stats = json.load(file)
    if not stats["converged"]:
        raise SystemExit(f"{ranks} ranks at {reflectance}: not converged")
    return stats["iterations"]


if __name__ == "__main__":
    sys.exit(main())
