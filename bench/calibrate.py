#!/usr/bin/python3
"""calibrate.py [--study table2] [--run RUN] [--compute C] [--shared S,...] [--request R,...] [-o OUT]

Finds the three calibrated numbers of platforms/irisa_1998.cost.json by replays of the rows of Table 2: one of each row
for each pair of `shared` and `request_s`, from which its minutes at any near `compute` follow. Writes the cost model
with its provenance, and prints the errors of all rows and of each row when the other six alone are fitted. These are
of the fit; bench/table2.py replays the rows with what was found."""
import argparse
import json
import sys
from pathlib import Path

from background import parts
from study import ROOT, StudyError, cases_of, read_study, recorded_run, run_case
from table2_model import cost_model, fit, mean_error, minutes_at, worst_error


def numbers(text: str) -> list[float]:
    return [float(word) for word in text.split(",")]


def replay_all(study: dict, recorded: Path, out: Path, programs: Path, point: tuple) -> list[tuple[float, float]]:
    """Of each row the mean rank's minutes of computing and waiting, and of reading and writing."""
    mesh = json.loads((recorded / "stats.json").read_text())
    model = cost_model(ROOT / "platforms/cost_model.json", mesh, *point)
    rows = []
    for case in cases_of(study):
        stats = run_case({**case, "cost_model": model}, recorded, out / "-".join(f"{x:g}" for x in point), programs)
        rows.append(parts(stats))
    print(f"compute {point[0]:g}, shared {point[1]:g}, request {point[2]:g} s:",
          " ".join(f"{minutes_at(row, 1.0):.0f}" for row in rows), flush=True)
    return rows


def provenance(study: dict, recorded: Path, point: tuple, errors: list[float]) -> str:
    run = json.loads((recorded / "stats.json").read_text())
    return (f"written by bench/calibrate.py from {study['name']}; recorded run: revision {run.get('revision')}, "
            f"{run['patches']} patches, {run['links']} links, {run['iterations']} iterations; compute {point[0]:.4g}, "
            f"shared {point[1]:g}, request_s {point[2]:g}; errors of the fit "
            + " ".join(f"{100 * e:+.1f}%" for e in errors))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--study", default="table2")
    parser.add_argument("--run", help="a recorded run, in place of the study's own")
    parser.add_argument("--compute", type=float, default=800.0, help="of the replays; what is found may be another")
    parser.add_argument("--shared", type=numbers, default=[0.05, 0.1, 0.2])
    parser.add_argument("--request", type=numbers, default=[0.002, 0.008])
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("-o", "--out", type=Path, default=ROOT / "platforms/irisa_1998.cost.json")
    arguments = parser.parse_args()
    try:
        study = read_study(arguments.study, [])
        if arguments.run:
            study["run"] = arguments.run
        work, programs = ROOT / "out/calibrate", arguments.build.resolve() / "bin"
        recorded = recorded_run(study, work, programs)
        paper = [case["columns"]["paper_minutes"] for case in study["cases"]]
        tables = {(shared, request): (arguments.compute,
                                      replay_all(study, recorded, work, programs, (arguments.compute, shared, request)))
                  for shared in arguments.shared for request in arguments.request}
        (shared, request), compute, errors = fit(tables, paper)
        point = (float(f"{compute:.4g}"), shared, request)
    except (StudyError, OSError) as error:
        print(f"calibrate.py: {error}", file=sys.stderr)
        return 1
    print(f"best: compute {point[0]:g}, shared {shared:g}, request {request:g} s; mean {100 * mean_error(errors):.1f}%, "
          f"worst {100 * worst_error(errors):.1f}%")
    for row, case in enumerate(study["cases"]):
        _, _, without = fit(tables, paper, leave_out=row)
        print(f"  {case['name']:36} {100 * errors[row]:+6.1f}%   left out {100 * without[row]:+6.1f}%")
    mesh = json.loads((recorded / "stats.json").read_text())
    model = cost_model(ROOT / "platforms/cost_model.json", mesh, *point)
    model["records"]["comment"] = provenance(study, recorded, point, errors)
    arguments.out.write_text(json.dumps(model, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
