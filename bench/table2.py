#!/usr/bin/python3
"""table2.py [-o DIRECTORY] [--build BUILD] [--run RUN] [--set KEY=VALUE ...] [--chart PNG]
          [--no-background]

Table 2 of RR-3425 in one run: replays its rows (study table2), then again with others at the disk and on the wire, one
share a row, inferred. Leaves DIRECTORY/table2.csv and prints it beside the paper, beside the null model
T = W / (sum of the hosts' speeds), whose W is fitted, and beside the least error of any cluster that needs no less work
in all where it has more computers."""
import argparse
import json
import math
import subprocess
import sys
from pathlib import Path

from background import free_compute, infer, parts
from study import ROOT, StudyError, cases_of, read_study, recorded_run, row_of, run_case, write_rows
from table2_model import (WORST, cost_model, host_speeds, least_error_of_growing_work, mean_error, null_model, scaled,
                          worst_error)

CHAINS = [[0, 1, 2, 3, 5, 6], [4]]  # rows with more and more of the same computers; SGI3


def capacities(study: dict) -> list[float]:
    speeds = host_speeds(ROOT / study["platform"])
    return [sum(speeds[h] for h in (ROOT / case["hosts"]).read_text().split()) for case in study["cases"]]


def with_others(study: dict, rows: list[dict], replays: list[dict], recorded: Path, out: Path, programs: Path) -> None:
    """Adds what others took to the rows."""
    paper = [row["paper_minutes"] for row in rows]
    alone = [parts(stats) for stats in replays]
    ratio = free_compute(alone, paper)
    model = scaled(json.loads((ROOT / study["cost_model"]).read_text()), ratio)
    for row, case, minutes, (moving, io) in zip(rows, cases_of(study), paper, alone):
        share, found = infer(case, model, minutes, (ratio * moving, io), recorded, out / "others", programs)
        row |= {"others_compute": ratio, "others_share": share, "others_minutes": found,
                "others_error": found / minutes - 1.0}
        print(f"{row['case']:36} others take {100 * share:5.1f}%: {found:7.0f} min", flush=True)


def tell(rows: list[dict], work: float, capacity: list[float]) -> None:
    minutes = [row["simulated_s"] / 60.0 for row in rows]
    paper = [row["paper_minutes"] for row in rows]
    print(f"{'':36} {'paper':>7} {'simul.':>7} {'error':>7} {'null':>7} {'others':>7} {'error':>7} |"
          f" speed-up {'printed':>7} {'paper':>6} {'simul.':>6}")
    for row, m in zip(rows, minutes):
        others = (f"{100 * row['others_share']:6.1f}% {100 * row['others_error']:+6.1f}%" if "others_share" in row
                  else f"{'':15}")
        print(f"{row['case']:36} {row['paper_minutes']:7.0f} {m:7.0f} {100 * row['error']:+6.1f}%"
              f" {100 * row['null_error']:+6.1f}% {others} | {row['paper_speed_up']:>16}"
              f" {paper[0] / row['paper_minutes']:6.2f} {minutes[0] / m:6.2f}")
    for name, key in (("simulation", "error"), (f"null model, W = {work:.0f} min", "null_error"),
                      ("with others", "others_error")):
        if key in rows[0]:
            errors = [row[key] for row in rows]
            print(f"{name}: mean error {100 * mean_error(errors):.1f}%, worst {100 * worst_error(errors):.1f}%")
    for worst, text in ((math.inf, ""), (WORST, f", none above {100 * WORST:.0f}%")):
        least = least_error_of_growing_work(paper, capacity, CHAINS, worst)
        print(f"any cluster whose work does not shrink with more computers{text}: mean error at least {100 * least:.1f}%")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", type=Path, default=ROOT / "out/table2")
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--run", help="a recorded run, in place of the study's own")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=JSON", help="as study.py")
    parser.add_argument("--chart", type=Path, help="also run notebooks/study.ipynb, and put its chart here")
    parser.add_argument("--no-background", action="store_true", help="without the column of others' load")
    arguments = parser.parse_args()
    out, programs = arguments.out.resolve(), arguments.build.resolve() / "bin"
    try:
        study = read_study("table2", arguments.set)
        if arguments.run:
            study["run"] = arguments.run
        recorded = recorded_run({**study, **cases_of(study)[0]}, out, programs)
        replays = [run_case(case, recorded, out, programs) for case in cases_of(study)]
        rows = [row_of(case, stats) for case, stats in zip(cases_of(study), replays)]
        capacity = capacities(study)
        work, null = null_model([row["paper_minutes"] for row in rows], capacity)
        for row, error in zip(rows, null):
            row |= {"error": row["simulated_s"] / 60.0 / row["paper_minutes"] - 1.0, "null_error": error}
        if not arguments.no_background:
            with_others(study, rows, replays, recorded, out, programs)
        write_rows(rows, out / "table2.csv")
    except (StudyError, OSError, json.JSONDecodeError) as error:
        print(f"table2.py: {error}", file=sys.stderr)
        return 1
    tell(rows, work, capacity)
    if arguments.chart is None:
        return 0
    return subprocess.run(["/usr/bin/python3", ROOT / "notebooks/execute.py", ROOT / "notebooks/study.ipynb",
                           "--csv", out / "table2.csv", "--chart", arguments.chart]).returncode


if __name__ == "__main__":
    sys.exit(main())
