"""Form factors of planar convex polygons past convex occluders, to about 1e-12. Only NumPy, and nothing of Enfilade.

A polygon's front is the side from which its corners run counter-clockwise. Occluders are opaque from both sides. What x sees of a polygon is
cut out by the planes through x and the occluders' edges, and its form factor is Lambert's sum over the edges. Two polygons' factor is the
contour integral of ln r (Sparrow 1963), of which the inner integral is known; what occluders hide of it is integrated over the receiver, on
the cells between the lines at which the shadow changes its corners."""
import numpy as np

NODES = {n: np.polynomial.legendre.leggauss(n) for n in (10, 20)}


def normal(polygon):
    a = np.asarray(polygon, float)
    total = sum(np.cross(a[i] - a[0], a[i + 1] - a[0]) for i in range(1, len(a) - 1))
    return total / np.linalg.norm(total)


def area(polygon):
    a = np.asarray(polygon, float)
    return np.linalg.norm(sum(np.cross(a[i] - a[0], a[i + 1] - a[0]) for i in range(1, len(a) - 1))) / 2


def dot(a, b):
    return np.einsum("...i,...i->...", a, b)


def clip(pieces, planes, origins):
    """The part of each row's polygon in front of the row's plane. pieces: rows x corners x 3. Where a row has fewer corners than others, its last
    one is repeated; a row of which nothing is left is one point, repeated."""
    s = dot(pieces - origins[:, None, :], planes[:, None, :]) if pieces.shape[1] else np.zeros((1, 0))
    keep = s > 0
    if keep.all():
        return pieces
    if not keep.any():
        return pieces[:, :0]
    after, s_after = np.roll(pieces, -1, axis=1), np.roll(s, -1, axis=1)
    crosses = keep != np.roll(keep, -1, axis=1)
    t = np.where(crosses, s, 0) / np.where(crosses, s - s_after, 1)
    rows, corners = s.shape
    points = np.stack([pieces, pieces + t[..., None] * (after - pieces)], axis=2).reshape(rows, 2 * corners, 3)
    mask = np.stack([keep, crosses], axis=2).reshape(rows, 2 * corners)
    count = mask.sum(axis=1)
    order = np.argsort(~mask, axis=1, kind="stable")
    column = np.minimum(np.arange(count.max()), np.maximum(count, 1)[:, None] - 1)
    return np.take_along_axis(points, np.take_along_axis(order, column, axis=1)[..., None], axis=1)


def shadow_planes(x, occluder):
    """Inward planes of what the occluder hides from each row of x; none where x lies in the occluder's plane."""
    occluder = np.asarray(occluder, float)
    n, middle = normal(occluder), occluder.mean(axis=0)
    side = (x - middle) @ n
    if np.abs(side).max() < 1e-13 * (1 + np.abs(occluder).max()):
        return None
    planes = [-np.sign(side)[:, None] * n]
    for a, b in zip(occluder, np.roll(occluder, -1, axis=0)):
        m = np.cross(a - x, b - x)
        planes.append(m * np.sign(dot(middle - x, m))[:, None])
    origins = [np.tile(middle, (len(x), 1))] + [x] * len(occluder)
    return list(zip(planes, origins))


def split_by_shadow(pieces, x, occluder):
    """(what stays visible, what is hidden), each a list of arrays of rows x corners x 3."""
    planes = shadow_planes(x, occluder)
    if planes is None:
        return pieces, []
    seen, hidden = [], []
    for piece in pieces:
        parts, rest = [], piece
        for plane, origin in planes:
            parts.append(clip(rest, -plane, origin))
            rest = clip(rest, plane, origin)
            if rest.shape[1] == 0:
                break
        if rest.shape[1] == 0:
            seen.append(piece)
        else:
            seen += [part for part in parts if part.shape[1] > 2]
            hidden.append(rest)
    return seen, hidden


def lambert(pieces, x, n):
    """Sum of the pieces' form factors from each row of x with unit normal n; pieces in front of x's plane."""
    total = np.zeros(len(x))
    for piece in pieces:
        v = piece - x[:, None, :]
        w = np.roll(v, -1, axis=1)
        c = np.cross(v, w)
        size = np.linalg.norm(c, axis=-1)
        total += (np.arctan2(size, dot(v, w)) * (c @ n) / np.where(size == 0, 1, size)).sum(axis=1)
    return np.abs(total) / (2 * np.pi)


def visible(x, n, polygon, occluders):
    """What one point x with unit normal n sees of a polygon's front: a list of arrays of corners x 3."""
    x, polygon = np.asarray([x], float), np.asarray(polygon, float)
    if np.dot(x[0] - polygon.mean(axis=0), normal(polygon)) <= 1e-13:
        return []
    pieces = [clip(polygon[None], np.asarray([n], float), x)]
    for occluder in occluders:
        pieces, _ = split_by_shadow([p for p in pieces if p.shape[1] > 2], x, occluder)
    return [p[0] for p in pieces if p.shape[1] > 2]


