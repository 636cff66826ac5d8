#!/usr/bin/python3
"""tables.py NAME FILE.csv...: prints a CSV of bench/data, or one like it, as the table that stands in a page.

tables.py --check: of each CSV of bench/data, is every row of its table in its page, as it would be printed?"""
import csv
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
HOUSES = ("duplex", "fzk_haus", "bimwhale_large")
ROOMS = ("room_panel", "L_corridor", "two_rooms_door", "room_block", "cornell")


def number(x: float) -> str:
    """Three digits, but two decimals at most."""
    return "0" if x == 0.0 else f"{x:.2f}" if x < 1.0 else f"{x:.1f}" if x < 100.0 else f"{x:,.0f}"


def percent(text: str, digits: int = 2) -> str:
    return f"{100.0 * float(text):.{digits}f}"


def count(text: str) -> str:
    return f"{int(text):,}"


def minutes(row: dict, key: str) -> float:
    return float(row[key]) / 60.0


def name_of(row: dict) -> str:
    return row["scene"].removesuffix(".dense")


def estimate(row: dict) -> list[str]:
    return [name_of(row), f"{100 * float(row['target']):g}", percent(row["estimated_error"]), percent(row["true_error"]),
            percent(row["estimated_patch_error"]), percent(row["true_patch_error"]), count(row["links"])]


ESTIMATE_HEAD = ["asked %", "estimated %", "true %", "estimated of patches %", "true of patches %", "links"]


def estimates(rows: list[dict]):
    """Of the five rooms."""
    yield ["scene", *ESTIMATE_HEAD]
    yield from (estimate(row) for row in rows if name_of(row) in ROOMS)


def houses(rows: list[dict]):
    yield ["house", *ESTIMATE_HEAD, "user s"]
    yield from (estimate(row) + [f"{float(row['user_s']):.0f}"] for row in rows if name_of(row) in HOUSES)


def bases(rows: list[dict]):
    """Both bases of a run side by side; 10% stands in the CSV alone."""
    yield ["scene", "asked %", "links: linear", "constant", "user s: linear", "constant", "patches off by %: linear", "constant"]
    for linear, constant in zip(rows[::2], rows[1::2]):
        if float(linear["target"]) != 0.1:
            pair = (linear, constant)
            yield [name_of(linear), f"{100 * float(linear['target']):g}", *(count(r["links"]) for r in pair),
                   *(f"{float(r['user_s']):.2f}" for r in pair), *(percent(r["true_patch_error"], 3) for r in pair)]


def iterations(rows: list[dict]):
    yield ["reflectance", "ranks", "corrected", "paper", "Jacobi"]
    yield from ([row[key] for key in ("reflectance", "ranks", "corrected", "paper", "jacobi")] for row in rows)


def shares(rows: list[dict]):
    yield ["scene", "clusters", "links", "luminaires", "iterations", "sum off by %", "solve s", "with shares s", "solves", "at most"]
    yield from ([row["scene"], count(row["clusters"]), count(row["links"]), row["luminaires"], row["iterations"],
                 percent(row["difference"], 3), row["solve_s"], row["with_shares_s"], row["solves"], row["limit"]] for row in rows)


def floors(rows: list[dict], windows: str):
    yield ["storeys", "windows", "surfaces", "cells", "clusters", "visible pairs", "user s", "MiB"]
    yield from ([row["floors"], windows, *(count(row[key]) for key in ("surfaces", "cells", "clusters", "pairs")),
                 f"{float(row['user_s']):,.0f}", f"{float(row['memory_mib']):,.0f}"] for row in rows)


def floors_open(rows: list[dict]):
    return floors(rows, "open")


def floors_closed(rows: list[dict]):
    return floors(rows, "closed")


def table2(rows: list[dict]):
    yield ["computers", "paper", "simulated", "error", "null model", "others take", "error then",
           "speed-up: printed / by its minutes / simulated"]
    for row in rows:
        ratios = [float(rows[0][key]) / float(row[key]) for key in ("paper_minutes", "simulated_s")]
        others = ([f"{100 * float(row['others_share']):.0f}%", f"{100 * float(row['others_error']):+.1f}%"]
                  if row.get("others_share") else ["", ""])
        yield [row["case"], count(row["paper_minutes"]), f"{minutes(row, 'simulated_s'):,.0f}", f"{100 * float(row['error']):+.1f}%",
               f"{100 * float(row['null_error']):+.1f}%", *others, f"{row['paper_speed_up']} / {ratios[0]:.2f} / {ratios[1]:.2f}"]


def parts(row: dict, shown) -> str:
    return " / ".join(shown(float(row[key])) for key in ("mean_compute_s", "mean_io_s", "mean_idle_s"))


def whatif(rows: list[dict]):
    yield ["case", "ranks", "simulated min", "of that, mean rank: computing / files / waiting"]
    yield from ([row["case"], row["ranks"], f"{minutes(row, 'simulated_s'):,.0f}", parts(row, lambda s: f"{s / 60.0:,.0f}")]
                for row in rows)


def scaling(rows: list[dict]):
    """Strong scaling, and weak scaling where it has as many ranks."""
    yield ["ranks", "strong: time", "computing / files / waiting of the mean rank", "GB read", "speed-up", "weak: time",
           "computing / files / waiting"]
    weak = {row["ranks"]: row for row in rows if row["kind"] == "weak"}
    strong = [row for row in rows if row["kind"] == "strong"]
    for row in strong:
        beside = weak.get(row["ranks"])
        yield [count(row["ranks"]), number(float(row["simulated_s"])), parts(row, number), number(float(row["bytes_read"]) / 1e9),
               f"{float(strong[0]['simulated_s']) / float(row['simulated_s']):.1f}",
               *([number(float(beside["simulated_s"])), parts(beside, number)] if beside else ["", ""])]


TABLES = {table.__name__: table for table in (estimates, houses, bases, iterations, shares, floors_open, floors_closed, table2,
                                              whatif, scaling)}
PAGES = {"accuracy.md": {"estimates": "estimates", "houses": "estimates", "bases": "bases", "iterations": "iterations"},
         "cells.md": {"floors_open": "floors_open", "floors_closed": "floors_closed"},
         "README.md": {"shares": "shares", "table2": "table2", "whatif": "whatif", "scaling": "scaling"}}


def lines(name: str, paths: list[Path]) -> list[str]:
    rows = []
    for path in paths:
        with path.open(newline="") as file:
            rows += csv.DictReader(file)
    head, *body = TABLES[name](rows)
    return ["".join(f"| {cell} " if cell else "| " for cell in cells) + "|" for cells in (head, ["---"] * len(head), *body)]


def check() -> int:
    missing = 0
    for page, tables in PAGES.items():
        text = set((HERE / page).read_text().splitlines())
        for name, data in tables.items():
            for line in lines(name, [HERE / "data" / f"{data}.csv"]):
                if line not in text:
                    missing += 1
                    print(f"{page} lacks a row of data/{data}.csv: {line}")
    return 1 if missing else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        sys.exit(check())
    if len(sys.argv) < 3 or sys.argv[1] not in TABLES:
        sys.exit(f"{__doc__}\nNAME is one of {', '.join(TABLES)}")
    print("\n".join(lines(sys.argv[1], [Path(name) for name in sys.argv[2:]])))
