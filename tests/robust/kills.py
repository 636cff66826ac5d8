#!/usr/bin/python3
"""Kills and stops ranks of a solve of a building, inside iterations and inside commits, and goes on from what is left.

kills.py ENFILADE NTH_CALL_LIBRARY [--kills N] [--seed S] [--scene SCENE] [--target-error E] [--stop-seconds S]

Each trial kills one rank of 1 to 3, once or several times: by turns at a call that writes a cluster's files, at a call
that writes the manifest, and at a random moment. The library tells at which file a rank died, so that a kill counts
only where it fell into an iteration or a commit. A trial ends with an undisturbed 'solve --resume', which must give the
light of an undisturbed run: its bytes where the order of sums is fixed (one rank, or ranks that do not steal), and the
same to nine digits where ranks steal and their number changes. Every fourth trial stops a rank within an iteration
instead, which must change nothing, and tries a second solve in the same RUN, which must be refused. Exit status 1 where
a trial ended otherwise, and where fewer than half of the kills or stops fell where they should."""
import argparse
import json
import math
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from runs import answers, run, solve

GENERATE = ("--floors", "1", "--seed", "3", "--furniture", "lamp=16,chair=4", "--probes", "true")
# Which paths in RUN are written within an iteration, and within a commit.
PLACES = {"an iteration": "/rank-", "a commit": "/common/manifest"}
MOMENT = "a moment"
# How the runs of a trial solve, by turns: on which numbers of ranks, and by which options. Jacobi's method gives the same
# light on any number of ranks but for the order of sums; the first two ways fix that as well.
WAYS = (((1,), ()), ((3,), ("--iteration", "jacobi", "--no-steal")), ((1, 2, 3), ("--iteration", "jacobi")))


