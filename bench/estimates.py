"""Estimated error against the true one: solves scenes with known answers at several asked errors, a CSV line each.

usage: estimates.py ENFILADE OUT.csv [--targets 0.1,0.03,...] [--bases linear,constant] [--ranks N] [--append]
                    SCENE.json[:REFERENCE.json] ...

A reference is a probe file with the answer `E` (and its own error `err` or `sigma`) at each point; without one the
scene's own probes are. --append keeps the rows that OUT.csv has. The true error is the relative L1 over the points beyond the reference's error, worst band:
of the light gathered at the points, and of that read off the patches where points lie on a surface (not `where` says
"work plane"). `user_s` are the user seconds of the whole run, preparation and all ranks."""
import argparse
import csv
import itertools
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile

STATS = ["estimated_error", "estimated_discretisation_error", "estimated_visibility_error",
         "estimated_iteration_error", "estimated_patch_error", "converged", "iterations", "links", "rays",
         "flux_balance", "escaping_share"]
COLUMNS = ["scene", "target", "true_error", "true_patch_error", "reference_error", *STATS, "basis", "user_s"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("enfilade")
    parser.add_argument("out")
    parser.add_argument("cases", nargs="+")
    parser.add_argument("--targets", default="0.1,0.03,0.01,0.003")
    parser.add_argument("--bases", default="linear")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--append", action="store_true")
    options = parser.parse_args()
    before, rows = [], []
    if options.append:
        with open(options.out, encoding="utf-8", newline="") as file:
            before = list(csv.DictReader(file))
    for case in options.cases:
        scene, _, reference = case.partition(":")
        for target, basis in itertools.product(options.targets.split(","), options.bases.split(",")):
            rows.append(measure(options, scene, reference or scene, target, basis))
            print(*(f"{key}={shown(rows[-1].get(key, ''))}" for key in COLUMNS), flush=True)
            write(options.out, before + rows)
    for basis in options.bases.split(","):
        print(end=f"{basis}: ")
        judge([row for row in rows if row["basis"] == basis])


def shown(value):
    return f"{value:.3g}" if isinstance(value, float) else value


def measure(options, scene, reference, target, basis):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    with open(reference, encoding="utf-8") as file:
        points = json.load(file)["probes"]
    with tempfile.TemporaryDirectory() as folder:
        def run(*words):
            subprocess.run(words, check=True, env=environment, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)

        out = os.path.join(folder, "run")
        before = user_seconds()
        run("mpirun", "--oversubscribe", "-n", str(options.ranks), options.enfilade, "solve", scene, "-o", out,
            "--no-pictures", "--quiet", "--target-error", target, "--basis", basis)
        taken = user_seconds() - before
        errors, own = {}, 0.0
        for method in ("gather", "patches"):
            answers = os.path.join(folder, "answers.json")
            run(options.enfilade, "probe", out, "--points", reference, "-o", answers, "--from", method)
            with open(answers, encoding="utf-8") as file:
                answered = zip(points, json.load(file)["probes"])
            kept = [pair for pair in answered if method == "gather" or "work plane" not in pair[0].get("where", "")]
            errors[method], doubt = true_error(*zip(*kept))
            own = doubt if method == "gather" else own
        with open(os.path.join(out, "stats.json"), encoding="utf-8") as file:
            stats = json.load(file)
    name = os.path.basename(reference).split(".json")[0].removesuffix(".ref")
    return {"scene": name, "target": float(target), "true_error": errors["gather"],
            "true_patch_error": errors["patches"], "reference_error": own, **{key: stats.get(key, "") for key in STATS}, "basis": basis,
            "user_s": taken}


def user_seconds():
    """Of the children that have ended."""
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def true_error(want, got):
    """Beyond the reference's error, and that error: of the worst band."""
    worst = (0.0, 0.0)
    for band in range(len(got[0]["E"])):
        total = sum(probe["E"][min(band, len(probe["E"]) - 1)] for probe in want)
        if total <= 0.0:
            continue
        beyond = doubt = 0.0
        for probe, answer in zip(want, got):
            own = probe.get("sigma", probe.get("err", 0.0))
            own = own[min(band, len(own) - 1)] if isinstance(own, list) else own
            beyond += max(0.0, abs(answer["E"][band] - probe["E"][min(band, len(probe["E"]) - 1)]) - own)
            doubt += own
        worst = max(worst, (beyond / total, doubt / total))
    return worst


def write(path, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: f"{row[key]:.4g}" if isinstance(row[key], float) else row[key] for key in COLUMNS})


def judge(rows):
    """How often the two bars are met: below the target (or said not to be), and an estimate within three times the
    truth, which lies between the error beyond the reference's own and that with it."""
    kept = [row for row in rows if row["true_error"] < row["target"] or not row["converged"]]
    near = [row for row in rows if row["true_error"] / 3.0 <= row["estimated_error"]
            <= 3.0 * (row["true_error"] + row["reference_error"])]
    matters = [row for row in rows if max(row["true_error"], row["estimated_error"]) > 1e-4]
    ratios = [row["estimated_error"] / row["true_error"] for row in rows if row["true_error"] > 0.0]
    print(f"below the target, or said so: {len(kept)} of {len(rows)}; estimate within 3 times: {len(near)} of "
          f"{len(rows)}, {sum(row in near for row in matters)} of the {len(matters)} where one of the two is above "
          f"0.01%; median estimate over truth: {statistics.median(ratios):.2g}")


if __name__ == "__main__":
    sys.exit(main())
