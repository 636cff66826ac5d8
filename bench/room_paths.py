"""The light at points of a small room by paths, for bench/random_rooms.py: direct light in closed form past all occluders, reflected light by
random paths with a shadow ray to each lamp at each reflection. Close to a lamp the kernel has no bound, and the few paths that come there would bring
light that the standard error of the others does not tell: a shadow ray and the ray that goes on share what both can find, by the balance heuristic
(Veach 1997, chapter 9), so that no path brings more than a lamp's exitance at a reflection. Only NumPy and tests/accuracy/form_factors/exact_factors.py, and nothing of
Enfilade. Polygons are convex, with at most 8 corners; all reflect on both sides but lamps, which reflect nothing and send light from their front."""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests/accuracy/form_factors"))
from exact_factors import area, dot, lambert, normal, visible  # noqa: E402

OFFSET_M = 1e-6
BOUNCES_BEFORE_CHANCE, SURVIVAL, MOST_BOUNCES = 3, 0.6, 60


class Room:
    def __init__(self, surfaces):
        self.polygons = [np.asarray(s["vertices"], float) for s in surfaces]
        self.n = np.array([normal(p) for p in self.polygons])
        self.reflectance = np.array([s["reflectance"] for s in surfaces])
        self.exitance = np.array([s["exitance"] for s in surfaces])
        self.area = np.array([area(p) for p in self.polygons])
        self.lamps = np.flatnonzero(self.exitance > 0)
        self.origin = np.array([p[0] for p in self.polygons])
        # Inward planes of all edges, padded with planes that everything is in front of.
        most = max(map(len, self.polygons))
        self.edge = np.zeros((len(self.polygons), most, 3))
        self.edge_at = np.full((len(self.polygons), most), -1e-9)
        for k, p in enumerate(self.polygons):
            for i, (a, b) in enumerate(zip(p, np.roll(p, -1, axis=0))):
                self.edge[k, i] = np.cross(self.n[k], b - a)
                self.edge_at[k, i] = self.edge[k, i] @ a
    def crossings(self, x, d, k, most):
        """Where rays meet polygon k before `most`; inf where they do not."""
        fall = d @ self.n[k]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (self.origin[k] - x) @ self.n[k] / fall
        rows = np.flatnonzero((t > OFFSET_M) & (t < most))
        at = np.full(len(x), np.inf)
        if rows.size:
            y = x[rows] + t[rows, None] * d[rows]
            inside = np.all(y @ self.edge[k].T >= self.edge_at[k], axis=1)
            at[rows[inside]] = t[rows[inside]]
        return at

    def closest(self, x, d):
        best, which = np.full(len(x), np.inf), np.full(len(x), -1)
        for k in range(len(self.polygons)):
            t = self.crossings(x, d, k, best)
            nearer = t < best
            best[nearer], which[nearer] = t[nearer], k
        return best, which

    def open(self, x, y, skip):
        """True where nothing but polygon `skip` lies between."""
        free, d = np.ones(len(x), bool), y - x
        for k in range(len(self.polygons)):
            if k != skip:
                free &= ~np.isfinite(self.crossings(x, d, k, 1 - 1e-9))
        return free

    def direct(self, x, n):
        """Of one point, in closed form."""
        total = 0.0
        for k in self.lamps:
            if (x - self.polygons[k].mean(axis=0)) @ self.n[k] <= 0:
                continue
            others = [p for j, p in enumerate(self.polygons) if j != k and not beside(p, x, n, self.polygons[k])]
            pieces = visible(x, n, self.polygons[k], others)
            total += self.exitance[k] * sum(lambert([piece[None]], x[None], n)[0] for piece in pieces)
        return total

    def sampled_direct(self, x, n, rng):
        """Of many points, by one shadow ray to each lamp: the part that the rays which go on leave to it."""
        total = np.zeros(len(x))
        for k in self.lamps:
            y = points_on(self.polygons[k], len(x), rng)
            d = y - x
            r2 = dot(d, d)
            kernel = np.maximum(dot(d, n), 0) * np.maximum(-(d @ self.n[k]), 0) / (np.pi * r2 * r2)
            rows = np.flatnonzero(kernel > 0)
            if rows.size:
                rows = rows[self.open(x[rows], y[rows], k)]
            weight = self.area[k] * kernel[rows]  # density of a ray that goes on, over that of a shadow ray
            total[rows] += self.exitance[k] * weight / (1 + weight)
        return total

    def met(self, k, t, d, n):
        """The light that rays from points with normals n find where they meet a lamp: what they leave to shadow rays taken off."""
        fall = -dot(d, self.n[k])
        goes_on, shadow = dot(d, n) / np.pi, t * t / (self.area[k] * np.maximum(fall, 1e-300))
        return np.where(fall > 0, self.exitance[k] * goes_on / (goes_on + shadow), 0.0)

    def reflected(self, x, n, paths, rng):
        """(Mean, standard error) per point."""
        start = np.repeat(np.arange(len(x)), paths)
        x, n = x[start] + OFFSET_M * n[start], n[start]
        found, carried, path = np.zeros(len(x)), np.ones(len(x)), np.arange(len(x))
        for bounce in range(MOST_BOUNCES):
            d = cosine_directions(n, rng)
            t, k = self.closest(x, d)
            rows = np.flatnonzero(k >= 0)
            if bounce > 0:  # the points' own direct light is had in closed form
                lamps = rows[self.exitance[k[rows]] > 0]
                found[path[lamps]] += carried[lamps] * self.met(k[lamps], t[lamps], d[lamps], n[lamps])
            rows = rows[self.reflectance[k[rows]] > 0]
            x, d, t, k, carried, path = x[rows], d[rows], t[rows], k[rows], carried[rows], path[rows]
            carried = carried * self.reflectance[k]
            if bounce >= BOUNCES_BEFORE_CHANCE:
                live = rng.random(len(x)) < SURVIVAL
                x, d, t, k, carried, path = x[live], d[live], t[live], k[live], carried[live] / SURVIVAL, path[live]
            if not len(x):
                break
            n = self.n[k] * -np.sign(dot(d, self.n[k]))[:, None]
            x = x + t[:, None] * d + OFFSET_M * n
            found[path] += carried * self.sampled_direct(x, n, rng)
        found = found.reshape(-1, paths)
        return found.mean(axis=1), found.std(axis=1, ddof=1) / np.sqrt(paths)


