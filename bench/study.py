#!/usr/bin/python3
"""study.py NAME|FILE.json [-o DIRECTORY] [--build BUILD] [--case TEXT] [--set KEY=VALUE ...]

Runs a study: cases of one recorded run on simulated clusters, described as data (bench/studies/*.json, whose keys
bench/README.md explains). Leaves DIRECTORY/NAME.csv, a row a case; a case that was run before with the same command
and files is not run again."""
import argparse
import csv
import hashlib
import json
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COLUMNS = ("iterations converged estimated_error patches links rays steals steal_requests messages message_bytes "
           "bytes_read bytes_written peak_cluster_bytes over_budget_bytes simulated_s").split()


class StudyError(Exception):
    """What is wrong with a study, or with one of its runs."""


def read_study(name: str, settings: list[str]) -> dict:
    path = Path(name) if name.endswith(".json") else ROOT / "bench/studies" / f"{name}.json"
    study = json.loads(path.read_text())
    if study.get("format") != "enfilade-study" or study.get("version") != 1:
        raise StudyError(f"{path}: not an enfilade-study of version 1")
    for setting in settings:
        key, _, value = setting.partition("=")
        if key not in study:
            raise StudyError(f"--set {key}: no such key in {path}")
        study[key] = json.loads(value)
    study.setdefault("name", path.stem)
    return study


def run(command: list, log: Path) -> None:
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("w") as out:
        code = subprocess.run([str(c) for c in command], stdout=out, stderr=subprocess.STDOUT, cwd=ROOT).returncode
    if code != 0:
        raise StudyError(f"{' '.join(map(str, command))}\n  ended with {code}; {log} says why")


def recorded_run(study: dict, out: Path, programs: Path) -> Path:
    """The run that the cases replay: solved once, on one rank."""
    if "run" in study:
        return Path(study["run"]).resolve()
    what = json.dumps([study["scene"], study["solve"]])
    directory = out / ("run-" + hashlib.sha256(what.encode()).hexdigest()[:8])
    if not (directory / "stats.json").exists():
        scene = study["scene"]
        if isinstance(scene, list):
            run([programs / "enfilade", "generate", *scene, "-o", out / "scene.json"], out / "generate.log")
            scene = out / "scene.json"
        run([programs / "enfilade", "solve", scene, "-o", directory, "--no-pictures", *study["solve"]],
            out / "solve.log")
    return directory


def edited_platform(platform: Path, edits: list, target: Path) -> None:
    """Applies [[id, attribute or property, value], ...]; value null takes the property away."""
    tree = xml.parse(platform)
    for name, key, value in edits:
        element = next((e for e in tree.iter() if e.get("id") == name), None)
        if element is None:
            raise StudyError(f"{platform}: nothing has the id {name}")
        old = next((p for p in element.findall("prop") if p.get("id") == key), None)
        if key in element.attrib:
            element.set(key, value)
        elif value is None:
            element.remove(old)
        elif old is not None:
            old.set("value", value)
        elif key == "disk":  # name, bytes a second: a disk of its own
            xml.SubElement(element, "disk", id=value[0], read_bw=value[1], write_bw=value[1])
        else:
            xml.SubElement(element, "prop", id=key, value=value)
    tree.write(target, encoding="unicode",
               xml_declaration=False)
    text = target.read_text()
    target.write_text('<?xml version="1.0"?>\n<!DOCTYPE platform SYSTEM "https://simgrid.org/simgrid.dtd">\n' + text)


def hosts_of(case: dict) -> list[str]:
    if isinstance(case["hosts"], list):
        return case["hosts"]
    return (ROOT / case["hosts"]).read_text().split()


def run_case(case: dict, recorded: Path, out: Path, programs: Path) -> dict:
    """The case's stats.json."""
    directory = out / re.sub(r"[^a-z0-9]+", "-", case["name"].lower()).strip("-")
    directory.mkdir(parents=True, exist_ok=True)
    platform, hosts = directory / "platform.xml", hosts_of(case)
    edited_platform(ROOT / case["platform"], case.get("edits", []), platform)
    (directory / "hosts").write_text("\n".join(hosts) + "\n")
    ranks = sum(int(h.partition(":")[2] or 1) for h in hosts)
    model = case["cost_model"]
    if not isinstance(model, str):
        (directory / "cost.json").write_text(json.dumps(model, indent=1))
        model = directory / "cost.json"
    source = ["--replay", recorded] if case.get("replay", True) else [case["scene"]]
    command = ["smpirun", "-np", ranks, "-platform", platform, "-hostfile", directory / "hosts",
               *case.get("smpirun", []), programs / "enfilade-smpi", "solve", *source, "-o", directory / "RUN",
               "--cost-model", ROOT / model, "--quiet", *case.get("options", [])]
    files = "".join(Path(f).read_text() for f in (platform, directory / "hosts", ROOT / model))
    key = hashlib.sha256((" ".join(map(str, command)) + files).encode()).hexdigest()
    mark, stats = directory / "done", directory / "RUN/stats.json"
    if not (stats.exists() and mark.exists() and mark.read_text() == key):
        shutil.rmtree(directory / "RUN", ignore_errors=True)
        run(command, directory / "log")
        mark.write_text(key)
    return json.loads(stats.read_text())


def row_of(case: dict, stats: dict) -> dict:
    row = {"case": case["name"], **case.get("columns", {}), "ranks": stats["ranks"]}
    row.update({key: stats[key] for key in COLUMNS if key in stats})
    for key in ("compute_s", "io_s", "idle_s"):
        row["mean_" + key] = sum(stats[key]) / len(stats[key])
        row["max_" + key] = max(stats[key])
    return row


def cases_of(study: dict) -> list[dict]:
    common = {key: study[key] for key in ("platform", "cost_model", "options", "smpirun", "hosts") if key in study}
    return [{**common, **case, "options": common.get("options", []) + case.get("options", [])}
            for case in study["cases"]]


def run_study(study: dict, out: Path, programs: Path, only: str = "") -> list[dict]:
    recorded = recorded_run(study, out, programs)
    rows = []
    for case in cases_of(study):
        if only not in case["name"]:
            continue
        rows.append(row_of(case, run_case(case, recorded, out, programs)))
        print(f"{case['name']:40} {rows[-1]['simulated_s'] / 60:12.1f} min", flush=True)
    return rows


def write_rows(rows: list[dict], path: Path) -> None:
    with path.open("w", newline="") as out:
        writer = csv.DictWriter(out, fieldnames=list(rows[0]), restval="")
        writer.writeheader()
        writer.writerows(rows)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study")
    parser.add_argument("-o", "--out", type=Path, help="default: out/NAME")
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--case", default="", help="only cases with this in their name")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=JSON", help="another value for a key")
    arguments = parser.parse_args()
    try:
        study = read_study(arguments.study, arguments.set)
        out = (arguments.out or ROOT / "out" / study["name"]).resolve()
        rows = run_study(study, out, arguments.build.resolve() / "bin", arguments.case)
        if not rows:
            raise StudyError(f"no case has '{arguments.case}' in its name")
        write_rows(rows, out / f"{study['name']}.csv")
    except (StudyError, OSError, json.JSONDecodeError) as error:
        print(f"study.py: {error}", file=sys.stderr)
        return 1
    print(out / f"{study['name']}.csv")
    return 0


if __name__ == "__main__":
    sys.exit(main())
