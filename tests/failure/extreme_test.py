#!/usr/bin/python3
"""Rooms driven to extremes, against the light that they have in closed form.

extreme_test.py ENFILADE [unittest arguments]"""
import json
import math
import sys
import unittest

from rooms import block, box_faces, fan, furnace, scene, surface
from solving import Solving, answers_of, irradiances

ROOM = box_faces((0, 0, 0), (4, 3, 2.5))
ON_EDGES = [((0, 0, 0), (0, 0, 1)), ((2, 0, 0), (0, 0, 1)), ((2, 0, 0), (0, 1, 0)), ((4, 3, 2.5), (0, 0, -1)),
            ((0, 1.5, 1.25), (1, 0, 0)), ((2, 1.5, 0), (0, 0, 1)), ((2, 1.5, 0), (0, 0, 1))]


class Furnaces(Solving):
    """Whatever the shapes, the irradiance is the same everywhere."""

    def assert_light(self, the_scene, light, tolerance=0.005):
        run, result = self.solve(the_scene)
        for name, irradiance in irradiances(run).items():
            for got, want in zip(irradiance, light):
                self.assertAlmostEqual(got / want, 1.0, delta=tolerance, msg=name)
        for probe, answer in zip(the_scene["probes"], answers_of(run) if the_scene["probes"] else []):
            for got, want in zip(answer, light):
                self.assertAlmostEqual(got / want, 1.0, delta=tolerance, msg=probe["p"])
        return result

    def test_probes_on_edges_in_corners_and_twice(self):
        self.assert_light(scene(furnace(ROOM), ON_EDGES), [1.0])

    def test_needles(self):
        self.assert_light(scene(furnace(fan(ROOM[0], 60) + ROOM[1:]), ON_EDGES), [1.0])

    def test_a_thousand_copies_of_the_floor(self):
        result = self.assert_light(scene(furnace([ROOM[0]] * 1000 + ROOM[1:]), ON_EDGES), [1.0])
        self.assertIn("same outline and material as an earlier surface: dropped", result.stderr)

    def test_sixteen_bands(self):
        reflectance = [i / 17 for i in range(16)]
        self.assert_light(scene(furnace(ROOM, reflectance, 7.0), ON_EDGES), [7.0] * 16)

    def test_faint_and_dazzling_light(self):
        for light in (1e-12, 1e15):
            with self.subTest(light=light):
                self.assert_light(scene(furnace(ROOM, 0.5, light), ON_EDGES), [light])

    def test_a_millimetre_block_in_a_hall_of_a_kilometre(self):
        faces = box_faces((0, 0, 0), (1000, 800, 30)) + block((500, 400, 1), (500.001, 400.001, 1.001))
        self.assert_light(scene(furnace(faces), [((500, 400, 0), (0, 0, 1)), ((1, 1, 0), (0, 0, 1))]), [1.0])

    def test_two_rooms_a_hundred_kilometres_apart(self):
        far = box_faces((1e5, 0, 0), (1e5 + 4, 3, 2.5))
        probes = [((2, 1.5, 0), (0, 0, 1)), ((1e5 + 2, 1.5, 0), (0, 0, 1))]
        self.assert_light(scene(furnace(ROOM + far), probes), [1.0])

    def test_repeated_and_collinear_vertices_and_a_disc_of_many(self):
        floor = [(0, 0, 0), (0, 0, 0), (1, 0, 0), (2, 0, 0), (4, 0, 0), (4, 3, 0), (4, 3, 0), (0, 3, 0), (0, 1, 0)]
        disc = [(2 + math.cos(i * math.pi / 200), 1.5 + math.sin(i * math.pi / 200), 1.0) for i in range(400)]
        surfaces = furnace([floor] + ROOM[1:]) + furnace([disc], two_sided=True)
        self.assert_light(scene(surfaces, ON_EDGES), [1.0])

    def test_a_panel_that_stands_on_edge_against_a_wall(self):
        panel = [(0, 1.5, 1), (1, 1.5, 1), (1, 1.5, 2), (0, 1.5, 2)]
        self.assert_light(scene(furnace(ROOM) + furnace([panel], two_sided=True), ON_EDGES), [1.0])

    def test_names_of_any_script(self):
        surfaces = furnace(ROOM)
        for s, name in zip(surfaces, ["Fußboden", "天井", "стена, \"запад\"", "a\nb", "", "🛋"]):
            s["name"] = name
        self.assert_light(scene(surfaces, ON_EDGES[:2]), [1.0])


