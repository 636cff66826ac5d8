#!/usr/bin/python3
"""furnace.py RUN: how far a solved furnace is from its answer, `enfilade generate --furnace H`: H on every surface.

Prints the error of the surfaces' mean irradiances by area, their median error, the area that gets nothing, and what the run took."""
import csv
import json
import statistics
import sys
from pathlib import Path


def main(run, level):
    rows = []
    with (run / "surfaces.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            bands = [float(value) for key, value in row.items() if key.startswith("mean_irradiance") and value]
            if bands:
                rows.append((float(row["area_m2"]), max(abs(e - level) / level for e in bands), max(bands), row["object"]))
    area = sum(a for a, *_ in rows)
    dark = [(a, name) for a, _, e, name in rows if e == 0.0]
    stats = json.loads((run / "stats.json").read_text())
    print(f"off by {100 * sum(a * off for a, off, *_ in rows) / area:.3f}% by area, half of the surfaces by less than "
          f"{100 * statistics.median(off for _, off, *_ in rows):.4f}%")
    print(f"dark: {sum(a for a, _ in dark):.1f} of {area:,.0f} m2, on {len({name for _, name in dark})} objects")
    print(f"absorbed: {100 * (1 - abs(stats['flux_balance'])):.2f}% of the power sent out")
    print(f"{stats['patches']:,} patches, {stats['links']:,} links, {stats['iterations']} iterations, "
          f"{stats['peak_rss_bytes'] / 1e9:.2f} GB, {100 * stats['estimated_error']:.3f}% estimated")


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3:
        sys.exit("usage: furnace.py RUN [H]")
    main(Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 100.0)
