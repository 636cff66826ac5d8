#!/usr/bin/python3
"""Luminaires from a photometric file to lux: info, a scene file, import.

luminaires_test.py ENFILADE [unittest arguments]"""
import json
import math
import shutil
import sys
import unittest

import cli_test
from cli_test import enfilade
from import_test import GLTF, InModel


def ies(peak=1000.0, power=1, header="IESNA:LM-63-2002", sizes="0.3 0.6 0"):
    """peak cos^power below: 2 pi peak / (power + 1) lumens."""
    angles = range(91)
    cd = [peak * math.cos(math.radians(a)) ** power if a < 90 else 0 for a in angles]
    return (f"{header}\n[MANUFAC] Own\n[LUMINAIRE] Test\nTILT=NONE\n1 -1 1 91 1 1 2 {sizes}\n1 1 28\n"
            + " ".join(map(str, angles)) + "\n0\n" + "\n".join(f"{x:.6f}" for x in cd) + "\n")


class Luminaires(InModel):
    def room(self, **keys):
        """A black room of 4 x 4 x 3 m, so that light at the floor is direct."""
        c = [[0, 0], [4, 0], [4, 4], [0, 4]]
        faces = [[[*p, 0] for p in c], [[*p, 3] for p in reversed(c)]]
        for a, b in zip(c, c[1:] + c[:1]):
            faces.append([[*b, 0], [*a, 0], [*a, 3], [*b, 3]])
        return {"exitanceUnits": "lm/m2", "surfaces": [{"vertices": f, "reflectance": 0} for f in faces], **keys}

    def test_info_tells_the_figures_of_a_file(self):
        result = enfilade("info", self.write("a.ies", ies()))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for line in (r"flux +3141\.\d lm", r"power +28 W", r"symmetry +rotational", r"opening +0\.600 x 0\.300 m rectangle",
                     r"peak +1000 cd at plane 0, angle 0 degrees", r"beam angle +120\.\d degrees .*"):
            self.assertRegex(result.stdout, rf"(?m)^  {line}$")
        self.assert_refused(enfilade("info", self.write("b.ldt", "nothing")), "b.ldt", "EULUMDAT")
        result = enfilade("info", self.write("c.ies", ies() + "the end\n"))
        self.assertIn("text behind its numbers", result.stderr)

    def test_a_run_needs_no_other_file(self):
        self.write("lamp.ies", ies(power=3, sizes="0 0 0"))
        probes = [{"p": [x, 2, 0], "n": [0, 0, 1]} for x in (2, 3.2)]
        scene = self.write("scene.json", self.room(
            luminaires=[{"file": "lamp.ies", "p": [2, 2, 2.5], "name": "lamp"}], probes=probes))
        result = enfilade("solve", scene, "-o", self.scratch / "run", "--no-pictures", "--quiet")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for x, answer in zip((0, 1.2), json.loads((self.scratch / "run/probes.json").read_text())["probes"]):
            expected = 1000 * (2.5 / math.hypot(2.5, x)) ** 6 / 2.5 ** 2
            self.assertAlmostEqual(answer["E"][0], expected, delta=2e-3 * expected)
        (self.scratch / "lamp.ies").unlink()
        shutil.move(self.scratch / "run", self.scratch / "moved")
        result = enfilade("info", self.scratch / "moved")
        self.assertRegex(result.stdout, r"(?m)^  luminaires +1$")
        result = enfilade("info", scene)
        self.assert_refused(result, "lamp.ies", "does not exist")

    def test_files_outside_the_scenes_folder_want_a_flag(self):
        self.write("lamp.ies", ies())
        (self.scratch / "sub").mkdir()
        scene = self.write("sub/scene.json", self.room(luminaires=[{"file": "../lamp.ies", "p": [2, 2, 2.5]}]))
        self.assert_refused(enfilade("prepare", scene, "-o", self.scratch / "run"), "--allow-outside")
        result = enfilade("prepare", scene, "-o", self.scratch / "run", "--allow-outside", "--no-pictures")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_import_matches_lamps_with_files(self):
        (self.scratch / "photometry").mkdir()
        self.write("photometry/BULB.ies", ies(power=2))
        model = self.gltf(lambda m: [n.update(name="bu-lb") for n in m["nodes"] if "extensions" in n])
        result, scene = self.imported(model, "--luminaires", self.scratch / "photometry")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"(?m)^  lamps matched +1 of 1$")
        self.assertEqual(len(scene["luminaires"]), 1)
        self.assertIn(scene["luminaires"][0]["distribution"], scene["distributions"])
        self.assertNotIn("lights", scene)

    def test_faulty_files_are_left_out_unless_a_lamp_needs_them(self):
        (self.scratch / "photometry").mkdir()
        self.write("photometry/bulb.ies", ies(power=2))
        self.write("photometry/other.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 91 1 1 2 0 0 0\n1 1\n")
        self.write("photometry/third.ldt", "nothing")
        model = self.gltf(lambda m: [n.update(name="bulb") for n in m["nodes"] if "extensions" in n])
        result, scene = self.imported(model, "--luminaires", self.scratch / "photometry")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"(?m)^  lamps matched +1 of 1$")
        for name in ("other.ies", "third.ldt"):
            self.assertEqual(sum(name in line for line in result.stderr.splitlines()), 1, result.stderr)
        self.assertNotIn("bulb.ies", result.stderr)
        # Another file of the same name will do; without one the lamp has no light to be imported with.
        self.write("photometry/Bulb.ies", "nothing")
        result, scene = self.imported(model, "--luminaires", self.scratch / "photometry")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Bulb.ies", result.stderr)
        self.assertEqual(len(scene["luminaires"]), 1)
        (self.scratch / "photometry/bulb.ies").unlink()
        result, _ = self.imported(model, "--luminaires", self.scratch / "photometry")
        self.assert_refused(result, "Bulb.ies")


if __name__ == "__main__":
    cli_test.ENFILADE = cli_test.ENFILADE or sys.argv.pop(1)
    unittest.main()
