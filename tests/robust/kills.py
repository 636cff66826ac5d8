#!/usr/bin/python3
"""Kills and stops ranks of a solve of a building, inside iterations and inside commits, and goes on from what is left.

kills.py ENFILADE NTH_CALL_LIBRARY [--kills N] [--seed S] [--scene SCENE] [--target-error E]

Each trial kills one rank of 1 to 3 at a random moment or at a random call that changes RUN (those of the commit
among them), some of them several times, and ends with an undisturbed 'solve --resume', which must give the bytes of
an undisturbed run. Every fourth trial stops a rank for a while instead, which must change nothing, and then tries a
second solve in the same RUN, which must be refused. Exit status 1 where a trial ended otherwise."""
import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from runs import run, solve

GENERATE = ("--floors", "1", "--seed", "3")


class Kills:
    def __init__(self, options, scratch):
        self.options, self.scratch = options, scratch
        self.rng = random.Random(options.seed)
        self.target = ("--target-error", options.target_error)
        self.scene = options.scene or self.building()
        self.directory = scratch / "run"
        counts = scratch / "counts"
        start = time.monotonic()
        whole = scratch / "whole"
        outcome = solve(options.enfilade, self.scene, whole, *self.target,
                        env={"LD_PRELOAD": options.preload, "NTH_UNDER": str(whole), "NTH_COUNT": str(counts)})
        assert outcome.status == 0, outcome.error
        self.seconds = time.monotonic() - start
        self.calls = max(map(int, counts.read_text().split()))
        self.wanted = (whole / "probes.json").read_bytes() if (whole / "probes.json").exists() else b"", (whole / "surfaces.csv").read_bytes()
        self.faults, self.done = [], {"killed at a call": 0, "killed at a moment": 0, "stopped": 0}

    def building(self):
        scene = self.scratch / "building.json"
        outcome = run([self.options.enfilade, "generate", *GENERATE, "-o", scene])
        assert outcome.status == 0, outcome.error
        return scene

    def start(self, ranks, *options, env=None):
        env = {"LD_PRELOAD": self.options.preload, "NTH_UNDER": str(self.directory), **(env or {})}
        exports = [part for name in env for part in ("-x", name)]
        return subprocess.Popen(["mpirun", "--oversubscribe", "-n", str(ranks), *exports, self.options.enfilade, "solve",
                                 str(self.scene), "-o", str(self.directory), "--no-pictures", "--quiet", *self.target, *options],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=dict(os.environ, **env))

    @staticmethod
    def ranks_of(launcher):
        found = subprocess.run(["pgrep", "-P", str(launcher.pid)], capture_output=True, text=True).stdout.split()
        return [int(pid) for pid in found]

    def wait(self, launcher):
        try:
            launcher.wait(30 * self.seconds + 30)
        except subprocess.TimeoutExpired:
            for pid in self.ranks_of(launcher):
                os.kill(pid, signal.SIGKILL)
            launcher.kill()
            launcher.wait()
            self.faults.append("a run hangs")

    def kill_at_a_call(self, ranks, resume):
        self.done["killed at a call"] += 1
        self.wait(self.start(ranks, *resume, env={"NTH_CALL": str(self.rng.randrange(1, self.calls + 1)), "NTH_ACTION": "kill",
                                                  "NTH_RANK": str(self.rng.randrange(ranks))}))

    def signal_one(self, launcher, what):
        time.sleep(self.rng.random() * self.seconds)
        ranks = self.ranks_of(launcher)
        if not ranks:
            return None
        pid = self.rng.choice(ranks)
        try:
            os.kill(pid, what)
        except ProcessLookupError:
            return None
        return pid

    def kill_at_a_moment(self, ranks, resume):
        self.done["killed at a moment"] += 1
        launcher = self.start(ranks, *resume)
        self.signal_one(launcher, signal.SIGKILL)
        self.wait(launcher)

    def stop(self, ranks):
        self.done["stopped"] += 1
        launcher = self.start(ranks)
        pid = self.signal_one(launcher, signal.SIGSTOP)
        if pid is not None:
            # Its last file is there where the run is done, and a rank was stopped on its way out.
            held = (self.directory / "lock").exists() and not (self.directory / "report.html").exists()
            second = solve(self.options.enfilade, self.scene, self.directory, *self.target, "--resume")
            alive = launcher.poll() is None
            os.kill(pid, signal.SIGCONT)
            if held and alive and (second.status != 2 or second.fault()):
                self.faults.append(f"a second solve ended with {second.status}: {second.error[-300:]}")
        self.wait(launcher)

    def one(self, i):
        shutil.rmtree(self.directory, ignore_errors=True)
        if i % 4 == 3:
            self.stop(self.rng.randrange(1, 4))
        else:
            for again in range(self.rng.randrange(1, 4)):
                resume = ["--resume"] if again else []
                kill = self.kill_at_a_call if self.rng.random() < 0.6 else self.kill_at_a_moment
                kill(self.rng.randrange(1, 4), resume)
        outcome = solve(self.options.enfilade, self.scene, self.directory, *self.target, "--resume", ranks=self.rng.randrange(1, 4))
        if outcome.status != 0:
            self.faults.append(f"trial {i}: cannot be resumed: {outcome.error[-300:]}")
            return
        probes = self.directory / "probes.json"
        if (probes.read_bytes() if probes.exists() else b"", (self.directory / "surfaces.csv").read_bytes()) != self.wanted:
            self.faults.append(f"trial {i}: resumed to another answer")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("enfilade")
    parser.add_argument("preload")
    parser.add_argument("--kills", type=int, default=60, help="trials")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--target-error", default="0.1")
    parser.add_argument("--scene", help="default: a building of one storey")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="enfilade-kills-") as scratch:
        kills = Kills(options, Path(scratch))
        for i in range(options.kills):
            kills.one(i)
            print(f"trial {i + 1} of {options.kills}, {len(kills.faults)} faults", flush=True)
    print(f"{options.kills} trials of a solve of {kills.seconds:.1f} s and {kills.calls} calls: "
          + ", ".join(f"{count} {what}" for what, count in kills.done.items()) + f"; {len(kills.faults)} faults")
    print(*kills.faults, sep="\n")
    return 1 if kills.faults else 0


if __name__ == "__main__":
    sys.exit(main())
