#!/usr/bin/python3
"""Every C++ file is as clang-format would have it (see .clang-format)."""
import shutil
import subprocess
import sys
from pathlib import Path


def main() -> int:
    root = Path(sys.argv[1])
    clang_format = shutil.which("clang-format")
    if clang_format is None:
        print("clang-format is not installed (see packages.txt)")
        return 1
    files = sorted(str(p) for folder in ("src", "tests", "bench") for p in (root / folder).rglob("*.[ch]pp")
                   if "bad_example" not in p.parts)
    result = subprocess.run([clang_format, "--dry-run", "-Werror", *files], capture_output=True, text=True)
    faults = sorted({line.split(":")[0] for line in result.stderr.splitlines() if "error:" in line})
    for name in faults:
        print(f"{Path(name).relative_to(root)}: run clang-format -i on it")
    print(f"{len(files)} files, {len(faults)} not formatted")
    return 0 if result.returncode == 0 and not faults else 1


if __name__ == "__main__":
    sys.exit(main())