def beside(p, x, n, lamp):
    """True where a polygon lies wholly behind x's plane or behind the lamp: it hides nothing."""
    m = normal(lamp)
    return ((p - x) @ n).max() <= 1e-9 or ((p - lamp[0]) @ m).max() <= 1e-9


def cosine_directions(n, rng):
    helper = np.where(np.abs(n[:, :1]) < 0.6, [[1.0, 0, 0]], [[0, 1.0, 0]])
    u = np.cross(helper, n)
    u /= np.linalg.norm(u, axis=1)[:, None]
    r2, turn = rng.random(len(n)), 2 * np.pi * rng.random(len(n))
    r = np.sqrt(r2)
    return (r * np.cos(turn))[:, None] * u + (r * np.sin(turn))[:, None] * np.cross(n, u) + np.sqrt(1 - r2)[:, None] * n


def points_on(polygon, count, rng):
    """Uniform over the area of a convex polygon."""
    fan = np.array([np.linalg.norm(np.cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0])) for i in range(1, len(polygon) - 1)])
    i = 1 + rng.choice(len(fan), size=count, p=fan / fan.sum())
    s, r = np.sqrt(rng.random(count))[:, None], rng.random(count)[:, None]
    return polygon[0] + s * ((1 - r) * (polygon[i] - polygon[0]) + r * (polygon[i + 1] - polygon[0]))
