#!/usr/bin/python3
"""The architecture check passes on the project, and finds every fault of the bad example."""
import unittest
from pathlib import Path

from check_architecture import find_faults, rooms_in_order

HERE = Path(__file__).resolve().parent


class Architecture(unittest.TestCase):
    def test_project_keeps_to_the_arrows(self):
        self.assertEqual(find_faults(HERE.parent.parent), [])

    def test_every_unit_test_folder_mirrors_a_room(self):
        unit, rooms = HERE.parent / "unit", rooms_in_order(HERE.parent.parent)
        for folder in {file.parent for file in unit.rglob("*.cpp")} - {unit}:
            self.assertIn(str(folder.relative_to(unit)), rooms)

    def test_each_fault_of_the_bad_example_is_found(self):
        faults = "\n".join(find_faults(HERE / "bad_example"))
        for expected in [
            "base/CMakeLists.txt: links scene, but base lies below scene",
            "includes mpi.h, which only comm may know",
            "includes simgrid/s4u.hpp, which only machine may know",
            "includes embree3/rtcore.h, which only raycast may know",
            'includes "surface.hpp" without its room',
            "chooses the runtime with the preprocessor",
            "cycle of includes: scene/scene.hpp -> scene/surface.hpp -> scene/scene.hpp",
            "src/attic: is not in the list of rooms",
            "scene/parts/long.cpp: includes base/error.hpp, but scene/parts has no arrow to base",
            "scene/parts/CMakeLists.txt: links raycast, which nothing in scene/parts includes",
            "scene/parts/long.cpp: 315 lines, more than 300",
            "scene/parts/long.cpp:4: a function of 62 lines, more than 60",
            "README.md: draws scene -> raycast; lacks nothing",
            "README.md: draws scene/parts -> nothing more; lacks raycast",
            "README.md: has no row for machine",
            "README.md: has a row for cellar, which is no room",
            "README.md: the rooms stand in another order",
            "src/scene/surface.hpp: defines Surface, which src/scene/scene.hpp defines as well",
        ]:
            self.assertIn(expected, faults)
        self.assertEqual(len(faults.splitlines()), 18, faults)


if __name__ == "__main__":
    unittest.main()
