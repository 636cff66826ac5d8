#!/usr/bin/python3
"""buildings.py ENFILADE OUT.csv SCENE[:REFERENCE] ... [--targets 0.02,0.1,0.3]

Solves real buildings on one core, the whole process from the scene file to the last output, and writes what each took: CPU seconds
(user and system), peak resident memory, patches and links, the estimated error, and with a reference the true one: the relative L1
difference over the reference's points (its own noise included), the reference's noise, and the median difference beyond its sigma.
Prints the table of buildings.md."""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

FIELDS = ["building", "surfaces", "target", "cpu_s", "prepare_s", "ms_a_surface", "peak_mib", "patches", "links", "estimated", "l1", "noise",
          "median_beyond_sigma", "probe_ms"]


def run(command: list):
    """Runs it on one core; returns what it used."""
    process = subprocess.Popen(["taskset", "-c", "0", *map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    errors = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"buildings.py: {' '.join(map(str, command))}\n{errors}")
    return usage


def compare(answers: list, reference: list) -> dict:
    """Differences per band of the file; points that are dark in the reference count in the noise and in L1 alone."""
    off = light = noise = 0.0
    beyond = []
    for answer, known in zip(answers, reference):
        bands = known["E"]
        sigma = known["sigma"] if isinstance(known["sigma"], list) else [known["sigma"]] * len(bands)
        found = answer["E"] if len(answer["E"]) == len(bands) else answer["E"] * len(bands)
        for e, s, f in zip(bands, sigma, found):
            off, light, noise = off + abs(f - e), light + e, noise + s
            if e > 0.0:
                beyond.append(max(0.0, abs(f - e) - s) / e)
    beyond.sort()
    return {"l1": off / light, "noise": noise / light, "median_beyond_sigma": beyond[len(beyond) // 2]}


def measure(enfilade: Path, scene: Path, reference: Path | None, target: str, work: Path) -> dict:
    run_directory = work / "run"
    usage = run([enfilade, "solve", scene, "-o", run_directory, "--target-error", target, "--quiet"])
    stats = json.loads((run_directory / "stats.json").read_text())
    cpu_s = usage.ru_utime + usage.ru_stime
    row = {"building": scene.stem, "surfaces": stats["surfaces"], "target": target, "cpu_s": round(cpu_s, 2),
           "prepare_s": round(stats["prepare_s"], 2), "ms_a_surface": round(1000.0 * cpu_s / stats["surfaces"], 2),
           "peak_mib": round(usage.ru_maxrss / 1024), "patches": stats["patches"], "links": stats["links"],
           "estimated": round(stats["estimated_error"], 4)}
    if reference:
        points = json.loads(reference.read_text())["probes"]
        asked, answers = work / "points.json", work / "answers.json"
        asked.write_text(json.dumps({"probes": [{"p": q["p"], "n": q["n"]} for q in points]}))
        usage = run([enfilade, "probe", run_directory, "--points", asked, "-o", answers])
        row |= {k: round(v, 4) for k, v in compare(json.loads(answers.read_text())["probes"], points).items()}
        row["probe_ms"] = round(1000.0 * (usage.ru_utime + usage.ru_stime) / len(points), 1)
    subprocess.run(["rm", "-rf", run_directory], check=True)
    return row


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("enfilade", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("scenes", nargs="+", help="SCENE or SCENE:REFERENCE")
    parser.add_argument("--targets", default="0.02,0.1,0.3")
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for named in options.scenes:
            scene, _, reference = named.partition(":")
            for target in options.targets.split(","):
                rows.append(measure(options.enfilade.resolve(), Path(scene), Path(reference) if reference else None, target, Path(folder)))
                with open(options.output, "w", newline="", encoding="utf-8") as file:
                    writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
                    writer.writeheader()
                    writer.writerows(rows)
    print("| building | surfaces | asked | CPU s | prepare s | ms a surface | MiB | links | estimated | L1 | noise | median beyond sigma | ms a point |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for row in rows:
        print("| " + " | ".join(str(row.get(k, "")) for k in FIELDS if k != "patches") + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
