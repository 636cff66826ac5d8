#!/usr/bin/python3
"""Finds what breaks the architecture.

Rooms are the folders that `ENFILADE_ROOM_LIST` in src/CMakeLists.txt names, lowest first. Faults are: an include or a
link that no arrow allows (the arrows are what a room's own CMakeLists.txt links), an arrow that no include needs, an
arrow that goes up, a map (src/README.md) that draws other arrows, a cycle of includes, a library (MPI, SimGrid, Embree)
or a runtime #ifdef outside the one room that may know it, a type that two headers define, and a room, file or function
that is too large."""
import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
LINKS = re.compile(r'enfilade(?:::|_)([a-z_]+)')
# What only one room may include.
OWNED = {
    "comm": re.compile(r"^mpi\.h$"),
    "machine": re.compile(r"^(simgrid|smpi|xbt)/"),
    "raycast": re.compile(r"^embree\d*/"),
}
RUNTIME_SWITCH = re.compile(r"^\s*#\s*(?:if|ifdef|ifndef|elif)\b.*(?:SMPI|SIMGRID)", re.M)
MOST_ROOM_LINES, MOST_FILE_LINES, MOST_FUNCTION_LINES = 2000, 300, 60


def rooms_in_order(root: Path) -> list:
    """The order stands in one place: the list in src/CMakeLists.txt."""
    text = (root / "src/CMakeLists.txt").read_text()
    return re.search(r"set\(ENFILADE_ROOM_LIST ([^)]*)\)", text).group(1).split()


def sources(folder: Path) -> list:
    """Of the folder itself: what lies deeper is another room's."""
    return sorted(p for p in folder.glob("*") if p.suffix in (".cpp", ".hpp", ".h", ".c"))


def all_sources(src: Path) -> list:
    return sorted(p for p in src.rglob("*") if p.suffix in (".cpp", ".hpp", ".h", ".c"))


def includes(file: Path) -> list:
    return INCLUDE.findall(file.read_text())


def room_of(name: str) -> str:
    return name.rpartition("/")[0]


def arrows(root: Path, room: str, order: list) -> set:
    """The rooms that this one links. comm and machine are linked by the runtime that they are built for."""
    lists = root / "src" / room / "CMakeLists.txt"
    if not lists.exists():
        return set()
    by_target = {name.replace("/", "_"): name for name in order}
    text = re.sub(r"#.*", "", lists.read_text())
    targets = {re.sub(r"_(mpi|smpi)$", "", name) for name in LINKS.findall(text)}
    return {by_target[target] for target in targets if target in by_target} - {room}


def include_faults(root: Path, room: str, order: list) -> list:
    faults, drawn, needed = [], arrows(root, room, order), set()
    for file in sources(root / "src" / room):
        where = file.relative_to(root)
        for kind, name in includes(file):
            target = room_of(name)
            if kind == '"' and not target:
                faults.append(f'{where}: includes "{name}" without its room')
            if kind == '"' and target in order and target != room:
                needed.add(target)
                if target not in drawn:
                    faults.append(f"{where}: includes {name}, but {room} has no arrow to {target}")
            for owner, pattern in OWNED.items():
                if room != owner and pattern.search(name):
                    faults.append(f"{where}: includes {name}, which only {owner} may know")
        if room != "machine" and RUNTIME_SWITCH.search(file.read_text()):
            faults.append(f"{where}: chooses the runtime with the preprocessor")
    faults += [f"src/{room}/CMakeLists.txt: links {name}, which nothing in {room} includes"
               for name in sorted(drawn - needed)]
    faults += [f"src/{room}/CMakeLists.txt: links {name}, but {room} lies below {name}"
               for name in sorted(drawn) if order.index(name) > order.index(room)]
    return faults


