#!/usr/bin/python3
"""simulated_table.py REFERENCE_RUN SIMULATED_RUN...: simulated times, and whether the solution is the reference's."""
import csv
import json
import sys
from pathlib import Path


def irradiance(run: Path) -> dict:
    """Area and mean irradiance per band of each surface that receives light."""
    rows = {}
    with open(run / "surfaces.csv", newline="") as file:
        for row in csv.DictReader(file):
            bands = [float(v) for k, v in row.items() if k.startswith("mean_irradiance") and v]
            if bands:
                rows[row["surface"]] = (float(row["area_m2"]), bands)
    return rows


def difference(a: dict, b: dict) -> float:
    """Area-weighted relative L1 of the mean irradiances, worst band."""
    if not a or a.keys() != b.keys():
        return float("inf")
    bands = len(next(iter(a.values()))[1])
    worst = 0.0
    for band in range(bands):
        total = sum(area * e[band] for area, e in a.values())
        off = sum(area * abs(e[band] - b[row][1][band]) for row, (area, e) in a.items())
        worst = max(worst, off / total if total > 0 else off)
    return worst


def main() -> int:
    reference, *runs = [Path(p) for p in sys.argv[1:]]
    truth = irradiance(reference)
    stats = json.loads((reference / "stats.json").read_text())
    print(f"{'run':<22}{'ranks':>6}{'time':>14}{'speed-up':>10}{'differs by':>12}  same solution")
    print(f"{reference.name:<22}{stats['ranks']:>6}{stats['solve_s']:>11.1f} s *{'':>10}{'':>11}")
    first, all_same = None, True
    for run in runs:
        stats = json.loads((run / "stats.json").read_text())
        seconds = stats["simulated_s"]
        first = first or seconds
        off = difference(truth, irradiance(run))
        all_same &= off <= 0.005
        print(f"{run.name:<22}{stats['ranks']:>6}{seconds:>11.1f} s  {first / seconds:>9.2f}{100 * off:>11.3f}%"
              f"  {'yes' if off <= 0.005 else 'NO'}")
    print("* on this machine; the others are simulated. Same: area-weighted irradiance within 0.5%.")
    return 0 if all_same else 1


if __name__ == "__main__":
    sys.exit(main())
