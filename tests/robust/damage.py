#!/usr/bin/python3
"""Damages the files of a RUN, one at a time, and looks at what each command makes of it.

damage.py ENFILADE [--trials N] [--seed S] [--smpi ENFILADE_SMPI]

Bits are turned, files cut, lengthened, removed, exchanged with a neighbour's, with those of an older iteration or of
another run, edited so that their format stays, and made a pipe or a directory. Every trial must end with one line of error and status 1 or 2, or with
status 0 and the bytes of the unharmed RUN. Prints a table; exit status 1 where a trial ended otherwise."""
import argparse
import collections
import json
import os
import random
import re
import shutil
import sys
import tempfile
from pathlib import Path

from runs import ROOM, ROOT, run, solve

TARGET = ("--target-error", "0.1")


def files_of(directory):
    return sorted(p.relative_to(directory) for p in Path(directory).rglob("*") if p.is_file())


def scene_file(path, brightness):
    """The room with a second lamp, on a switch of its own."""
    scene = json.loads(ROOM.read_text())
    for surface in scene["surfaces"]:
        if isinstance(surface.get("exitance"), list):
            surface.update(exitance=[brightness * e for e in surface["exitance"]], switch="ceiling")
    scene["lights"] = [{"type": "point", "p": [1.1, 0.9, 1.5], "intensity": [0.5 * brightness], "switch": "desk"}]
    path.write_text(json.dumps(scene))
    return path


class Runs:
    """The RUN that is damaged, as solved to its end and as left in the middle; and those that others' files come from."""

    def __init__(self, program, scratch):
        self.whole, self.half = scratch / "whole", scratch / "half"
        self.others = [scratch / "older", scratch / "brighter", scratch / "coarser"]
        room, self.other_light = scene_file(scratch / "room.json", 1), scene_file(scratch / "other_light.json", 2)
        older, bright, coarse = self.others
        full = ("--shares", "--rooms")
        for made in (solve(program, room, self.whole, *TARGET, *full), solve(program, room, self.half, *TARGET, "--max-iterations", 4),
                     solve(program, room, older, *TARGET, "--max-iterations", 2, "--shares"),
                     solve(program, self.other_light, bright, *TARGET, *full),
                     solve(program, room, coarse, "--target-error", "0.3", "--basis", "constant", *full)):
            assert made.status == 0, made.error
        made = run([program, "walk", self.whole, "-o", self.whole / "walk.html"])
        assert made.status == 0, made.error


def turn_bits(rng, data):
    data = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 8))):
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(data)


def overwrite(rng, data):
    at, size = rng.randrange(len(data)), rng.choice((1, 4, 8, 64))
    return data[:at] + rng.choice((bytes(size), b"\xff" * size, rng.randbytes(size))) + data[at + size:]


def cut(rng, data):
    return data[:rng.randrange(len(data))]


def lengthen(rng, data):
    return data + rng.choice((b"\0", b"}", data, rng.randbytes(100)))


