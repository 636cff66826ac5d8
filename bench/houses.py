#!/usr/bin/python3
"""houses.py ENFILADE [--target-error 0.02] SCENE.json:REFERENCE.json ...: houses against path-traced points, a table row each.

Relative L1 of all points, beside what the reference's noise (`sigma`) alone makes of it; the median relative error of points above
1% of the mean, with and without that noise; the points that are dark in the reference, how many of them get more than 1e-4 of the
mean, and the most; user seconds and memory of the whole run on one rank. Of several bands the worst counts."""
import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade")
    parser.add_argument("houses", nargs="+", metavar="SCENE:REFERENCE")
    parser.add_argument("--target-error", default="0.02")
    options = parser.parse_args()
    print("| house | L1 % (the reference's noise alone) | estimated % | median % (beyond the reference's sigma) | "
          "dark: points, above 1e-4, most | links | user s | MiB |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for house in options.houses:
        scene, _, reference = house.partition(":")
        print(row(options, scene, reference or scene), flush=True)
    return 0


def row(options, scene, reference):
    want = json.loads(Path(reference).read_text())["probes"]
    with tempfile.TemporaryDirectory() as folder:
        run, answers = Path(folder) / "run", Path(folder) / "answers.json"
        usage = solve([options.enfilade, "solve", scene, "-o", run, "--no-pictures", "--quiet", "--target-error",
                       options.target_error])
        subprocess.run([options.enfilade, "probe", run, "--points", reference, "-o", answers], check=True,
                       stdout=subprocess.DEVNULL)
        got = json.loads(answers.read_text())["probes"]
        stats = json.loads((run / "stats.json").read_text())
    l1, noise, median, beyond, dark = (max(values) for values in zip(*(errors(want, got, band)
                                                                      for band in range(len(want[0]["E"])))))
    lights = [max(e / mean_of(want, band) for band, e in enumerate(answer["E"]))
              for probe, answer in zip(want, got) if not any(probe["E"])]
    return (f"| {Path(scene).stem} | {100 * l1:.2f} ({100 * noise:.2f}) | {100 * stats['estimated_error']:.2f} | "
            f"{100 * median:.2f} ({100 * beyond:.2f}) | {len(lights)}, {sum(x > 1e-4 for x in lights)}, {dark:.0e} | "
            f"{stats['links']:,} | {usage.ru_utime:.0f} | {usage.ru_maxrss / 1024:.0f} |")


def solve(command):
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"houses.py: {' '.join(map(str, command))} failed")
    return usage


def mean_of(probes, band):
    return statistics.fmean(probe["E"][band] for probe in probes)


def errors(want, got, band):
    """Relative L1, what noise alone makes of it, the medians, and the most light in the dark."""
    mean, mean_size = mean_of(want, band), math.sqrt(2.0 / math.pi)  # of a standard normal deviate
    points = [(probe["E"][band], abs(answer["E"][band] - probe["E"][band]), sigma_of(probe, band))
              for probe, answer in zip(want, got)]
    lit = [(off / e, max(0.0, off - sigma) / e) for e, off, sigma in points if e > 0.01 * mean]
    dark = [off / mean for probe, (_, off, _) in zip(want, points) if not any(probe["E"])]
    return (statistics.fmean(off for _, off, _ in points) / mean,
            mean_size * statistics.fmean(sigma for _, _, sigma in points) / mean,
            statistics.median(off for off, _ in lit), statistics.median(off for _, off in lit), max(dark, default=0.0))


def sigma_of(probe, band):
    sigma = probe.get("sigma", probe.get("err", 0.0))
    return sigma[band] if isinstance(sigma, list) else sigma


if __name__ == "__main__":
    sys.exit(main())
