"""Solves a scene at default settings and holds the light at its probes against an independent reference.

usage: accuracy_test.py ENFILADE SCENE REFERENCE [--max-l1 X] [--max-rms X] [--max-relative X] [--max-median X] [--max-dark X]
                        [--max-links N] [--max-rays N] [--rows X]
"""
import argparse
import contextlib
import json
import os
import random
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("enfilade")
    parser.add_argument("scene")
    parser.add_argument("reference")
    parser.add_argument("--max-l1", type=float, help="area-weighted relative L1 over all points")
    parser.add_argument("--max-rms", type=float, help="RMS error over all points, as a share of the mean")
    parser.add_argument("--max-links", type=int)
    parser.add_argument("--max-rays", type=int)
    parser.add_argument("--from", dest="method", default="gather", help="gather or patches: how the points are read")
    parser.add_argument("--max-relative", type=float, help="largest relative error of a point, beyond the reference's own")
    parser.add_argument("--max-median", type=float,
                        help="median relative error over points above 1 percent of the mean")
    parser.add_argument("--max-dark", type=float,
                        help="light, as a share of the mean, at points that are dark in the reference")
    parser.add_argument("--rows", type=float, help="the sums of the rows before they are closed: mean off 1 by at most this, and all but the "
                        "first and last hundredth of the area by at most ten times this")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--target-error", default="0.02")
    parser.add_argument("--kills", type=int, default=0,
                        help="kill -9 a rank so many times, at random moments, and go on with --resume")
    options = parser.parse_args()
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    with tempfile.TemporaryDirectory() as folder:
        run = os.path.join(folder, "run")
        answers = os.path.join(folder, "answers.json")
        solve(options, run, environment)
        subprocess.run([options.enfilade, "probe", run, "--points", options.reference, "-o", answers,
                        "--from", options.method],
                       check=True, env=environment)
        with open(answers, encoding="utf-8") as file:
            got = json.load(file)["probes"]
        with open(os.path.join(run, "stats.json"), encoding="utf-8") as file:
            stats = json.load(file)
    with open(options.reference, encoding="utf-8") as file:
        want = json.load(file)["probes"]
    return judge(options, want, got, stats)


def solve(options, run, environment):
    command = ["mpirun", "--oversubscribe", "-n", str(options.ranks), options.enfilade, "solve", options.scene,
               "-o", run, "--no-pictures", "--quiet", "--target-error", options.target_error]
    moments = random.Random(1)
    kills = 0
    while kills < options.kills:
        running = subprocess.Popen(command + ["--resume"] * (kills > 0), env=environment,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while running.poll() is None and not ranks_of(running):
            time.sleep(0.02)  # mpirun takes its time on a busy machine
        time.sleep(moments.uniform(0.1, 1.5))
        ranks = ranks_of(running)
        if ranks:
            with contextlib.suppress(ProcessLookupError):  # it has just ended by itself
                os.kill(int(moments.choice(ranks)), signal.SIGKILL)
            kills += 1
        running.wait()
        if not ranks:  # it ended before its time: from the start again, so that there is something to kill
            shutil.rmtree(run)
            subprocess.run(command + ["--max-iterations", "1"], check=True, env=environment)
    subprocess.run(command + ["--resume"] * (kills > 0), check=True, env=environment)


def ranks_of(running):
    return subprocess.run(["pgrep", "-P", str(running.pid), "enfilade"], capture_output=True, text=True).stdout.split()


def judge(options, want, got, stats):
    bad = []

    def check(name, value, limit):
        if limit is None:
            return
        print(f"{name}: {value:.3g} (limit {limit:g})")
        if not value <= limit:
            bad.append(name)

    check("links", stats["links"], options.max_links)
    check("rays", stats["rays"], options.max_rays)
    # A furnace comes out right whatever the form factors are, once its rows are closed.
    if options.rows is not None:
        check("mean of the rows' sums less 1", abs(stats["mean_row_ratio"] - 1.0), options.rows)
        check("1 percent of the rows below 1 by", 1.0 - stats["row_ratio_1_percent"], 10.0 * options.rows)
        check("1 percent of the rows above 1 by", stats["row_ratio_99_percent"] - 1.0, 10.0 * options.rows)
    bands = len(want[0]["E"])
    for band in range(bands):
        reference = [p["E"][band] for p in want]
        answer = [p["E"][band] for p in got]
        if not any(reference):  # a band without any light
            check(f"band {band} light from nowhere", max(map(abs, answer)), 0.0)
            continue
        mean = statistics.mean(reference)
        error = [abs(a - r) for a, r in zip(answer, reference)]
        relative = [e / r for e, r in zip(error, reference) if r > 0.01 * mean]
        beyond = [max(0.0, e - p.get("err", 0.0)) / r
                  for e, r, p in zip(error, reference, want) if r > 0.01 * mean]
        dark = [a / mean for a, r in zip(answer, reference) if r == 0.0]
        check(f"band {band} relative L1", sum(error) / sum(reference), options.max_l1)
        check(f"band {band} RMS", statistics.mean(e * e for e in error) ** 0.5 / mean, options.max_rms)
        check(f"band {band} largest relative error", max(beyond), options.max_relative)
        check(f"band {band} median relative error", statistics.median(relative), options.max_median)
        if dark:
            check(f"band {band} light in the dark", max(dark), options.max_dark)
    if bad:
        print("over the limit: " + ", ".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
