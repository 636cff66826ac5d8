"""Solves scenes through the command line, and reads what came out."""
import csv
import json
import math
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCENES = Path(__file__).resolve().parent.parent / "data/scene"
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def is_finite(value):
    if isinstance(value, list):
        return all(map(is_finite, value))
    return not isinstance(value, float) or math.isfinite(value)


class Solving(unittest.TestCase):
    enfilade = ""

    def setUp(self):
        self.scratch = Path(tempfile.mkdtemp(prefix="enfilade-failure-"))
        self.addCleanup(shutil.rmtree, self.scratch, ignore_errors=True)

    def run_enfilade(self, *args, ranks=0):
        command = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks else []
        return subprocess.run([*command, self.enfilade, *map(str, args)], capture_output=True, text=True, timeout=240)

    def solve(self, scene, *options, ranks=0, run=None):
        """The RUN directory and what was said; fails the test where the run did. `scene`: a file, or one to be written."""
        if isinstance(scene, dict):
            path = self.scratch / "scene.json"
            path.write_text(json.dumps(scene))
            scene = path
        run = run or self.scratch / f"run{len(list(self.scratch.iterdir()))}"
        result = self.run_enfilade("solve", scene, "-o", run, "--no-pictures", *options, ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(is_finite(list(stats_of(run).values())), stats_of(run))
        for irradiance in irradiances(run).values():
            self.assertTrue(is_finite(irradiance) and min(irradiance) >= 0.0, irradiance)
        return run, result

    def assert_refused(self, scene, *words):
        """Exit status 2, one line "enfilade: error: FILE: WHERE: what; hint" with these words, no RUN."""
        result = self.run_enfilade("solve", scene, "-o", self.scratch / "run")
        self.assertEqual(result.returncode, 2, result.stderr)
        errors = [line for line in result.stderr.splitlines() if line.startswith("enfilade: error: ")]
        self.assertEqual(len(errors), 1, result.stderr)
        self.assertRegex(errors[0], r"^enfilade: error: [^:]+: .+: .+; .+")
        for word in words:
            self.assertIn(word, errors[0])
        self.assertFalse((self.scratch / "run").exists())


def stats_of(run):
    return json.loads((run / "stats.json").read_text())


def answers_of(run):
    return [probe["E"] for probe in json.loads((run / "probes.json").read_text())["probes"]]


def irradiances(run):
    """Mean irradiance per band of every surface that is not dropped, by name."""
    rows = list(csv.reader((run / "surfaces.csv").read_text(encoding="utf-8").splitlines()))
    columns = [i for i, title in enumerate(rows[0]) if title.startswith("mean_irradiance")]
    return {row[1]: [float(row[i]) for i in columns] for row in rows[1:] if row[columns[0]]}