class Kills:
    def __init__(self, options, scratch):
        self.options, self.scratch = options, scratch
        self.rng = random.Random(options.seed)
        self.scene = options.scene or self.building()
        self.directory = scratch / "run"
        self.calls, self.wanted = {}, []
        for ranks, of_way in WAYS:
            self.way(ranks, of_way)
            self.wanted.append(self.undisturbed())
        for place, match in PLACES.items():  # the same run for each, and the last one is timed
            counts = scratch / "counts"
            counts.unlink(missing_ok=True)
            start = time.monotonic()
            self.undisturbed({"LD_PRELOAD": options.preload, "NTH_UNDER": str(self.directory), "NTH_COUNT": str(counts), "NTH_MATCH": match})
            self.seconds = time.monotonic() - start
            self.calls[place] = min(map(int, counts.read_text().split()))  # of one rank: each has files of its own
        assert any(map(any, answers(self.directory))), "the scene is dark at its probes: any answer would be the right one"
        self.faults, self.turn = [], 0
        self.tried = dict.fromkeys((*PLACES, MOMENT, "a stop"), 0)
        self.fell = dict.fromkeys(self.tried, 0)

    def way(self, ranks, options):
        self.ranks, self.same_order = ranks, len(ranks) == 1
        self.options_of_solve = ("--target-error", self.options.target_error, *options)

    def result(self):
        return [(self.directory / name).read_bytes() for name in ("probes.json", "surfaces.csv")]

    def undisturbed(self, env=None):
        shutil.rmtree(self.directory, ignore_errors=True)
        outcome = solve(self.options.enfilade, self.scene, self.directory, *self.options_of_solve, ranks=max(self.ranks), env=env,
                        timeout_s=1800)
        assert outcome.status == 0, outcome.error
        return self.result()

    def is_wanted(self, wanted):
        if self.same_order:
            return self.result() == wanted
        light = [[e for probe in json.loads(text)["probes"] for e in probe["E"]] for text in (wanted[0], self.result()[0])]
        return self.result()[1] == wanted[1] and all(math.isclose(a, b, rel_tol=1e-9) for a, b in zip(*light, strict=True))

    def building(self):
        scene = self.scratch / "building.json"
        outcome = run([self.options.enfilade, "generate", *GENERATE, "-o", scene])
        assert outcome.status == 0, outcome.error
        return scene

    def start(self, ranks, *options, env=None):
        env = {"LD_PRELOAD": self.options.preload, "NTH_UNDER": str(self.directory), **(env or {})}
        exports = [part for name in env for part in ("-x", name)]
        return subprocess.Popen(["mpirun", "--oversubscribe", "-n", str(ranks), *exports, self.options.enfilade, "solve",
                                 str(self.scene), "-o", str(self.directory), "--no-pictures", "--quiet", *self.options_of_solve, *options],
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

    def start_to_act(self, ranks, place, n, action, *resume):
        """Starts ranks of which one does so at its n-th call there, and tells it in the file `told`."""
        self.told = self.scratch / "told"
        self.told.unlink(missing_ok=True)
        rank = 0 if place == "a commit" else self.rng.randrange(ranks)
        return self.start(ranks, *resume, env={"NTH_CALL": str(n), "NTH_ACTION": action, "NTH_MATCH": PLACES[place],
                                               "NTH_TOLD": str(self.told), "NTH_RANK": str(rank)})

    def kill_at_a_call(self, place, ranks, resume):
        # A resumed run has fewer calls.
        n = self.rng.randrange(1, max(2, self.calls[place] // (4 if resume else 1)))
        self.wait(self.start_to_act(ranks, place, n, "kill", *resume))
        return self.told.exists()

    def kill_at_a_moment(self, ranks, resume):
        """True where RUN was left within its iterations."""
        launcher = self.start(ranks, *resume)
        time.sleep(self.rng.random() * self.seconds)
        try:
            os.kill(self.rng.choice(self.ranks_of(launcher)), signal.SIGKILL)
        except (IndexError, ProcessLookupError):  # the run was faster
            pass
        self.wait(launcher)
        manifest = self.directory / "common/manifest.json"
        return launcher.returncode != 0 and manifest.exists() and b'"finished":false' in manifest.read_bytes()

    def kill(self, ranks, resume):
        place = list(self.tried)[self.turn % 3]
        self.turn += 1
        fell = self.kill_at_a_moment(ranks, resume) if place == MOMENT else self.kill_at_a_call(place, ranks, resume)
        self.tried[place] += 1
        self.fell[place] += fell

    def stopped_rank(self, launcher):
        """The rank that has stopped itself; None where all come to their end."""
        while launcher.poll() is None:
            for pid in self.ranks_of(launcher):
                try:
                    if Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "T":
                        return pid
                except OSError:  # it has just ended
                    pass
            time.sleep(0.01)
        return None

    def stop(self, ranks):
        self.tried["a stop"] += 1
        launcher = self.start_to_act(ranks, "an iteration", self.rng.randrange(1, max(2, self.calls["an iteration"] // 2)), "stop")
        pid = self.stopped_rank(launcher)
        if pid is not None:
            self.fell["a stop"] += 1
            second = solve(self.options.enfilade, self.scene, self.directory, *self.options_of_solve, "--resume")
            time.sleep(self.options.stop_seconds)
            os.kill(pid, signal.SIGCONT)
            if second.status != 2 or second.fault():
                self.faults.append(f"a second solve ended with {second.status}: {second.error[-300:]}")
        self.wait(launcher)
        if launcher.returncode != 0:
            self.faults.append(f"a run that was stopped for a while ended with {launcher.returncode}")

    def one(self, i):
        shutil.rmtree(self.directory, ignore_errors=True)
        self.way(*WAYS[i % len(WAYS)])
        if i % 4 == 3:
            self.stop(self.rng.choice(self.ranks))
        else:
            for again in range(self.rng.randrange(1, 4)):
                self.kill(self.rng.choice(self.ranks), ["--resume"] if again else [])
        outcome = solve(self.options.enfilade, self.scene, self.directory, *self.options_of_solve, "--resume",
                        ranks=self.rng.choice(self.ranks), timeout_s=1800)
        if outcome.status != 0:
            self.faults.append(f"trial {i + 1}: cannot be resumed: {outcome.error[-300:]}")
        elif not self.is_wanted(self.wanted[i % len(WAYS)]):
            self.faults.append(f"trial {i + 1}: resumed to another answer")

    def judge(self):
        """A program whose kills fall beside what it is for would find no fault in anything."""
        for place, tried in self.tried.items():
            if 2 * self.fell[place] < tried and place != MOMENT:
                self.faults.append(f"only {self.fell[place]} of {tried} fell into {place}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("enfilade")
    parser.add_argument("preload")
    parser.add_argument("--kills", type=int, default=60, help="trials")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--target-error", default="0.1")
    parser.add_argument("--scene", help="with probes; default: a building of one storey")
    parser.add_argument("--stop-seconds", type=float, default=0, help="how long a stopped rank stands still")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="enfilade-kills-") as scratch:
        kills = Kills(options, Path(scratch))
        for i in range(options.kills):
            kills.one(i)
            print(f"trial {i + 1} of {options.kills}, {len(kills.faults)} faults", *kills.faults[-1:], flush=True)
    kills.judge()
    print(f"{options.kills} trials of a solve of {kills.seconds:.1f} s: "
          + ", ".join(f"{kills.fell[place]} of {tried} in {place}" for place, tried in kills.tried.items()) + f"; {len(kills.faults)} faults")
    print(*kills.faults, sep="\n")
    return 1 if kills.faults else 0


if __name__ == "__main__":
    sys.exit(main())
