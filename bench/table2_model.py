"""What is done with Table 2 of RR-3425: errors, the null model, the fit of the calibrated numbers, and how well any
cluster of one make could do."""
import json
import math
import xml.etree.ElementTree as xml
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAPER_BYTES = 3.0e9  # of all data structures (section 5)
WORST = 0.15  # that a row may be wrong by


def host_speeds(platform: Path) -> dict[str, float]:
    """Relative speeds of the platform's hosts; SUN1-1 is 1."""
    units = {"Gf": 1e9, "Mf": 1e6}
    speeds = {h.get("id"): float(h.get("speed")[:-2]) * units[h.get("speed")[-2:]]
              for h in xml.parse(platform).iter("host")}
    return {name: speed / speeds["SUN1-1"] for name, speed in speeds.items()}


def mean_error(errors: list[float]) -> float:
    return sum(abs(e) for e in errors) / len(errors)


def worst_error(errors: list[float]) -> float:
    return max(abs(e) for e in errors)


def null_model(paper: list[float], capacities: list[float]) -> tuple[float, list[float]]:
    """T = W / sum of speeds: the W whose mean absolute error is least (it lies where one row is exact), and the
    relative errors."""
    def errors(work: float) -> list[float]:
        return [work / c / t - 1.0 for c, t in zip(capacities, paper)]
    work = min((t * c for c, t in zip(capacities, paper)), key=lambda w: mean_error(errors(w)))
    return work, errors(work)


def scaled(model: dict, ratio: float) -> dict:
    """The cost model with computing `ratio` times as dear."""
    flops = {key: value if isinstance(value, str) or key.startswith("byte") else value * ratio
             for key, value in model["flops"].items()}
    return model | {"flops": flops}


def cost_model(base: Path, mesh: dict, compute: float, shared: float, request_s: float) -> dict:
    """The cost model with the calibrated numbers put in. compute: flops over those of the default model; shared: of
    the paper's 3 GB, the share that others load of a cluster (the rest is links, which only its own gather needs);
    request_s: of the client and the server, for one request. mesh: patches and links of the recorded run, over
    which the 3 GB are spread."""
    model = scaled(json.loads(base.read_text()), compute)
    model["flops"] |= {"byte_read": 0, "byte_written": 0}
    model["disk"] = model["disk"] | {"request_s": request_s, "request_bytes": 1048576}
    model["records"] = {"surface_bytes": 0,
                        "patch_bytes": round(PAPER_BYTES * shared / mesh["patches"]),
                        "link_bytes": round(PAPER_BYTES * (1.0 - shared) / mesh["links"])}
    return model


def minutes_at(row: tuple[float, float], ratio: float) -> float:
    """A row's (computing and waiting, reading and writing) minutes, when computing costs `ratio` times as much: ranks
    wait for each other's computing, and the disk takes as long as before. Near 1 that is what a replay finds."""
    return ratio * row[0] + row[1]


def fit(tables: dict, paper: list[float], leave_out: int = -1) -> tuple[tuple, float, list[float]]:
    """tables[(shared, request_s)] = (compute of its replays, their rows as minutes_at() takes them). The key, the
    compute and the errors of the best fit over the rows but `leave_out`."""
    best = None
    for key, (compute, rows) in sorted(tables.items()):
        for i in range(201):
            ratio = 0.5 + i / 200
            errors = [minutes_at(row, ratio) / t - 1.0 for row, t in zip(rows, paper)]
            counted = [e for r, e in enumerate(errors) if r != leave_out]
            value = mean_error(counted) + max(0.0, worst_error(counted) - WORST)
            if best is None or value < best[0]:
                best = (value, key, ratio * compute, errors)
    return best[1:]


def least_error_of_growing_work(paper: list[float], capacities: list[float], chains: list[list[int]],
                                worst: float = math.inf) -> float:
    """The least mean error that any model can have in which time times speed does not shrink along a chain of rows,
    whatever makes it grow. Rows of a chain have the earlier ones' computers and more; every row is in one chain. inf
    where none keeps to `worst`."""
    products = [t * c for t, c in zip(paper, capacities)]
    tried = sorted({p * f for p in products for f in (1.0, 1.0 - worst, 1.0 + worst) if 0.0 < f < math.inf})
    total = 0.0
    for chain in chains:
        best = [0.0] * len(tried)  # of the rows so far, the last at no more than tried[i]
        for row in chain:
            least = math.inf
            for i, value in enumerate(tried):
                error = abs(value / products[row] - 1.0)
                least = min(least, best[i] + (error if error <= worst + 1e-9 else math.inf))
                best[i] = least
        total += best[-1]
    return total / len(paper)
