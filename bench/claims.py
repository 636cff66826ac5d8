#!/usr/bin/python3
"""claims.py -o DIR [SCENE.json|RUN...]: puts what RR-3425 claims in words to the test, by solving each building in the
ways that a claim compares, on a simulated cluster of four unequal hosts. A RUN that is solved is replayed instead, in
those ways that leave its light as it is: for buildings too large to be solved eighteen times. Writes DIR/claims.csv:
building, experiment, and the figures of its stats.json. What has been done in DIR before is not done again."""
import argparse
import csv
import json
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RANKS = 4
FIGURES = ("iterations", "converged", "residual", "estimated_error", "simulated_s", "messages", "message_bytes", "bytes_read",
           "bytes_written", "steals", "peak_cluster_bytes", "heap_extent_bytes", "swapped_bytes", "clusters", "links",
           "compute_s", "io_s", "idle_s")
ORDERS = ("travelling-salesman", "greedy", "random", "input", "backtracking", "unshot-energy")
# The paper's own scheme; every experiment changes one thing of it.
# Links are as fine as the first iterations make them, so that what is compared has the same.
PAPER = ["--no-coarse-correction", "--patch-links", "1"]
# What a replay cannot tell: other light, or another scheme.
ANEW = {"jacobi", "still", "still-jacobi", "tight-spmd", "tight-master-slave", "tight-replicated", "master-slave",
        "replicated"}
SCARCE = 4  # memory is a quarter of what the largest rank fills where there is enough


def experiments(peak_bytes: int) -> dict:
    """Options by experiment. `peak_bytes`: of the run `paper`, whose options do not depend on it."""
    memory = ["--memory", str(max(1, peak_bytes // SCARCE))]
    runs = {
        "paper": [],
        "jacobi": ["--iteration", "jacobi"],
        "still": ["--tolerance", "1e-7"],
        "still-jacobi": ["--tolerance", "1e-7", "--iteration", "jacobi"],
        "greedy-groups": ["--assignment", "greedy"],
        "no-steal": ["--no-steal"],
        "malloc": ["--memory-manager", "malloc", *memory],
        "tight-spmd": ["--memory", "1"],
        "tight-master-slave": ["--memory", "1", "--scheme", "master-slave"],
        "tight-replicated": ["--memory", "1", "--scheme", "replicated"],
        "master-slave": ["--scheme", "master-slave"],
        "replicated": ["--scheme", "replicated"],
    }
    return runs | {f"order-{name}": ["--order", name, *memory] for name in ORDERS}


class Study:
    def __init__(self, arguments: argparse.Namespace):
        self.programs = arguments.build / "bin"
        self.directory = arguments.output
        self.common = PAPER + ["--target-error", str(arguments.target_error), "--basis", arguments.basis, "--no-pictures", "--max-iterations", "150",
                               "--hierarchy", "clusters", "--quiet"]
        self.simulated = ["smpirun", "-platform", ROOT / "platforms/office.xml",
                          "-hostfile", ROOT / "platforms/office-4.hosts", "-np", str(RANKS), self.programs / "enfilade-smpi"]

    def command(self, *words):
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, words))}: exit status {done.returncode}\n{done.stderr}")

    def solve(self, scene: Path, name: str, options: list) -> dict:
        prepared = self.directory / scene.stem / "prepared"
        if not (prepared / "graph.bin").exists():
            self.command(self.programs / "enfilade", "prepare", scene, "-o", prepared, "--hierarchy", "clusters")
        run = self.directory / scene.stem / name
        if not (run / "stats.json").exists():
            shutil.rmtree(run, ignore_errors=True)
            shutil.copytree(prepared, run)
            self.command(*self.simulated, "solve", run, *self.common, *options)
        return json.loads((run / "stats.json").read_text())

    def replay(self, recorded: Path, name: str, options: list) -> dict:
        run = self.directory / f"{recorded.stem}-replays" / name
        if not (run / "stats.json").exists():
            shutil.rmtree(run, ignore_errors=True)
            self.command(*self.simulated, "solve", "--replay", recorded, "-o", run, "--quiet", *options)
        return json.loads((run / "stats.json").read_text())

    def rows(self, scene: Path):
        recorded = (scene / "stats.json").exists()
        if recorded and json.loads((scene / "stats.json").read_text()).get("coarse_correction"):
            sys.exit(f"{scene}: solved with the coarse correction, which is not the paper's scheme; solve it with --no-coarse-correction")
        do = self.replay if recorded else self.solve
        paper = do(scene, "paper", [])
        for name, options in experiments(int(paper["peak_cluster_bytes"])).items():
            if recorded and name in ANEW:
                continue
            stats = do(scene, name, options)
            print(f"{scene.stem}: {name}: {stats['iterations']} iterations, {stats['simulated_s']:.3g} simulated s", flush=True)
            yield [scene.stem, name, *(" ".join(map(str, v)) if isinstance(v, list) else v
                                       for v in (stats[key] for key in FIGURES))]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True, help="where the runs and claims.csv go")
    parser.add_argument("-b", "--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--target-error", type=float, default=0.1)
    parser.add_argument("--basis", default="constant")
    parser.add_argument("--chart", type=Path, help="also run notebooks/claims.ipynb, and put its chart here")
    arguments = parser.parse_args()
    study = Study(arguments)
    rows = [row for scene in arguments.scenes for row in study.rows(scene)]
    with open(arguments.output / "claims.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["building", "experiment", *FIGURES])
        writer.writerows(rows)
    if arguments.chart is None:
        return 0
    return subprocess.run(["/usr/bin/python3", ROOT / "notebooks/execute.py", ROOT / "notebooks/claims.ipynb",
                           "--csv", arguments.output / "claims.csv", "--chart", arguments.chart]).returncode


if __name__ == "__main__":
    sys.exit(main())
