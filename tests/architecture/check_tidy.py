#!/usr/bin/python3
"""check_tidy.py SOURCE BUILD: runs clang-tidy with the checks of .clang-tidy over src, and fails on any finding.

BUILD holds compile_commands.json; where it compiles sources together (ENFILADE_TOGETHER), they are checked together, which
takes a fraction of the time. A file that passed is not looked at again, in any checkout, until it, a header of the project
that it includes, how it is compiled, .clang-tidy or clang-tidy itself changes: enfilade-tidy in the user's cache directory
(XDG_CACHE_HOME, else ~/.cache) keeps a mark for each."""
import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


def with_headers(file: Path, src: Path, seen: set) -> set:
    """The file and all files of the project that it includes."""
    if file in seen or not file.exists():
        return seen
    seen.add(file)
    for name in INCLUDE.findall(file.read_text()):
        with_headers(src / name, src, seen)
    return seen


def mark_of(file: Path, src: Path, common: bytes) -> str:
    digest = hashlib.sha256(common)
    for part in sorted(with_headers(file, src, set())):
        digest.update(part.read_bytes())
    return digest.hexdigest()


def findings(file: Path, mark: Path, build: Path) -> str:
    """What clang-tidy finds; where that is nothing, the file gets its mark."""
    run = subprocess.run(["clang-tidy", "-p", str(build), "--quiet", "--warnings-as-errors=*",
                          "--extra-arg=-Wno-unknown-warning-option", str(file)],
                         capture_output=True, text=True)
    if run.returncode != 0:
        return run.stdout + run.stderr
    mark.touch()
    return ""


def main() -> int:
    source, build = (Path(argument).resolve() for argument in sys.argv[1:3])
    src = source / "src"
    compiled = {Path(entry["file"]).resolve(): entry["command"]
                for entry in json.loads((build / "compile_commands.json").read_text())}
    files = sorted(file for file in compiled if src in file.parents or build / "src" in file.parents)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    common = version + (source / ".clang-tidy").read_bytes()
    marks = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "enfilade-tidy"
    marks.mkdir(parents=True, exist_ok=True)
    how = {file: common + compiled[file].replace(str(source), "").encode() for file in files}
    todo = [(file, marks / mark_of(file, src, how[file])) for file in files]
    todo = [(file, mark) for file, mark in todo if not mark.exists()]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(lambda item: findings(*item, build), todo):
            if found:
                failed += 1
                print(found, flush=True)
    print(f"clang-tidy: {len(files)} files, {len(todo)} looked at, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
