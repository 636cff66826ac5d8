#!/usr/bin/python3
"""table2.py CSV: Table 2 of RR-3425 beside its simulation (study table2) and beside the null model
T = W / (sum of the hosts' speeds), whose W is fitted."""
import csv
import json
import sys
from pathlib import Path

from table2_model import ROOT, host_speeds, mean_error, null_model, worst_error


def capacities(study: dict) -> list[float]:
    speeds = host_speeds(ROOT / study["platform"])
    return [sum(speeds[h] for h in (ROOT / case["hosts"]).read_text().split()) for case in study["cases"]]


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    study = json.loads((ROOT / "bench/studies/table2.json").read_text())
    with Path(sys.argv[1]).open() as file:
        rows = list(csv.DictReader(file))
    paper = [float(row["paper_minutes"]) for row in rows]
    minutes = [float(row["simulated_s"]) / 60.0 for row in rows]
    errors = [m / t - 1.0 for m, t in zip(minutes, paper)]
    work, null = null_model(paper, capacities(study))
    print(f"{'':36} {'paper':>7} {'simul.':>7} {'error':>7} {'null':>7} | speed-up {'printed':>7} {'paper':>6} {'simul.':>6}")
    for i, row in enumerate(rows):
        print(f"{row['case']:36} {paper[i]:7.0f} {minutes[i]:7.0f} {100 * errors[i]:+6.1f}% {100 * null[i]:+6.1f}% |"
              f" {row['paper_speed_up']:>16} {paper[0] / paper[i]:6.2f} {minutes[0] / minutes[i]:6.2f}")
    for name, e in (("simulation", errors), (f"null model, W = {work:.0f} min", null)):
        print(f"{name}: mean error {100 * mean_error(e):.1f}%, worst {100 * worst_error(e):.1f}%")
    return 0


if __name__ == "__main__":
    sys.exit(main())
