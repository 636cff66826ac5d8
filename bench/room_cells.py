#!/usr/bin/python3
"""room_cells.py ENFILADE SCENE.json...: how many of a building's rooms have a cell of their own.

The rooms and doors of the scene's own data are the truth, where something parts them: random short segments across the common face of
two rooms tell whether it is open over more than OPEN of its area. Segments within a door's box count as shut, since doors part rooms.
A space that is open to no room on two sides or more is outdoors, and is left out. A room has a cell of its own where that cell holds at
least half of the points (a grid of 0.35 m) that lie in the room, in the cell, or in both, apart from those of rooms that nothing parts
from this one. Prints the rooms that nothing parts, those that have no cell, and the shares."""
import argparse
import json
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

OPEN = 0.6        # share of a common face
SEGMENTS = 60     # for each face of a room
REACH_M = 0.15    # of a segment, beyond the face
STEP_M = 0.35     # of the grid of points


class Occluders:
    """The scene's polygons, as segments meet them."""

    def __init__(self, surfaces):
        self.polygons = [np.array(s["vertices"], float) for s in surfaces]
        self.low = np.array([p.min(0) for p in self.polygons]) - 1e-6
        self.high = np.array([p.max(0) for p in self.polygons]) + 1e-6
        self.normals = [sum(np.cross(p[i] - p[0], p[(i + 1) % len(p)] - p[0]) for i in range(len(p))) for p in self.polygons]

    def meet(self, a, b):
        near = ((self.low <= np.maximum(a, b)) & (self.high >= np.minimum(a, b))).all(1)
        return any(self.crosses(k, a, b) for k in np.nonzero(near)[0])

    def crosses(self, k, a, b):
        p, n = self.polygons[k], self.normals[k]
        at_a, at_b = (a - p[0]) @ n, (b - p[0]) @ n
        if at_a * at_b > 0 or at_a == at_b:
            return False
        q = a + (b - a) * (at_a / (at_a - at_b))
        return all(np.cross(p[(i + 1) % len(p)] - p[i], q - p[i]) @ n >= -1e-9 * (n @ n) for i in range(len(p)))


class Building:
    def __init__(self, path):
        scene = json.loads(path.read_text(encoding="utf-8"))
        self.names = [room["name"].strip() for room in scene["rooms"]]
        self.boxes = [np.array(room["bbox"], float) for room in scene["rooms"]]
        self.volumes = [np.prod(box[1] - box[0]) for box in self.boxes]
        self.doors = [np.array(p["bbox"], float) + [[-0.12], [0.12]] for p in scene["portals"] if p["kind"] == "IfcDoor"]
        self.occluders = Occluders(scene["surfaces"])

    def room_at(self, p):
        """The smallest room whose box holds p, or -1: boxes of rooms that are no boxes overlap."""
        found = [(self.volumes[i], i) for i, box in enumerate(self.boxes) if (box[0] <= p).all() and (p <= box[1]).all()]
        return min(found)[1] if found else -1

    def is_open(self, a, b):
        middle = (a + b) / 2
        in_door = any((box[0] <= middle).all() and (middle <= box[1]).all() for box in self.doors)
        return not in_door and not self.occluders.meet(a, b)

    def faces(self, room, random):
        """For each face of the room's box and each room beyond it: (axis, other room, share that is open)."""
        low, high = self.boxes[room]
        for axis in range(3):
            for at, out in ((low, -1.0), (high, 1.0)):
                seen = {}
                for _ in range(SEGMENTS):
                    a = low + random.random(3) * (high - low)
                    b = a.copy()
                    a[axis], b[axis] = at[axis] - out * 0.1, at[axis] + out * REACH_M
                    other = self.room_at(b)
                    if self.room_at(a) == room and other != room:
                        seen.setdefault(other, []).append(self.is_open(a, b))
                for other, hits in seen.items():
                    if len(hits) >= 10:
                        yield axis, other, len(hits) / SEGMENTS, np.mean(hits)

    def groups(self):
        """The rooms that nothing parts, as lists; and the rooms that are outdoors."""
        random, parent, sides = np.random.default_rng(1), list(range(len(self.names))), Counter()

        def find(i):
            while parent[i] != i:
                i = parent[i]
            return i
        for room in range(len(self.names)):
            for axis, other, share, is_open in self.faces(room, random):
                if is_open > OPEN and other >= 0:
                    parent[find(room)] = find(other)
                elif is_open > OPEN and axis < 2 and share >= 0.5:
                    sides[room] += 1
        groups = {}
        for room in range(len(self.names)):
            groups.setdefault(find(room), []).append(room)
        return [g for g in groups.values() if sum(sides[room] for room in g) < 2 * len(g)], \
               [g for g in groups.values() if sum(sides[room] for room in g) >= 2 * len(g)]

    def points(self):
        for room, (low, high) in enumerate(self.boxes):
            counts = np.maximum(2, ((high - low) / STEP_M).astype(int))
            for index in np.ndindex(*counts):
                p = low + (high - low) * (np.array(index) + 0.5) / counts
                if self.room_at(p) == room:
                    yield room, p


def cells_of(enfilade, path, points, work):
    run, asked, told = work / "run", work / "points.json", work / "cells.json"
    subprocess.run([enfilade, "prepare", path, "-o", run, "--no-pictures"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    asked.write_text(json.dumps({"points": [p.tolist() for p in points]}))
    subprocess.run([enfilade, "locate", run, "--points", asked, "-o", told], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["rm", "-rf", run], check=True)
    return json.loads(told.read_text())["cells"]


def score(enfilade, path):
    building = Building(path)
    groups, outdoors = building.groups()
    group_of = {room: number for number, group in enumerate(groups) for room in group}
    rooms, points = zip(*building.points())
    with tempfile.TemporaryDirectory() as work:
        cells = cells_of(enfilade, path, points, Path(work))
    of_room, of_cell, both = Counter(rooms), Counter(cells), Counter(zip(rooms, cells))
    in_group = Counter((group_of.get(room), cell) for room, cell in zip(rooms, cells))
    right = 0
    for room, group in group_of.items():
        best = max((n / (of_room[room] + of_cell[cell] - in_group[group, cell]) for (r, cell), n in both.items() if r == room), default=0.0)
        right += best >= 0.5
        if best < 0.5:
            print(f"  no cell of its own: {building.names[room]} (intersection over union {best:.2f})")
    for group in groups:
        if len(group) > 1:
            print(f"  nothing parts: {name(building, group)}")
    for group in outdoors:
        print(f"  outdoors: {name(building, group)}")
    print(f"{path.stem}: {right} of {len(group_of)} rooms have a cell of their own ({right / len(group_of):.0%}); "
          f"{len(building.names) - len(group_of)} spaces are outdoors", flush=True)


def name(building, group):
    return ", ".join(building.names[room] for room in group)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade")
    parser.add_argument("scenes", type=Path, nargs="+", metavar="SCENE.json")
    options = parser.parse_args()
    for path in options.scenes:
        score(options.enfilade, path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
