#!/usr/bin/python3
"""Puts faults into the program, one at a time, and tells which test sees each.

usage: run_faults.py [--tree DIRECTORY] [--jobs N] [--end-to-end REGEX] [--only WORD ...] [--results FILE] [--table FILE] [--check]

The faults are those of faults.json beside this script: a file, a text in it that occurs once, and what a programmer by mistake wrote instead. The
script works in a work tree of its own (--tree, made where it is missing), never in this one: it replaces the text, builds the unit tests of the
fault's room and of the rooms that the fault names (`tests`), runs them, and puts the text back. With --end-to-end, what they do not see is
then given to the tests of ctest whose names match. Outcomes are added to --results as they come, so that a run can be stopped and goes on with the
faults that are left; --table writes them as Markdown. --check only tells whether all texts still occur once.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FAILED = re.compile(r"^\[  FAILED  \] ([A-Za-z_]+\w*\.\w+)", re.M)
UNIT_TIMEOUT_S, BUILD_TIMEOUT_S, CTEST_TIMEOUT_S = 600, 3600, 3600


def sh(command, timeout_s, folder):
    """(exit status, what was printed); 124 where the time was up."""
    try:
        done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout_s, text=True, errors="replace")
    except subprocess.TimeoutExpired:
        return 124, ""
    return done.returncode, done.stdout


def misplaced(faults, root):
    """Faults whose text does not occur exactly once."""
    return [fault["name"] for fault in faults if (root / fault["file"]).read_text().count(fault["old"]) != 1]


def prepare(tree):
    if not tree.exists():
        subprocess.run(["git", "worktree", "add", "--detach", tree, "HEAD"], cwd=ROOT, check=True)
    if not (tree / "build/release/build.ninja").exists():
        subprocess.run(["cmake", "--preset", "release", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"], cwd=tree, check=True, stdout=subprocess.DEVNULL)


def rooms_of(fault):
    room = str(Path(fault["file"]).parent.relative_to("src"))
    return list(dict.fromkeys([room, *fault["tests"]]))


def seen_by_units(tree, rooms, jobs):
    """(which unit tests fail, rooms that have none); raises where the fault does not compile."""
    with_tests = [room for room in rooms if (tree / "tests/unit" / room / "CMakeLists.txt").exists()]
    if not with_tests:
        return []
    targets = [room.replace("/", "_") + "_tests" for room in with_tests]
    status, text = sh(["cmake", "--build", "build/release", f"-j{jobs}", "--target", *targets], BUILD_TIMEOUT_S, tree)
    if status:
        raise RuntimeError("does not compile: " + " / ".join(re.findall(r"error: .*", text)[:2]))
    seen = []
    for room, target in zip(with_tests, targets):
        status, text = sh([tree / "build/release/tests/unit" / room / target, "--gtest_brief=1"], UNIT_TIMEOUT_S, tree)
        names = list(dict.fromkeys(FAILED.findall(text)))
        if status and not names:
            names = ["does not end" if status == 124 else "breaks off"]
        seen += [f"{room}: {name}" for name in names]
    return seen


def seen_end_to_end(tree, regex, jobs):
    status, text = sh(["cmake", "--build", "build/release", f"-j{jobs}"], BUILD_TIMEOUT_S, tree)
    if status:
        raise RuntimeError("does not compile")
    status, text = sh(["ctest", "--test-dir", "build/release", "-R", regex, "--timeout", "300", "-j", str(jobs)], CTEST_TIMEOUT_S, tree)
    return re.findall(r"^\s*\d+ - (\S+) \(", text, re.M) if status else []


def run(fault, tree, options):
    file = tree / fault["file"]
    right = file.read_text()
    outcome = {"name": fault["name"], "file": fault["file"], "rooms": rooms_of(fault), "units": [], "end_to_end": None}
    begin = time.time()
    try:
        file.write_text(right.replace(fault["old"], fault["new"]))
        outcome["units"] = seen_by_units(tree, outcome["rooms"], options.jobs)
        if options.end_to_end and not outcome["units"]:
            outcome["end_to_end"] = seen_end_to_end(tree, options.end_to_end, options.jobs)
    except RuntimeError as error:
        outcome["error"] = str(error)
    finally:
        file.write_text(right)
        os.utime(file)
    outcome["seconds"] = round(time.time() - begin)
    return outcome


def table(outcomes, left, revision):
    units = sum(bool(o["units"]) for o in outcomes)
    later = sum(bool(o["end_to_end"]) for o in outcomes)
    lines = ["# Faults on purpose", "",
             f"Made by `tests/faults/run_faults.py` at revision {revision}: {len(outcomes)} faults were put in, one at a time. {units} are seen by the "
             f"unit tests of the rooms named, {later} more by the end-to-end tests that were run. \"-\" in the last column: none was run.", "",
             "| fault | file | unit tests run | seen by | end to end |", "| --- | --- | --- | --- | --- |"]
    for o in outcomes:
        first = [name.split(": ")[-1] for name in o["units"]]
        seen = o.get("error") or (", ".join(f"`{name}`" for name in first[:2]) + (f" and {len(first) - 2} more" if len(first) > 2 else "") or "**none**")
        later = "-" if o["end_to_end"] is None else ", ".join(o["end_to_end"][:3]) or "**none**"
        lines.append(f"| {o['name']} | `{o['file'].removeprefix('src/')}` | {', '.join(o['rooms'])} | {seen} | {later} |")
    if left:
        lines += ["", f"Not run yet ({len(left)}): " + "; ".join(f"{fault['name']} (`{fault['file'].removeprefix('src/')}`)" for fault in left) + "."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--tree", type=Path, default=ROOT / "build/fault-tree")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--end-to-end", metavar="REGEX")
    parser.add_argument("--only", nargs="+", default=[], metavar="WORD", help="faults whose name or file has one of these words")
    parser.add_argument("--results", type=Path, default=ROOT / "build/faults.jsonl")
    parser.add_argument("--table", type=Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    faults = json.loads((HERE / "faults.json").read_text())["faults"]
    if options.check:
        bad = misplaced(faults, ROOT)
        sys.exit("faults.json: the text to replace does not occur once: " + "; ".join(bad) if bad else 0)
    chosen = [f for f in faults if not options.only or any(word in f["name"] + f["file"] for word in options.only)]
    options.results.parent.mkdir(parents=True, exist_ok=True)
    done = [json.loads(line) for line in options.results.read_text().splitlines()] if options.results.exists() else []
    left = [f for f in chosen if f["name"] not in {o["name"] for o in done}]
    if left:
        prepare(options.tree)
        bad = misplaced(left, options.tree)
        if bad:
            sys.exit("the text to replace does not occur once in " + str(options.tree) + ": " + "; ".join(bad))
    for fault in left:
        outcome = run(fault, options.tree, options)
        done.append(outcome)
        with options.results.open("a") as file:
            file.write(json.dumps(outcome) + "\n")
        print(f"{outcome['name']}: {outcome.get('error') or outcome['units'][:2] or outcome['end_to_end'] or 'NOT SEEN'} ({outcome['seconds']} s)", flush=True)
    if options.table:
        order = {f["name"]: i for i, f in enumerate(faults)}
        revision = subprocess.run(["git", "rev-parse", "--short=7", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
        ran = sorted((o for o in done if o["name"] in order), key=lambda o: order[o["name"]])
        names = {o["name"] for o in ran}
        options.table.write_text(table(ran, [f for f in faults if f["name"] not in names], revision))


if __name__ == "__main__":
    main()