def map_faults(root: Path, order: list) -> list:
    """src/README.md draws the arrows in the last column of its table of rooms: | [room](room) | ... | a, b |"""
    rows = re.findall(r"^\| \[([a-z_/]+)\]\([a-z_/]+\) \|.*\|([^|]*)\|$",
                      (root / "src/README.md").read_text(), re.M)
    drawn = {room: set(re.findall(r"[a-z_/]+", cell)) for room, cell in rows}
    faults = [f"src/README.md: has no row for {room}" for room in order if room not in drawn]
    faults += [f"src/README.md: has a row for {room}, which is no room" for room in drawn if room not in order]
    if [room for room, _ in rows] != [room for room in order if room in drawn]:
        faults.append("src/README.md: the rooms stand in another order than in src/CMakeLists.txt")
    for room in order:
        real = arrows(root, room, order)
        if room in drawn and drawn[room] != real:
            faults.append(f"src/README.md: draws {room} -> {', '.join(sorted(drawn[room] - real)) or 'nothing more'}; "
                          f"lacks {', '.join(sorted(real - drawn[room])) or 'nothing'}")
    return faults


def cycle_faults(root: Path) -> list:
    """Depth-first search over the files' includes; the order of the rooms does not forbid a cycle inside one."""
    src = root / "src"
    edges = {file: [src / name for kind, name in includes(file) if kind == '"' and (src / name).exists()]
             for file in all_sources(src)}
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


# Strings and comments, in which a brace means nothing.
NOISE = re.compile(r'R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|//[^\n]*|/\*(?:.|\n)*?\*/')
SCOPE = re.compile(r"\b(namespace|class|struct|enum|union|extern)\b[^;{}()]*$")


def long_functions(file: Path) -> list:
    """(first line, lines) of each function that is too long: of each pair of braces that is neither a namespace's nor a
    type's, the outermost."""
    text = NOISE.sub(lambda m: "\n" * m.group().count("\n"), file.read_text())
    found, open_at, begin = [], [], 0
    for at, char in enumerate(text):
        if char == "{":
            inside = any(is_body for _, is_body in open_at)
            open_at.append((at, not inside and not SCOPE.search(text[begin:at])))
        elif char == "}" and open_at:
            start, is_body = open_at.pop()
            lines = text.count("\n", start, at) + 1
            if is_body and lines > MOST_FUNCTION_LINES:
                found.append((text.count("\n", 0, start) + 1, lines))
        if char in "{};":
            begin = at + 1
    return found


def size_faults(root: Path, room: str) -> list:
    faults, total = [], 0
    for file in sources(root / "src" / room):
        count = len(file.read_text().splitlines())
        total += count
        if count > MOST_FILE_LINES:
            faults.append(f"{file.relative_to(root)}: {count} lines, more than {MOST_FILE_LINES}")
        faults += [f"{file.relative_to(root)}:{at}: a function of {lines} lines, more than {MOST_FUNCTION_LINES}"
                   for at, lines in long_functions(file)]
    if total > MOST_ROOM_LINES:
        faults.append(f"src/{room}: {total} lines, more than {MOST_ROOM_LINES}")
    return faults


TYPE = re.compile(r"^(?:struct|class|enum class|enum) ([A-Za-z]\w*)[^;{(]*\{", re.M)


def name_faults(root: Path) -> list:
    """All of src is one namespace: two types of one name break the one-definition rule, and the linker takes either's
    functions for both."""
    defined, faults = {}, []
    for file in all_sources(root / "src"):
        for name in TYPE.findall(file.read_text()) if file.suffix in (".hpp", ".h") else []:
            first = defined.setdefault(name, file.relative_to(root))
            if first != file.relative_to(root):
                faults.append(f"{file.relative_to(root)}: defines {name}, which {first} defines as well")
    return faults


def stray_faults(root: Path, order: list) -> list:
    folders = sorted({file.parent for file in all_sources(root / "src")})
    names = [str(folder.relative_to(root / "src")) for folder in folders]
    return [f"src/{name}: is not in the list of rooms in src/CMakeLists.txt" for name in names if name not in order]


def find_faults(root: Path) -> list:
    order = rooms_in_order(root)
    faults = stray_faults(root, order)
    for room in order:
        faults += include_faults(root, room, order) + size_faults(root, room)
    return faults + map_faults(root, order) + cycle_faults(root) + name_faults(root)


def main() -> int:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    faults = find_faults(root)
    print("\n".join(faults) if faults else f"architecture: {len(rooms_in_order(root))} rooms, no fault")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