def triangle_rule(a, b, c, order):
    """Gauss points of a triangle and their weights, which sum to 1; the points crowd at a."""
    g, w = NODES[order]
    u, v = (g + 1) / 2, (g + 1) / 2
    weight = np.outer(w * u, w).ravel() / 2
    u, v = np.repeat(u, order)[:, None], np.tile(v, order)[:, None]
    return a + u * ((1 - v) * (b - a) + v * (c - a)), weight


def integrate(f, triangles, tolerance, floor=1e-15, most=3000):
    """Integral over triangles (three corners each) of f(points) -> points x values, by halving the longest edge where two rules disagree by more than
    the tolerance's share and `floor`. Returns (value, sum of the last disagreements)."""
    total, error, count = 0.0, 0.0, 0
    stack = [t for t in triangles if area(t) > 1e-18]
    whole = sum(area(t) for t in stack)
    while stack:
        a, b, c = t = stack.pop()
        count += 1
        m2 = area(t)
        (p, w), (q, v) = triangle_rule(a, b, c, 10), triangle_rule(a, b, c, 20)
        rough, fine = m2 * (w @ f(p)), m2 * (v @ f(q))
        off = np.abs(rough - fine).max()
        if off > max(tolerance * m2 / whole, floor) and count < most:
            k = int(np.argmax([np.linalg.norm(t[i] - t[(i + 1) % 3]) for i in range(3)]))
            middle, far = (t[k] + t[(k + 1) % 3]) / 2, t[(k + 2) % 3]
            stack += [(far, t[k], middle), (far, middle, t[(k + 1) % 3])]
        else:
            total, error = total + fine, error + off
    return total, error


def fan(polygon):
    return [(polygon[0], polygon[i], polygon[i + 1]) for i in range(1, len(polygon) - 1)]


def in_front(polygon, plane_of):
    """The part of a polygon in front of another one's plane."""
    other = np.asarray(plane_of, float)
    return clip(np.asarray([polygon], float), normal(other)[None], other.mean(axis=0)[None])[0]


def log_integral(x, a, b):
    """Integral of ln |y - x| over y on the segment from a to b, per row of x."""
    length = np.linalg.norm(b - a)
    d = (b - a) / length
    low = (a - x) @ d
    height = np.linalg.norm(np.cross(a - x, d), axis=-1)

    def part(u):
        r2 = u * u + height * height
        return u * 0.5 * np.log(np.where(r2 > 0, r2, 1)) - u + height * np.arctan2(u, height)
    return part(low + length) - part(low)


def contour(p, q):
    """Area times form factor of two polygons in front of each other with nothing between."""
    total = 0.0
    for a, b in zip(p, np.roll(p, -1, axis=0)):
        for c, d in zip(q, np.roll(q, -1, axis=0)):
            cosine = np.dot(b - a, d - c) / np.linalg.norm(d - c)
            if abs(cosine) < 1e-15:
                continue
            # The integrand bends where a point of this edge comes close to the other.
            line = np.dot(b - a, b - a)
            cuts = sorted({0.0, 1.0} | {min(1.0, max(0.0, np.dot(e - a, b - a) / line)) for e in (c, d, (c + d) / 2)})
            stack = [(lo, hi, 0) for lo, hi in zip(cuts, cuts[1:])]
            while stack:
                lo, hi, depth = stack.pop()
                sums = []
                for order in (10, 20):
                    g, w = NODES[order]
                    s = lo + (hi - lo) * (g + 1) / 2
                    sums.append((hi - lo) / 2 * (w @ log_integral(a + s[:, None] * (b - a), c, d)))
                if abs(sums[0] - sums[1]) > 1e-15 * (1 + abs(sums[1])) and depth < 48:
                    stack += [(lo, (lo + hi) / 2, depth + 1), ((lo + hi) / 2, hi, depth + 1)]
                else:
                    total += cosine * sums[1]
    return total / (2 * np.pi)


