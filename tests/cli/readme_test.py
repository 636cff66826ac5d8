#!/usr/bin/python3
"""The README's commands, typed as they stand: each ends with exit status 0, warns of nothing, and leaves what it names.

readme_test.py ENFILADE [unittest arguments]"""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path()
# Open MPI refuses root and more ranks than cores unless it is told.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1")


def commands(heading):
    """The indented lines below a heading of the README; a line that ends with a backslash goes on in the next."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    section = re.search(rf"(?ms)^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", text).group(1)
    code = "\n".join(line[4:] for line in section.splitlines() if line.startswith("    "))
    return code.replace("\\\n", " ").splitlines()


class Readme(unittest.TestCase):
    """One scratch directory: what one command writes the next may read."""

    @classmethod
    def setUpClass(cls):
        cls.home = Path(tempfile.mkdtemp(prefix="enfilade-readme-"))
        cls.addClassCleanup(shutil.rmtree, cls.home, ignore_errors=True)
        for folder in ("scenes", "platforms"):
            (cls.home / folder).symlink_to(ROOT / folder)
        (cls.home / "build/release").mkdir(parents=True)
        (cls.home / "build/release/bin").symlink_to(PROGRAMS)

    def run_all(self, heading):
        exports = []
        lines = commands(heading)
        self.assertTrue(lines, f"no commands below {heading}")
        for line in lines:
            if line.startswith("export "):
                exports.append(line)
                continue
            with self.subTest(line):
                self.run_one(line, exports)

    def run_one(self, line, exports):
        started = time.monotonic()
        result = subprocess.run(["bash", "-c", "\n".join([*exports, line])], cwd=self.home, capture_output=True, text=True,
                                timeout=240)
        print(f"{time.monotonic() - started:6.1f} s  {line}", flush=True)
        said = result.stdout + result.stderr
        self.assertEqual(result.returncode, 0, said)
        self.assertNotRegex(said, r"(?m)^enfilade\S*: (warning|error): ")
        words = shlex.split(line, comments=True)
        for name in words[words.index("-o") + 1:][:1] if "-o" in words else []:
            self.assertRegex(name, r"^out/", "the README's commands write below out/")
            self.assertTrue((self.home / name).exists(), f"{line}: left no {name}")

    def test_1_using_it(self):
        self.run_all("Using it")
        probes = json.loads((self.home / "out/lux.json").read_text())["probes"]
        self.assertGreater(len(probes), 3)
        for probe in probes:
            self.assertTrue(all(10.0 < lux < 2000.0 for lux in probe["E"]), probe)
        self.assertEqual(len(json.loads((self.home / "out/cells.json").read_text())["cells"]), len(probes))

    @unittest.skipUnless(shutil.which("smpirun"), "SimGrid is not installed")
    def test_2_on_a_simulated_cluster(self):
        if not (PROGRAMS / "enfilade-smpi").exists():
            self.skipTest("this build has no enfilade-smpi")
        self.run_all("On a simulated cluster")
        self.assertGreater(json.loads((self.home / "out/two-hosts/stats.json").read_text())["simulated_s"], 0.0)

    def test_models_of_the_house_become_one_scene(self):
        """But for names, and what single precision rounds; IFC brings no lamps."""
        scenes = {}
        for kind in ("glb", "obj", "ifc") if shutil.which("node") else ("glb", "obj"):
            path = self.home / f"{kind}.json"
            result = subprocess.run([PROGRAMS / "enfilade", "import", ROOT / f"scenes/house.{kind}", "-o", path],
                                    capture_output=True, text=True)
            told = [line for line in result.stderr.splitlines() if kind != "ifc" or "has no light" not in line]
            self.assertEqual((result.returncode, told), (0, []))
            scenes[kind] = json.loads(path.read_text())["surfaces"]

        def figures(surfaces):
            return sorted([round(c, 3) + 0.0 for c in sum([*sorted(s["vertices"]), s["reflectance"]], [])]
                          + [round(e, -1) + 0.0 for e in s["exitance"]] for s in surfaces)
        self.assertEqual(figures(scenes["glb"]), figures(scenes["obj"]))
        self.assertEqual(sum(s["exitance"][0] > 0.0 for s in scenes["glb"]), 3)
        self.assertEqual(sum(s["exitance"][0] > 0.0 for s in scenes.get("ifc", [])), 0)


if __name__ == "__main__":
    PROGRAMS = Path(sys.argv.pop(1)).resolve().parent
    unittest.main(verbosity=2)
