"""At a reflectance of 0.99 the light comes to rest within 25 iterations, and is the same on one rank and on three.

usage: convergence_test.py ENFILADE SCENE.json [--reflectance 0.99] [--tolerance 1e-6] [--most 25]
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("enfilade")
    parser.add_argument("scene", type=Path)
    parser.add_argument("--reflectance", type=float, default=0.99)
    parser.add_argument("--tolerance", default="1e-6")
    parser.add_argument("--most", type=int, default=25)
    options = parser.parse_args()
    scene = json.loads(options.scene.read_text())
    for surface in scene["surfaces"]:
        surface["reflectance"] = options.reflectance
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    found = []
    with tempfile.TemporaryDirectory() as folder:
        path, run = Path(folder) / "scene.json", Path(folder) / "run"
        path.write_text(json.dumps(scene))
        for ranks in (1, 3):
            subprocess.run(["mpirun", "--oversubscribe", "-n", str(ranks), options.enfilade, "solve", path, "-o", run,
                            "--tolerance", options.tolerance, "--no-pictures", "--quiet"], check=True, env=environment)
            stats = json.loads((run / "stats.json").read_text())
            print(f"{ranks} ranks: {stats['iterations']} iterations, converged: {stats['converged']}")
            found.append((stats["converged"], stats["iterations"], (run / "surfaces.csv").read_text()))
    converged, iterations, _ = found[0]
    return 0 if converged and iterations <= options.most and found[0] == found[1] else 1


if __name__ == "__main__":
    sys.exit(main())
