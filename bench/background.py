"""What others would have had to take of the disk and the wire for a row of Table 2 to last as long as it did."""
from pathlib import Path

from study import run_case
from table2_model import minutes_at

WIRE_BYTES_S = 1.1e6  # of platforms/irisa_1998.xml
MOST = 0.98


def loaded(case: dict, share: float, compute_model: dict) -> dict:
    """The case with others at its disk and on its wire. SGI3 alone has its own disk and no wire."""
    edits = [[disk, "background", f"{share:.4f}"] for disk in ("NFS-disk", "SGI3-disk")]
    edits.append(["ethernet", "bandwidth", f"{WIRE_BYTES_S * (1.0 - share):.0f}Bps"])
    return {**case, "name": f"{case['name']}, others {share:.4f}", "cost_model": compute_model,
            "edits": case.get("edits", []) + edits}


def parts(stats: dict) -> tuple[float, float]:
    """The mean rank's minutes of computing and waiting, and of reading and writing."""
    io = sum(stats["io_s"]) / len(stats["io_s"])
    return (stats["simulated_s"] - io) / 60.0, io / 60.0


def free_compute(rows: list[tuple[float, float]], paper: list[float]) -> float:
    """What computing may cost at most, over what it cost in these replays, so that no row needs others to be less than
    nothing: the row that comes first had the cluster for itself."""
    return min((t - io) / moving for (moving, io), t in zip(rows, paper) if minutes_at((moving, io), 1.0) > 0.0)


def guess(moving: float, io: float, minutes: float, share: float) -> float:
    """A share that makes minutes of these parts, seen at `share`: what a rank waits for the disk is as 1 / (1 - share)
    as long as others are what it waits for."""
    return 1.0 - (1.0 - share) * io / max(1e-9, minutes - moving)


def infer(case: dict, model: dict, minutes: float, alone: tuple[float, float], recorded: Path, out: Path,
          programs: Path) -> tuple[float, float]:
    """The share that others take, and the row's minutes with it: to 1%, in at most eight replays. `alone`: the parts
    without others. More load takes longer, so that the share lies between those that were too little and too much."""
    low, high, share = 0.0, MOST, min(MOST, max(0.0, guess(*alone, minutes, 0.0)))
    tried = found = 0.0
    for _ in range(8):
        tried = share
        moving, io = parts(run_case(loaded(case, share, model), recorded, out, programs))
        found = moving + io
        if abs(found / minutes - 1.0) < 0.01 or (share == 0.0 and found > minutes):
            break
        low, high = (share, high) if found < minutes else (low, share)
        better = guess(moving, io, minutes, share)
        share = better if low < better < high else 0.5 * (low + high)
    return tried, found
