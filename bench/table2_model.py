"""What is done with Table 2 of RR-3425: errors, speed-ups, the null model, and the fit of the calibrated numbers."""
import json
import xml.etree.ElementTree as xml
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAPER_BYTES = 3.0e9  # of all data structures (section 5)


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


def cost_model(base: Path, mesh: dict, compute: float, shared: float, request_s: float) -> dict:
    """The cost model with the calibrated numbers put in. compute: flops over those of the default model; shared: of
    the paper's 3 GB, the share that others load of a cluster (the rest is links, which only its own gather needs);
    request_s: of the client and the server, for one request. mesh: patches and links of the recorded run, over
    which the 3 GB are spread."""
    model = json.loads(base.read_text())
    flops = {key: value if isinstance(value, str) or key.startswith("byte") else value * compute
             for key, value in model["flops"].items()}
    model["flops"] = flops | {"byte_read": 0, "byte_written": 0}
    model["disk"] = model["disk"] | {"request_s": request_s, "request_bytes": 1048576}
    model["records"] = {"surface_bytes": 0,
                        "patch_bytes": round(PAPER_BYTES * shared / mesh["patches"]),
                        "link_bytes": round(PAPER_BYTES * (1.0 - shared) / mesh["links"])}
    return model


def fit(tables: dict, paper: list[float], leave_out: int = -1) -> tuple[tuple, float, list[float]]:
    """tables[(shared, request_s)] = [(compute, minutes by row), (another compute, minutes by row)]. Between the two
    the minutes are taken as linear in compute. The key, the compute and the errors of the best fit over the rows but
    `leave_out`."""
    best = None
    for key, ((c0, low), (c1, high)) in sorted(tables.items()):
        for i in range(201):
            at = -0.5 + 2.0 * i / 200
            minutes = [a + at * (b - a) for a, b in zip(low, high)]
            errors = [m / t - 1.0 for m, t in zip(minutes, paper)]
            counted = [e for r, e in enumerate(errors) if r != leave_out]
            value = mean_error(counted) + max(0.0, worst_error(counted) - 0.15)
            if best is None or value < best[0]:
                best = (value, key, c0 + at * (c1 - c0), errors)
    return best[1:]
