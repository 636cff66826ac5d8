#!/usr/bin/python3
"""Lets the n-th call that changes RUN fail, for all n, and goes on from what is left.

writes.py ENFILADE NTH_CALL_LIBRARY [--every K] [--ranks P]

Each n is tried with a disk that is full from there on, with one call that fails, and with a process that dies there. A
failing call must end in status 1 and one line, or do no harm; then 'solve --resume' must end with the bytes of an
undisturbed run. Prints a table; exit status 1 where a trial ended otherwise."""
import argparse
import collections
import shutil
import sys
import tempfile
from pathlib import Path

from runs import ROOM, solve

TARGET = ("--target-error", "0.1")
ACTIONS = ("full", "once", "kill")


class Writes:
    def __init__(self, options, scratch):
        self.options, self.scratch = options, scratch
        self.table, self.faults = collections.Counter(), []
        whole, counts = scratch / "whole", scratch / "counts"
        outcome = self.solve(whole, {"NTH_CALL": "0", "NTH_COUNT": str(counts)})
        assert outcome.status == 0, outcome.error
        self.calls = max(map(int, counts.read_text().split()))
        self.wanted = self.result(whole)

    def solve(self, directory, env=None):
        shim = {"LD_PRELOAD": self.options.preload, "NTH_UNDER": str(directory), "NTH_RANK": "0", **env} if env else None
        if shim and self.options.ranks == 1:
            del shim["NTH_RANK"]
        return solve(self.options.enfilade, ROOM, directory, *TARGET, *([] if env else ["--resume"]), ranks=self.options.ranks, env=shim)

    @staticmethod
    def result(directory):
        return (directory / "probes.json").read_bytes(), (directory / "surfaces.csv").read_bytes()

    def one(self, n, action):
        directory = self.scratch / "run"
        shutil.rmtree(directory, ignore_errors=True)
        outcome = self.solve(directory, {"NTH_CALL": str(n), "NTH_ACTION": action})
        fault = None if action == "kill" else self.fault_of(outcome, directory)
        resumed = self.solve(directory)
        if resumed.status != 0:
            fault = fault or f"cannot be resumed: {resumed.error[-300:]}"
        elif self.result(directory) != self.wanted:
            fault = fault or "resumed to another answer"
        elif left := [p.name for p in directory.rglob("*.part-*")] + [p.name for p in directory.glob("local")]:
            fault = fault or f"left behind: {left}"
        self.table[action, "wrong" if fault else "no harm" if outcome.status == 0 else "told"] += 1
        if fault:
            self.faults.append(f"call {n}, {action}: {fault}")

    def fault_of(self, outcome, directory):
        if outcome.status == 0:
            return None if self.result(directory) == self.wanted else "another answer with exit status 0"
        return outcome.fault() or (None if outcome.status == 1 else f"status {outcome.status}")

    def report(self):
        ends = ("told", "no harm", "wrong")
        print(f"{self.calls} calls that change RUN\n{'':6} " + " ".join(f"{end:>8}" for end in ends))
        for action in ACTIONS:
            print(f"{action:6} " + " ".join(f"{self.table[action, end]:8}" for end in ends))
        print(f"{len(self.faults)} faults")
        print(*self.faults, sep="\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("enfilade")
    parser.add_argument("preload")
    parser.add_argument("--every", type=int, default=1, help="try every K-th call alone")
    parser.add_argument("--ranks", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="enfilade-writes-") as scratch:
        writes = Writes(options, Path(scratch))
        for i, n in enumerate(range(1, writes.calls + 1, options.every)):
            for action in ACTIONS if options.every == 1 else [ACTIONS[i % len(ACTIONS)]]:
                writes.one(n, action)
    writes.report()
    return 1 if writes.faults else 0


if __name__ == "__main__":
    sys.exit(main())
