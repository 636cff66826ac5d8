#!/usr/bin/python3
"""Tests of table2_model.py and of study.py's edits of a platform."""
import math
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

from study import ROOT, StudyError, chosen, edited_platform
from table2_model import fit, host_speeds, least_error_of_growing_work, mean_error, null_model


class NullModel(unittest.TestCase):
    def test_is_exact_where_time_is_work_over_speed(self):
        work, errors = null_model([600.0, 300.0, 150.0], [1.0, 2.0, 4.0])
        self.assertEqual(work, 600.0)
        self.assertEqual(mean_error(errors), 0.0)

    def test_takes_the_work_of_least_mean_error(self):
        work, errors = null_model([100.0, 100.0, 130.0], [1.0, 1.0, 1.0])
        self.assertEqual(work, 100.0)
        self.assertAlmostEqual(mean_error(errors), 30.0 / 130.0 / 3.0)

    def test_speeds_are_relative_to_sun1(self):
        speeds = host_speeds(ROOT / "platforms/irisa_1998.xml")
        self.assertEqual(speeds["SUN1-1"], 1.0)
        self.assertLess(max(speeds.values()), 1.0001)  # the paper: SUN1 is the most powerful


class Fit(unittest.TestCase):
    TABLES = {(0.5, 0.01): (100.0, [(40.0, 10.0), (20.0, 10.0)])}

    def test_finds_what_computing_costs(self):
        key, compute, errors = fit(self.TABLES, [70.0, 40.0])
        self.assertEqual(key, (0.5, 0.01))
        self.assertAlmostEqual(compute, 150.0)
        self.assertLess(mean_error(errors), 1e-9)

    def test_a_row_left_out_does_not_count(self):
        _, compute, errors = fit(self.TABLES, [70.0, 1.0], leave_out=1)
        self.assertAlmostEqual(compute, 150.0)
        self.assertGreater(errors[1], 1.0)


class GrowingWork(unittest.TestCase):
    def test_is_exact_where_the_work_grows(self):
        self.assertEqual(least_error_of_growing_work([10.0, 6.0, 5.0], [1.0, 2.0, 3.0], [[0, 1, 2]]), 0.0)

    def test_misses_what_shrinks_by_the_least(self):
        # 10 and 8: one number for both, best at 8, where the first is 20% short.
        self.assertAlmostEqual(least_error_of_growing_work([10.0, 4.0], [1.0, 2.0], [[0, 1]]), 0.1)
        self.assertAlmostEqual(least_error_of_growing_work([10.0, 4.0], [1.0, 2.0], [[0], [1]]), 0.0)

    def test_keeps_to_the_worst(self):
        self.assertAlmostEqual(least_error_of_growing_work([10.0, 4.0], [1.0, 2.0], [[0, 1]], 0.15),
                               (0.15 + 0.5 / 8.0) / 2.0)
        self.assertEqual(least_error_of_growing_work([10.0, 4.0], [1.0, 2.0], [[0, 1]], 0.1), math.inf)


class Chosen(unittest.TestCase):
    CASES = [{"name": name} for name in ("4 SUN1", "4 SUN1 + 1 SUN2", "1 SGI3")]

    def test_a_name_is_not_taken_for_a_part_of_others(self):
        self.assertEqual(chosen(self.CASES, ["4 SUN1"]), self.CASES[:1])
        self.assertEqual(chosen(self.CASES, ["SUN"]), self.CASES[:2])
        self.assertEqual(chosen(self.CASES, ["4 SUN1", "SGI"]), [self.CASES[0], self.CASES[2]])
        self.assertEqual(chosen(self.CASES, []), self.CASES)


class Edits(unittest.TestCase):
    def edit(self, edits):
        with tempfile.TemporaryDirectory() as directory:
            target = Path(directory) / "platform.xml"
            edited_platform(ROOT / "platforms/office.xml", edits, target)
            return xml.parse(target)

    def find(self, tree, name):
        return next(e for e in tree.iter() if e.get("id") == name)

    def test_attributes_properties_and_disks(self):
        tree = self.edit([["ethernet", "bandwidth", "1MBps"], ["server-disk", "background", "0.5"],
                          ["ash", "memory", None], ["elm", "disk", ["elm-disk", "6MBps"]]])
        self.assertEqual(self.find(tree, "ethernet").get("bandwidth"), "1MBps")
        self.assertEqual(self.find(tree, "server-disk").find("prop[@id='background']").get("value"), "0.5")
        self.assertIsNone(self.find(tree, "ash").find("prop"))
        self.assertEqual(self.find(tree, "elm").find("disk").get("id"), "elm-disk")

    def test_refuses_what_is_not_there(self):
        with self.assertRaises(StudyError):
            self.edit([["oak", "speed", "1Gf"]])


if __name__ == "__main__":
    unittest.main()
