#!/usr/bin/python3
"""Every command once, on a room, by an enfilade that is built with sanitizers: a solve on one rank and on two, a resume,
an import of each format. Whatever a sanitizer finds, leaks as well, ends a command with another status than 0.

every_command.py ENFILADE"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SCENES = ROOT / "scenes"
SMALL = ("--width", 16, "--height", 12, "--samples", 1, "--gather-rays", 16)
TARGET = ("--target-error", 0.3)


def commands(folder):
    room, run, picture, points = folder / "room.json", folder / "run", folder / "x.png", ROOT / "tests/cli/room.json"
    eye = ("--eye", "1,1,1", "--look-at", "2,2,1")
    models = [f"house.{ending}" for ending in ("glb", "obj", *(["ifc"] if shutil.which("node") else []))]
    return [
        *(["import", SCENES / model, "-o", folder / f"{model}.json"] for model in models),
        ["import", folder / "room.rad", "-o", folder / "room.rad.json"],
        ["generate", "--floors", 1, "--wings", 2, "--stairs", 0, "--furniture", "lamp=4", "-o", folder / "building.json"],
        ["info", SCENES / "panel.ies"],
        ["prepare", room, "-o", run],
        ["solve", run, "-o", run, *TARGET, "--max-iterations", 2, "--no-pictures", "--quiet"],
        ["solve", run, "--resume", *TARGET, "--shares", "--no-pictures", "--no-walk", "--quiet"],
        ["solve", room, "-o", folder / "two", *TARGET, "--rooms", "--no-pictures", "--no-walk", "--quiet"],
        ["solve", run, "--relight", folder / "dim.json", "-o", folder / "dim", "--no-pictures", "--no-walk", "--quiet"],
        ["info", run],
        ["probe", run, "--points", points, "--shares", "--rays", 64, "-o", folder / "lux.json"],
        ["rooms", run, "-o", folder / "rooms.html", "--rays", 16, "--cylindrical-height", 1.2],
        ["walk", run, "-o", folder / "walk.html"],
        ["render", run, "-o", picture, *eye, *SMALL],
        ["export", run, "-o", folder / "light.glb"],
        ["export", run, "-o", folder / "graph.json"],
        ["factors", run, "--by", "object", "-o", folder / "factors.idf", "--error", 0.1],
        ["locate", run, "--points", points, "-o", folder / "cells.json"],
        ["bounds", run, "-o", folder / "bounds.csv", "--links", 500, "--seconds", 0],
        ["plan", run, "-o", folder / "plan.svg"],
        ["report", run, folder / "two", "-o", folder / "report.html", "--no-pictures"],
    ]


def write_inputs(folder):
    scene = json.loads((ROOT / "tests/cli/room.json").read_text())
    scene["lights"] = [{"type": "point", "p": [1.1, 0.9, 1.5], "intensity": [20], "switch": "desk"}]
    (folder / "room.json").write_text(json.dumps(scene))
    scene["lights"][0]["intensity"] = [10]
    (folder / "dim.json").write_text(json.dumps(scene))
    (folder / "room.rad").write_text("void plastic grey 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 9 9 9\n"
                                     "grey polygon floor 0 0 12 0 0 0 2 0 0 2 2 0 0 2 0\n"
                                     "lamp polygon panel 0 0 12 0 0 2 0 1 2 1 1 2 1 0 2\n")


def main():
    program, faults = sys.argv[1], 0
    env = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    with tempfile.TemporaryDirectory(prefix="enfilade-sanitized-") as name:
        folder = Path(name)
        write_inputs(folder)
        for words in commands(folder):
            launcher = ["mpirun", "--oversubscribe", "-n", "2"] if folder / "two" in words and words[0] == "solve" else []
            before = time.monotonic()
            result = subprocess.run([*launcher, program, *map(str, words)], capture_output=True, text=True, errors="replace",
                                    timeout=300, env=env)
            bad = result.returncode != 0 or "Sanitizer" in result.stderr or "runtime error" in result.stderr
            faults += bad
            print(f"{time.monotonic() - before:6.1f} s  {words[0]} {Path(words[1]).name if len(words) > 1 else ''}", flush=True)
            if bad:
                print(f"status {result.returncode}\n{result.stderr[-6000:]}", flush=True)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
