"""Rooms with known light, driven to extremes: every function returns a scene or surfaces for one."""


def surface(vertices, reflectance, exitance, **keys):
    as_list = lambda value: value if isinstance(value, list) else [value]
    return {"vertices": [list(map(float, v)) for v in vertices], "reflectance": as_list(reflectance),
            "exitance": as_list(exitance), **keys}


def scene(surfaces, probes=(), lights=()):
    return {"format": "enfilade-scene", "version": 1, "units": "m", "surfaces": surfaces,
            "probes": [{"p": list(p), "n": list(n)} for p, n in probes],
            "lights": [{"type": "point", "p": list(p), "intensity": intensity} for p, intensity in lights]}


def box_faces(lo, hi):
    """The six inner faces of a box: floor, ceiling, west, east, south, north."""
    (a, b, c), (d, e, f) = lo, hi
    return [[(a, b, c), (d, b, c), (d, e, c), (a, e, c)], [(a, b, f), (a, e, f), (d, e, f), (d, b, f)],
            [(a, b, c), (a, e, c), (a, e, f), (a, b, f)], [(d, b, c), (d, b, f), (d, e, f), (d, e, c)],
            [(a, b, c), (a, b, f), (d, b, f), (d, b, c)], [(a, e, c), (d, e, c), (d, e, f), (a, e, f)]]


def furnace(faces, reflectance=0.5, light=1.0, **keys):
    """Each face sends out (1 - reflectance) * light: in any closed room the irradiance is `light` everywhere."""
    bands = reflectance if isinstance(reflectance, list) else [reflectance]
    return [surface(face, bands, [(1.0 - r) * light for r in bands], name=f"face {i}", **keys)
            for i, face in enumerate(faces)]


def block(lo, hi):
    """The outer faces of a box."""
    return [list(reversed(face)) for face in box_faces(lo, hi)]


def fan(face, parts):
    """A quadrilateral as triangles from its first vertex: needles, the more parts the sharper."""
    a, b, c, d = face
    half = parts // 2
    rim = [tuple(p + (q - p) * i / half for p, q in zip(b, c)) for i in range(half)]
    rim += [tuple(p + (q - p) * i / half for p, q in zip(c, d)) for i in range(half + 1)]
    return [[a, p, q] for p, q in zip(rim, rim[1:])]
