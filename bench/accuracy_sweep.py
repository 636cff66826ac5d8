#!/usr/bin/python3
"""accuracy_sweep.py ENFILADE -o FILE.json [options] SCENE=POINTS ...: accuracy against cost.

Solves every scene at falling link tolerances with each basis, oracle and visibility method, and holds the light against
the references in POINTS (probes with E), once gathered for at the points and once read off the patches. One JSON
file: a context, and a row a solve; what went wrong is a row too, with "error"."""
import argparse
import json
import os
import platform
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

COUNTS = ("links", "patches", "rays", "shafts", "form_factors", "kernels", "iterations", "bands", "converged",
          "estimated_error", "flux_balance", "peak_rss_bytes")
# (basis, oracle, visibility method): each once against the default, which comes first.
METHODS = [("linear", "error", "exact"), ("linear", "bf", "exact"), ("constant", "error", "exact"),
           ("constant", "bf", "exact"), ("linear", "error", "rays")]


def main():
    options = arguments()
    options.output.parent.mkdir(parents=True, exist_ok=True)
    rows = []
    for pair in options.scenes:
        scene, points = map(Path, pair.split("=", 1))
        for method in METHODS:
            for epsilon in options.epsilons:
                row = {"scene": scene.stem, "basis": method[0], "oracle": method[1], "visibility": method[2],
                       "epsilon": epsilon, **solve(options, scene, points, method, epsilon)}
                rows.append(row)
                options.output.write_text(json.dumps({"context": context(options), "rows": rows}, indent=1) + "\n")
                print(" ".join(f"{row.get(key, ''):.4g}" if isinstance(row.get(key), float) else str(row.get(key, ""))
                               for key in ("scene", "basis", "oracle", "visibility", "epsilon", "links", "rays", "user_s",
                                           "l1", "patches_l1", "error")), flush=True)
                if "error" in row or row["user_s"] > options.enough_s:
                    break  # the finer ones take longer still
    return 0 if any("error" not in row for row in rows) else 1


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade")
    parser.add_argument("scenes", nargs="+", metavar="SCENE=POINTS")
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--epsilons", type=lambda text: [float(e) for e in text.split(",")],
                        default=[10.0 ** (-k / 2) for k in range(4, 15)],
                        help="link tolerances over the emitted power, falling")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="ask for each N-th of the points alone: faster, less sure")
    parser.add_argument("--enough-s", type=float, default=5.0, help="no finer tolerance once a solve takes so many user seconds")
    parser.add_argument("--limit-s", type=float, default=120.0, help="a solve that takes so many seconds is stopped: an error")
    return parser.parse_args()


def context(options):
    version = subprocess.run([options.enfilade, "--version"], capture_output=True, text=True).stdout.strip()
    git = ["git", "-C", str(Path(__file__).resolve().parent), "describe", "--always", "--dirty"]
    revision = subprocess.run(git, capture_output=True, text=True).stdout.strip()
    cpus = [line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines()
            if line.startswith("model name")]
    return {"program": version, "revision": revision, "machine": platform.machine(), "cpu": cpus[0] if cpus else "",
            "cores": os.cpu_count(), "load": os.getloadavg()[0]}


def solve(options, scene, points, method, epsilon):
    basis, oracle, visibility = method
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder) / "run"
        bare = Path(folder) / scene.name  # its own probes are no part of the solve
        bare.write_text(json.dumps({key: value for key, value in json.loads(scene.read_text()).items() if key != "probes"}))
        some = Path(folder) / "points.json"
        some.write_text(json.dumps({"probes": json.loads(points.read_text())["probes"][::options.every]}))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        command = [options.enfilade, "solve", bare, "-o", run, "--no-pictures", "--quiet", "--epsilon", f"{epsilon:g}",
                   "--basis", basis, "--oracle", oracle, "--visibility", visibility]
        try:
            result = subprocess.run(command, capture_output=True, text=True, timeout=options.limit_s)
        except subprocess.TimeoutExpired:
            return {"error": f"took longer than {options.limit_s:g} s"}
        if result.returncode:
            return {"error": (result.stderr.strip().splitlines() or ["no word"])[-1]}
        user_s = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        stats = json.loads((run / "stats.json").read_text())
        row = {key: stats[key] for key in COUNTS if key in stats} | {"user_s": round(user_s, 3)}
        for prefix, source in (("", []), ("patches_", ["--from", "patches"])):
            answers = Path(folder) / "answers.json"
            subprocess.run([options.enfilade, "probe", run, "--points", some, "-o", answers, *source], check=True,
                           capture_output=True)
            row |= {prefix + key: value for key, value in errors(some, answers).items()}
    return row


def errors(points, answers):
    """In the worst band: relative L1, RMS over the mean, and the median relative error of points above 1% of the mean."""
    want = [probe["E"] for probe in json.loads(points.read_text())["probes"]]
    got = [probe["E"] for probe in json.loads(answers.read_text())["probes"]]
    worst = {"l1": 0.0, "rms": 0.0, "median": 0.0}
    for band, reference in enumerate(zip(*want)):
        mean = statistics.fmean(reference)
        if mean <= 0.0:
            continue
        off = [abs(answer[min(band, len(answer) - 1)] - exact) for answer, exact in zip(got, reference)]
        found = {"l1": statistics.fmean(off) / mean, "rms": statistics.fmean(d * d for d in off) ** 0.5 / mean,
                 "median": statistics.median(d / e for d, e in zip(off, reference) if e > 0.01 * mean)}
        worst = {key: max(worst[key], found[key]) for key in worst}
    return worst


if __name__ == "__main__":
    sys.exit(main())
