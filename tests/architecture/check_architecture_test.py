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
        rooms = rooms_in_order(HERE.parent.parent)
        for folder in (HERE.parent / "unit").iterdir():
            if folder.is_dir():
                self.assertIn(folder.name, rooms)

    def test_each_fault_of_the_bad_example_is_found(self):
        faults = "\n".join(find_faults(HERE / "bad_example"))
        for expected in [
            "base/CMakeLists.txt: links scene",
            "base/upward.cpp: includes scene/scene.hpp, but base lies below scene",
            "includes mpi.h, which only comm may know",
            "includes simgrid/s4u.hpp, which only machine may know",
            "includes embree3/rtcore.h, which only raycast may know",
            'includes "surface.hpp" without its room',
            "chooses the runtime with the preprocessor",
            "cycle of includes: scene/scene.hpp -> scene/surface.hpp -> scene/scene.hpp",
            "src/attic: is not in the list of rooms",
        ]:
            self.assertIn(expected, faults)
        self.assertEqual(len(faults.splitlines()), 9, faults)


if __name__ == "__main__":
    unittest.main()