def cut_lines(p, q, occluder):
    """Where, in p's plane, the occluder's shadow on q changes its corners as seen from p: (point, direction, range along it or None)."""
    n, origin, lines = normal(p), p.mean(axis=0), []

    def add(m, through, reach):
        direction = np.cross(m, n)
        if np.linalg.norm(direction) < 1e-9 * np.linalg.norm(m):
            return
        direction /= np.linalg.norm(direction)
        in_plane = m - np.dot(m, n) * n
        start = origin + in_plane * np.dot(through - origin, m) / np.dot(in_plane, in_plane)
        ends = None if reach is None else sorted(np.dot(e - start, direction) for e in reach)
        lines.append((start, direction, ends))

    def edges(polygon):
        return list(zip(polygon, np.roll(polygon, -1, axis=0)))

    def seen_through(c, a, b):
        """The edge's projection from c on p's plane; None where that has no end."""
        falls = [np.dot(e - c, n) for e in (a, b)]
        if falls[0] * falls[1] <= 1e-12 * max(abs(f) for f in falls) ** 2:
            return None
        return [c + (e - c) * np.dot(origin - c, n) / fall for e, fall in zip((a, b), falls)]
    for ends, corners in ((edges(q), occluder), (edges(occluder), q)):
        for a, b in ends:
            for c in corners:
                m = np.cross(b - a, c - a)
                if np.linalg.norm(m) > 1e-12:
                    add(m / np.linalg.norm(m), a, seen_through(c, a, b))
    add(normal(occluder), occluder[0], None)
    return lines


def split(polygons, line, n):
    start, direction, ends = line
    m = np.cross(direction, n)[None]
    out = []
    for polygon in polygons:
        s, t = (polygon - start) @ m[0], (polygon - start) @ direction
        crossed = s.max() > 1e-11 and s.min() < -1e-11
        if crossed and ends is not None:
            at = [t[i] + (t[j] - t[i]) * s[i] / (s[i] - s[j]) for i, j in zip(range(len(s)), np.roll(range(len(s)), -1)) if s[i] * s[j] < 0] + \
                [t[i] for i in range(len(s)) if s[i] == 0]
            crossed = min(at) < ends[1] + 1e-9 and max(at) > ends[0] - 1e-9
        if crossed:
            out += [clip(polygon[None], m, start[None])[0], clip(polygon[None], -m, start[None])[0]]
        else:
            out.append(polygon)
    return [polygon for polygon in out if len(polygon) > 2 and area(polygon) > 1e-16]


def hidden(p, q, occluder, tolerance):
    """(Area of p times the form factor to q that the occluder hides, the quadrature's own error)."""
    n, occluder = normal(p), np.asarray(occluder, float)
    cells = [p]
    for line in cut_lines(p, q, occluder):
        cells = split(cells, line, n)
    total, error = 0.0, 0.0
    for cell in cells:
        middle = cell.mean(axis=0)[None]
        # Where the middle sees all of q, all of the cell does.
        if not split_by_shadow([q[None]], middle, occluder)[1]:
            continue

        def f(x):
            pieces = split_by_shadow([np.broadcast_to(q, (len(x),) + q.shape)], x, occluder)[1]
            return lambert(pieces, x, n)[:, None]
        value, off = integrate(f, fan(cell), tolerance * area(cell) / area(p), 1e-3 * tolerance)
        total, error = total + float(np.sum(value)), error + off
    return total, error


def shadows_overlap(p, q, occluders, rng, points=40):
    """Largest form factor that two occluders hide together, from random points of p."""
    most, n = 0.0, normal(p)
    for x in rng.dirichlet(np.ones(len(p)), points) @ p:
        rows = x[None]
        for i, first in enumerate(occluders):
            once = split_by_shadow([q[None]], rows, first)[1]
            for second in occluders[:i] if once else ():
                twice = split_by_shadow(once, rows, second)[1]
                most = max(most, lambert(twice, rows, n)[0] if twice else 0.0)
    return most


def point_factor(x, n, polygon, occluders):
    """(Form factor from x, integral of the kernel times (y - the polygon's first corner)) of what is visible."""
    x, n = np.asarray(x, float), np.asarray(n, float)
    q, m = np.asarray(polygon, float), normal(polygon)
    pieces = visible(x, n, q, occluders)
    factor = sum(lambert([piece[None]], x[None], n)[0] for piece in pieces)

    def kernel(y):
        d = y - x
        r2 = dot(d, d)
        return ((d @ n) * -(d @ m) / (np.pi * r2 * r2))[:, None] * np.concatenate([np.ones((len(y), 1)), y - q[0]], axis=1)
    moment = np.zeros(4)
    for piece in pieces:
        moment = moment + integrate(kernel, fan(piece), 1e-13)[0]
    return factor, moment


def pair_factor(p, q, occluders, tolerance=1e-11):
    """(Form factor from p to q, the largest error that the computation knows of): from both sides, which share no quadrature point."""
    p, q = np.asarray(p, float), np.asarray(q, float)
    m2 = area(p)
    front_p, front_q = in_front(p, q), in_front(q, p)
    if len(front_p) < 3 or len(front_q) < 3:
        return 0.0, 0.0
    flux = contour(front_p, front_q)
    there = back = error = 0.0
    for occluder in occluders:
        one, off = hidden(front_p, front_q, occluder, tolerance * m2)
        other, off_back = hidden(front_q, front_p, occluder, tolerance * m2)
        there, back, error = there + one, back + other, max(error, off, off_back)
    return (flux - there) / m2, max(abs(there - back), error) / m2