def edit(rng, data):
    """Changes a value and keeps the format: a number of a text, a field of 4 or 8 bytes of any other file."""
    numbers = list(re.finditer(rb"-?\d+(\.\d+)?(e[+-]?\d+)?", data)) if data[:1] in b"{[" else []
    if numbers:
        found = rng.choice(numbers)
        new = rng.choice((b"0", b"1", b"-1", b"2", b"7", b"1e300", b"123456789", b"[]", b"null", b"\"x\""))
        return data[:found.start()] + new + data[found.end():]
    size = rng.choice((4, 8))
    at = rng.randrange(max(1, len(data) // size)) * size
    return data[:at] + rng.choice((bytes(size), (1).to_bytes(size, "little"), b"\xff" * size)) + data[at + size:]


def exchange(rng, runs, directory, name):
    """Puts the file of a neighbour in its place: of another cluster or iteration, or of another run."""
    path = directory / name
    pattern = re.sub(r"\d+", "*", path.name)
    near = [p for p in (directory / name.parent).glob(re.sub(r"-[ab]\.", "-*.", pattern)) if p != path]
    near += [directory / "costs" / str(k) / name.name for k in range(9)] if name.parts[0] == "costs" else []
    near += [other / name for other in runs.others + [runs.half if directory.name == "whole" else runs.whole]]
    near = [p for p in near if p.is_file() and p.read_bytes() != path.read_bytes()]
    if near:
        path.write_bytes(rng.choice(near).read_bytes())
    return bool(near)


DAMAGE = {"turned bits": turn_bits, "overwritten": overwrite, "cut": cut, "lengthened": lengthen, "edited": edit,
          "exchanged": None, "removed": None, "a pipe": None, "a directory": None}


def harm(rng, runs, directory, name, kind):
    path = directory / name
    if kind == "exchanged":
        return exchange(rng, runs, directory, name)
    if kind in ("removed", "a pipe", "a directory"):
        path.unlink()
        if kind != "removed":
            os.mkfifo(path) if kind == "a pipe" else path.mkdir()
        return True
    data = path.read_bytes()
    if not data:
        return False
    harmed = DAMAGE[kind](rng, data)
    path.write_bytes(harmed)
    return harmed != data


class Commands:
    """Each command: how it is started, and which of its outputs are compared."""

    def __init__(self, program, smpi, other_light):
        self.program, self.smpi, self.other_light = program, smpi, other_light
        small = ("--width", 24, "--height", 16, "--samples", 1, "--threads", 1)
        self.of_whole = {
            "info": lambda d, out: ["info", d],
            "probe": lambda d, out: ["probe", d, "--points", ROOM, "-o", out / "probe.json", "--rays", 64],
            "render": lambda d, out: ["render", d, "-o", out / "x.png", "--eye", "1,1,1", "--look-at", "2,2,1", *small],
            "export light": lambda d, out: ["export", d, "-o", out / "x.glb"],
            "export graph": lambda d, out: ["export", d, "-o", out / "x.json"],
            "locate": lambda d, out: ["locate", d, "--points", ROOM, "-o", out / "cells.json"],
            "plan": lambda d, out: ["plan", d, "-o", out / "plan.svg"],
            "report": lambda d, out: ["report", d, "-o", out / "x.html", "--no-pictures"],
            "dimmed": lambda d, out: ["probe", d, "--points", ROOM, "-o", out / "dimmed.json", "--rays", 64, "--switch", "desk=0.3"],
            "shares of points": lambda d, out: ["probe", d, "--points", ROOM, "-o", out / "shares.json", "--rays", 64, "--shares"],
            "rooms": lambda d, out: ["rooms", d, "-o", out / "rooms.csv", "--rays", 16, "--no-cylindrical"],
            "walk": lambda d, out: ["walk", d, "-o", out / "walk.html"],
            "factors": lambda d, out: ["factors", d, "-o", out / "factors.csv", "--error", 0.05],
            "bounds": lambda d, out: ["bounds", d, "-o", out / "bounds.csv", "--links", 1000, "--seconds", 0, "--threads", 1]}
        self.solves = ("resume", "again", "further shares", "relight")
        self.names = [*self.of_whole, *self.solves, *(["replay"] if smpi else [])]

    def start(self, name, directory, out):
        if name == "resume" or name == "again":
            outcome = solve(self.program, directory, directory, "--resume", *TARGET)
        elif name == "further shares":
            outcome = solve(self.program, directory, directory, "--resume", "--shares", *TARGET)
        elif name == "relight":
            outcome = solve(self.program, directory, out / "relit", "--relight", self.other_light)
        elif name == "replay":
            outcome = run([ROOT / ".ci/smpirun.sh", 2, self.smpi, "solve", "--replay", directory, "-o", out / "replayed", "--quiet"])
        else:
            outcome = run([self.program, *self.of_whole[name](directory, out)])
        return outcome

    @staticmethod
    def told(name, directory, out):
        """What the command told, to compare: its files, without the times that it took."""
        if name in ("resume", "again", "relight"):
            solved = out / "relit" if name == "relight" else directory
            return (solved / "probes.json").read_bytes(), (solved / "surfaces.csv").read_bytes()
        if name == "further shares":
            return [(p, (directory / p).read_bytes()) for p in files_of(directory) if ".shares-" in p.name]
        if name == "replay":
            stats = json.loads((out / "replayed/stats.json").read_text())
            return [stats[key] for key in ("simulated_s", "compute_s", "io_s", "bytes_read", "messages")]
        return [(p, (out / p).read_bytes()) for p in files_of(out)]


class Trials:
    def __init__(self, options, scratch):
        self.scratch = scratch
        self.runs = Runs(options.enfilade, scratch)
        self.commands = Commands(options.enfilade, options.smpi, self.runs.other_light)
        self.rng = random.Random(options.seed)
        self.unharmed = {}
        self.table, self.by_command = collections.Counter(), collections.Counter()
        self.faults = []

    def copy(self, source):
        shutil.rmtree(self.scratch / "trial", ignore_errors=True)
        directory, out = self.scratch / "trial" / source.name, self.scratch / "trial/out"
        shutil.copytree(source, directory)
        out.mkdir()
        return directory, out

    def expected(self, name):
        if name not in self.unharmed:
            directory, out = self.copy(self.runs.half if name == "resume" else self.runs.whole)
            outcome = self.commands.start(name, directory, out)
            assert outcome.status == 0, f"{name}: {outcome.error}"
            self.unharmed[name] = self.commands.told(name, directory, out)
        return self.unharmed[name]

    def one(self):
        name, kind = self.rng.choice(self.commands.names), self.rng.choice(list(DAMAGE))
        self.expected(name)
        directory, out = self.copy(self.runs.half if name == "resume" else self.runs.whole)
        files = files_of(directory)
        if name == "replay" and self.rng.random() < 0.7:
            files = [f for f in files if f.parts[0] in ("costs", "common")]
        file = self.rng.choice(files)
        if not harm(self.rng, self.runs, directory, file, kind):
            return
        outcome = self.commands.start(name, directory, out)
        fault = outcome.fault()
        if fault is None and outcome.status == 0 and self.commands.told(name, directory, out) != self.expected(name):
            fault = "another answer with exit status 0"
        end = "wrong" if fault else "right answer" if outcome.status == 0 else "refused"
        self.table[kind, end] += 1
        self.by_command[name, end] += 1
        if fault:
            self.faults.append(f"{name}: {file} {kind}: {fault}")

    def report(self):
        ends = ("refused", "right answer", "wrong")
        for title, rows, table in (("damage", DAMAGE, self.table), ("command", self.commands.names, self.by_command)):
            print(f"{title:16} " + " ".join(f"{end:>12}" for end in ends))
            for row in rows:
                print(f"{row:16} " + " ".join(f"{table[row, end]:12}" for end in ends))
        print(f"{sum(self.table.values())} trials, {len(self.faults)} faults")
        print(*self.faults, sep="\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("enfilade")
    parser.add_argument("--trials", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--smpi", help="enfilade-smpi, to try replays as well")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="enfilade-damage-") as scratch:
        trials = Trials(options, Path(scratch))
        for _ in range(3 * options.trials):  # some damage cannot be done to some files
            if sum(trials.table.values()) < options.trials:
                trials.one()
    trials.report()
    return 1 if trials.faults else 0


if __name__ == "__main__":
    sys.exit(main())