class Lamps(Solving):
    def test_a_point_light_in_a_black_room(self):
        lamp = (1.0, 1.0, 2.0)
        probes = [((1, 1, 0), (0, 0, 1)), ((3, 2, 0), (0, 0, 1)), ((0, 1, 1), (1, 0, 0))]
        run, _ = self.solve(scene([surface(face, 0.0, 0.0) for face in ROOM], probes, [(lamp, [5.0])]))
        for (p, n), answer in zip(probes, answers_of(run)):
            d = [a - b for a, b in zip(lamp, p)]
            r = math.hypot(*d)
            self.assertAlmostEqual(answer[0], 5.0 * sum(a * b for a, b in zip(d, n)) / r**3, delta=1e-4)

    def test_a_point_light_on_the_ceiling_lights_the_room(self):
        probes = [((2, 1.5, 0), (0, 0, 1)), ((4, 1.5, 1), (-1, 0, 0))]
        run, _ = self.solve(scene([surface(face, 0.0, 0.0, name="s") for face in ROOM], probes, [((2, 1.5, 2.5), [1.0])]))
        below, beside = answers_of(run)
        self.assertAlmostEqual(below[0], 1 / 2.5**2, delta=1e-4)
        self.assertAlmostEqual(beside[0], 2 / (4 + 1.5**2) ** 1.5, delta=1e-4)

    def test_a_point_light_in_a_corner_and_at_a_probe_stays_finite(self):
        for place in [(0, 0, 0), (2, 1.5, 0), (2, 1.5, 1e-12)]:
            with self.subTest(place=place):
                self.solve(scene([surface(face, 0.5, 0.0) for face in ROOM], ON_EDGES, [(place, [1.0])]))

    def test_one_polygon_alone_is_dark(self):
        run, _ = self.solve(scene([surface(ROOM[0], 0.5, 1.0, name="alone")], [((1, 1, 0), (0, 0, 1))]))
        self.assertEqual((irradiances(run), answers_of(run)), ({"alone": [0.0]}, [[0.0]]))

    def test_a_lamp_inside_a_block_lights_nothing_else(self):
        lamp = surface([(1, 1, 1), (1, 1.1, 1), (1.1, 1.1, 1), (1.1, 1, 1)], 0.0, 1e6, name="lamp")
        surfaces = [surface(face, 0.5, 0.0, name=f"room {i}") for i, face in enumerate(ROOM)]
        surfaces += [surface(face, 0.5, 0.0) for face in block((0.9, 0.9, 0.8), (1.2, 1.2, 1.2))]
        run, _ = self.solve(scene(surfaces + [lamp], ON_EDGES))
        self.assertEqual({e[0] for name, e in irradiances(run).items() if name.startswith("room")}, {0.0})
        self.assertEqual({answer[0] for answer in answers_of(run)}, {0.0})

    def test_a_lamp_that_touches_the_wall_edge_on(self):
        """Half of what a lamp of twice its size gives, whose mirror half is on the other side of the wall."""
        def light(y0):
            lamp = surface([(1, y0, 2.5), (1, 1, 2.5), (2, 1, 2.5), (2, y0, 2.5)], 0.0, 1.0, name="lamp")
            floor = surface([(0, -3, 0), (4, -3, 0), (4, 3, 0), (0, 3, 0)], 0.0, 0.0, name="floor")
            return answers_of(self.solve(scene([lamp, floor] + walls(y0), [((1.5, 0, 0), (0, 0, 1))]))[0])[0][0]

        def walls(y0):
            return [surface(ROOM[4], 0.0, 0.0, name="wall")] if y0 == 0 else []

        self.assertAlmostEqual(light(0) / light(-1), 0.5, delta=0.005)


class Refusals(Solving):
    def refused(self, text, *words):
        path = self.scratch / "bad.json"
        path.write_text(text if isinstance(text, str) else json.dumps(text))
        self.assert_refused(path, *words)

    def test_no_surfaces(self):
        self.refused(scene([]), "surfaces")

    def test_nothing_with_an_area(self):
        self.refused(scene([surface([(0, 0, 0), (1, 0, 0), (2, 0, 0)], 0.5, 1.0)]), "surfaces")

    def test_numbers_that_are_none(self):
        for number in ("1e400", "-1e400", "nan", "0x10", "1e", '"1"'):
            text = json.dumps(scene([surface(face, 0.5, 1.0) for face in ROOM])).replace("2.5", number, 1)
            with self.subTest(number=number):
                self.refused(text)

    def test_coordinates_beyond_reason(self):
        self.refused(scene([surface([[x * 1e300 for x in v] for v in face], 0.5, 1.0) for face in ROOM]), "vertices")

    def test_exitance_beyond_reason(self):
        self.refused(scene([surface(face, 0.5, 1e300) for face in ROOM]), "exitance")

    def test_a_hundred_thousand_brackets(self):
        self.refused("[" * 100000)


if __name__ == "__main__":
    Solving.enfilade = sys.argv.pop(1)
    unittest.main()
