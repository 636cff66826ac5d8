#!/usr/bin/python3
"""Prints how exact the light is, and what it took: the scenes of tests/accuracy/data against their independent answers.

usage: bench/accuracy_table.py build/release/bin/enfilade [SCENE ...] [--points] [--target-error 0.02 0.01 ...]

SCENE is a scene's name there (default: all with a dense reference, and the CIE 171 cases). --points prints a row a point instead:
where the answer is 0, the light found as a share of the largest in its scene.
"""
import argparse
import json
import os
import re
import subprocess
import tempfile

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "accuracy", "data")
SCENES = ["room_panel", "L_corridor", "two_rooms_door", "room_block", "cornell", "cie_5_3_area_source",
          "cie_5_6_S2_0.5m", "cie_5_6_S2_4m", "cie_5_7_obstruction", "cie_5_8_cube_a", "cie_5_8_cube_b"]


def reference_of(scene):
    for suffix in (".dense.json", ".ref.json", ".json"):
        path = os.path.join(DATA, scene + suffix)
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                return path, json.load(file)["probes"]
    raise SystemExit(f"no reference for {scene} in {DATA}")


def solve(enfilade, scene, target, points, folder):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    run = os.path.join(folder, f"{scene}_{target}")
    call = dict(check=True, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    subprocess.run([enfilade, "solve", os.path.join(DATA, scene + ".json"), "-o", run, "--no-pictures", "--quiet",
                    "--target-error", str(target)], **call)
    answers = {}
    for method in ("gather", "patches"):
        path = os.path.join(run, method + ".json")
        subprocess.run([enfilade, "probe", run, "--points", points, "-o", path, "--from", method], **call)
        with open(path, encoding="utf-8") as file:
            answers[method] = [p["E"] for p in json.load(file)["probes"]]
    with open(os.path.join(run, "stats.json"), encoding="utf-8") as file:
        return json.load(file), answers


def errors(want, got):
    """Relative L1 and RMS, and each point's error beyond the reference's own, relative: the worst band of each."""
    l1 = rms = 0.0
    points = [0.0] * len(want)
    for band in range(len(got[0])):
        reference = [p["E"][band] for p in want]
        mean = sum(reference) / len(reference)
        if mean == 0.0:
            continue
        off = [abs(g[band] - r) for g, r in zip(got, reference)]
        l1 = max(l1, sum(off) / len(off) / mean)
        rms = max(rms, (sum(o * o for o in off) / len(off)) ** 0.5 / mean)
        beyond = [max(0.0, o - p.get("err", 0.0)) / max(r, 1e-3 * mean) for o, r, p in zip(off, reference, want)]
        points = [max(a, b) for a, b in zip(points, beyond)]
    return l1, rms, points


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("enfilade")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    parser.add_argument("--target-error", nargs="+", type=float, default=[0.02])
    parser.add_argument("--points", action="store_true")
    options = parser.parse_intermixed_args()
    print("| case | point | normal | reference | found | error % |\n| --- | --- | --- | --- | --- | --- |" if options.points else
          "| scene | asked % | links | rays | estimated % | gather: L1 % | RMS % | worst % | patches: L1 % | RMS % |\n"
          "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes:
            path, want = reference_of(scene)
            for target in options.target_error:
                stats, answers = solve(options.enfilade, scene, target, path, folder)
                if options.points:
                    print_points(scene, want, answers["gather"])
                    continue
                l1, rms, points = errors(want, answers["gather"])
                patch_l1, patch_rms, _ = errors(want, answers["patches"])
                print(f"| {scene} | {100 * target:g} | {stats['links']:,} | {stats['rays']:,} | "
                      f"{100 * stats['estimated_error']:.2f} | {100 * l1:.3f} | {100 * rms:.3f} | {100 * max(points):.2f} | "
                      f"{100 * patch_l1:.2f} | {100 * patch_rms:.2f} |", flush=True)


def print_points(scene, want, got):
    """The band that is worst at each point."""
    case = re.sub(r"(?<=\d)m$", " m", scene.removeprefix("cie_").replace("_", ".", 1).replace("_", " "))
    largest = max(max(point["E"]) for point in want)
    for point, answer in zip(want, got):
        off, exact, found = max((abs(f - e) / (e or largest), e, f) for e, f in zip(point["E"], answer))
        place, normal = (" ".join(f"{x:g}" for x in point[key]) for key in ("p", "n"))
        print(f"| {case} | {place} | {normal} | {exact:.5g} | {found:.5g} | {100 * off:.3f}{'' if exact else ' of the largest'} |",
              flush=True)


if __name__ == "__main__":
    main()
