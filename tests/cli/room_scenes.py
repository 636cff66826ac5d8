"""Scenes of rooms for the tests of the command line, made in code."""


def flip(polygon):
    return polygon[::-1]


def prism(outline, low, high, reflectance, exitance, name):
    """The inner faces of a room with this outline (counter-clockwise): floor, ceiling, a wall a side."""
    def surface(vertices, what):
        return {"vertices": [list(v) for v in vertices], "reflectance": reflectance, "exitance": exitance,
                "name": f"{name} {what}", "object": name}
    floor = [(x, y, low) for x, y in outline]
    ceiling = flip([(x, y, high) for x, y in outline])
    surfaces = [surface(floor, "floor"), surface(ceiling, "ceiling")]
    for i, (x, y) in enumerate(outline):
        nx, ny = outline[(i + 1) % len(outline)]
        surfaces.append(surface([(nx, ny, low), (x, y, low), (x, y, high), (nx, ny, high)], f"wall {i}"))
    return surfaces


def box(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def block(x0, y0, z0, x1, y1, z1, name, reflectance=0.5):
    """A solid block, its faces outward."""
    return [{**s, "vertices": flip(s["vertices"])}
            for s in prism(box(x0, y0, x1, y1), z0, z1, reflectance, 0.0, name)]


def lamp(x, y, z, side, exitance, name="lamp"):
    """A square that faces down."""
    h = side / 2
    corners = [(x - h, y - h, z), (x - h, y + h, z), (x + h, y + h, z), (x + h, y - h, z)]
    return {"vertices": [list(c) for c in corners], "reflectance": 0.0, "exitance": exitance, "name": name,
            "object": name}


def scene(surfaces, **more):
    return {"format": "enfilade-scene", "version": 1, "units": "m", "exitanceUnits": "lm/m2", "surfaces": surfaces,
            **more}
