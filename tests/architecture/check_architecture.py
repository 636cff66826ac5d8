#!/usr/bin/python3
"""Finds what breaks the architecture: an include or a link against the arrows, a cycle of includes, and a
library (MPI, SimGrid, Embree) or a runtime #ifdef outside the one room that may know it."""
import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
LINKS = re.compile(r'enfilade(?:::|_)([a-z]+)')
# What only one room may include.
OWNED = {
    "comm": re.compile(r"^mpi\.h$"),
    "machine": re.compile(r"^(simgrid|smpi|xbt)/"),
    "raycast": re.compile(r"^embree\d*/"),
}
RUNTIME_SWITCH = re.compile(r"^\s*#\s*(?:if|ifdef|ifndef|elif)\b.*(?:SMPI|SIMGRID)", re.M)


def rooms_in_order(root: Path) -> list:
    """The order stands in one place: the list in src/CMakeLists.txt."""
    text = (root / "src/CMakeLists.txt").read_text()
    return re.search(r"foreach\(room ([^)]*)\)", text).group(1).split()


def sources(folder: Path) -> list:
    return sorted(p for p in folder.rglob("*") if p.suffix in (".cpp", ".hpp", ".h", ".c"))


def include_faults(file: Path, root: Path, room: str, order: list) -> list:
    faults = []
    text = file.read_text()
    for kind, name in INCLUDE.findall(text):
        target = name.split("/")[0]
        if kind == '"' and target in order and order.index(target) > order.index(room):
            faults.append(f"{file.relative_to(root)}: includes {name}, but {room} lies below {target}")
        if kind == '"' and "/" not in name:
            faults.append(f'{file.relative_to(root)}: includes "{name}" without its room')
        for owner, pattern in OWNED.items():
            if room != owner and pattern.search(name):
                faults.append(f"{file.relative_to(root)}: includes {name}, which only {owner} may know")
    if room != "machine" and RUNTIME_SWITCH.search(text):
        faults.append(f"{file.relative_to(root)}: chooses the runtime with the preprocessor")
    return faults


def link_faults(root: Path, room: str, order: list) -> list:
    lists = root / "src" / room / "CMakeLists.txt"
    if not lists.exists():
        return []
    text = re.sub(r"#.*", "", lists.read_text())
    used = {name for name in LINKS.findall(text) if name in order}
    return [f"src/{room}/CMakeLists.txt: links {name}, but {room} lies below {name}"
            for name in sorted(used) if order.index(name) > order.index(room)]


def cycle_faults(root: Path) -> list:
    """Depth-first search over the files' includes; the order of the rooms does not forbid a cycle inside one."""
    src = root / "src"
    edges = {}
    for file in sources(src):
        names = (name for kind, name in INCLUDE.findall(file.read_text()) if kind == '"')
        edges[file] = [src / name for name in names if (src / name).exists()]
    faults, state = [], {}

    def visit(file, trail):
        state[file] = "open"
        for target in edges.get(file, []):
            if state.get(target) == "open":
                loop = trail[trail.index(target):] + [target] if target in trail else [file, target]
                faults.append("cycle of includes: " + " -> ".join(str(f.relative_to(src)) for f in loop))
            elif target not in state:
                visit(target, trail + [target])
        state[file] = "done"

    for file in edges:
        if file not in state:
            visit(file, [file])
    return faults


def find_faults(root: Path) -> list:
    order = rooms_in_order(root)
    faults = []
    for folder in sorted(p for p in (root / "src").iterdir() if p.is_dir()):
        room = folder.name
        if room not in order:
            if sources(folder):
                faults.append(f"src/{room}: is not in the list of rooms in src/CMakeLists.txt")
            continue
        faults += link_faults(root, room, order)
        for file in sources(folder):
            faults += include_faults(file, root, room, order)
    return faults + cycle_faults(root)


def main() -> int:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    faults = find_faults(root)
    print("\n".join(faults) if faults else f"architecture: {len(rooms_in_order(root))} rooms, no fault")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
