#!/usr/bin/python3
"""Known ways in which hierarchical radiosity fails, each as a scene that says itself what is expected of it.

failure_test.py ENFILADE [unittest arguments]"""
import json
import sys
import unittest

from solving import SCENES, Solving, answers_of, irradiances, stats_of

EXPECTATIONS = {"E", "abs_tol", "avg", "finite", "flux", "note", "reject", "rowsum_max", "same_as", "same_room_without",
                "tol", "warn", "warn_or_reject", "zero"}
DEFAULT_TOLERANCE = 0.02  # the default --target-error
MOST_FLUX = 1e-3  # neither absorbed nor leaving, of the emitted light


class Scenes(Solving):
    def test_every_scene_does_what_it_expects(self):
        driven = 0
        for path in sorted(SCENES.rglob("*.json")):
            scene = json.loads(path.read_text())
            if "expect" not in scene:
                continue
            driven += 1
            with self.subTest(path.stem, mode=scene["failure_mode"]):
                self.judge(path, scene, scene["expect"])
        self.assertEqual(driven, 31)

    def judge(self, path, scene, expect):
        self.assertLessEqual(set(expect), EXPECTATIONS, "nobody looks at it")
        if "reject" in expect:
            names = expect["reject"] if isinstance(expect["reject"], list) else ["surfaces["]
            return self.assert_refused(path, *names)
        run, result = self.solve(path)
        stats = stats_of(run)
        self.assertTrue(stats["converged"] or "not converged" in result.stderr, "not converged, and does not say so")
        if "warn" in expect or "warn_or_reject" in expect:
            warnings = [line for line in result.stderr.splitlines()
                        if line.startswith("enfilade: warning: ") and "unknown keys" not in line]
            self.assertTrue(warnings, result.stderr)
        if "flux" in expect:
            self.assertLessEqual(stats["flux_balance"], min(expect["tol"], MOST_FLUX))
        self.judge_surfaces(expect, irradiances(run))
        if scene.get("probes"):
            self.judge_probes(expect, scene["probes"], answers_of(run))

    def judge_surfaces(self, expect, surfaces):
        for name in expect.get("zero", []):
            self.assertEqual(set(surfaces[name]), {0.0}, name)
        for name, mean in expect.get("avg", {}).items():
            for got in surfaces[name]:
                self.assertAlmostEqual(got / mean, 1.0, delta=expect.get("tol", DEFAULT_TOLERANCE) / 4, msg=name)

    def judge_probes(self, expect, want, answers):
        tolerance = expect.get("tol", DEFAULT_TOLERANCE)
        top = max(max(probe["E"]) for probe in want)
        for probe, answer in zip(want, answers):
            for got, exact in zip(answer, probe["E"]):
                where = (probe["p"], got, exact)
                if exact == 0.0:  # nothing comes through a wall; an umbra may have what the target error leaves
                    self.assertLessEqual(got, expect.get("abs_tol", 1e-3 * tolerance * top), where)
                else:
                    self.assertLessEqual(abs(got - exact), tolerance * exact + probe.get("err", 0.0), where)


class SameLight(Solving):
    """What must not change the answer."""

    def assert_same(self, got, want, tolerance):
        self.assertEqual(set(got), set(want))
        for name, irradiance in want.items():
            for a, b in zip(got[name], irradiance):
                self.assertAlmostEqual(a, b, delta=tolerance * b, msg=name)

    def test_a_lamp_in_the_plane_of_its_ceiling_lights_the_floor_as_one_in_a_hole(self):
        flush = irradiances(self.solve(SCENES / "lamp_on_ceiling_plane.json")[0])
        cut_in = irradiances(self.solve(SCENES / "energy_balance.json")[0])
        self.assertAlmostEqual(flush["floor"][0] / cut_in["floor"][0], 1.0, delta=0.03)

    def test_any_order_and_any_number_of_ranks(self):
        scene = SCENES / "order_dependence.json"
        run, _ = self.solve(scene, ranks=1)
        want = irradiances(run)
        for options, ranks in [(["--order", "input"], 1), (["--assignment", "round-robin"], 2), (["--no-steal"], 3)]:
            with self.subTest(options=options, ranks=ranks):
                self.assert_same(irradiances(self.solve(scene, *options, ranks=ranks)[0]), want, 1e-4)
        scene_on_fewer = SCENES / "shared_edge.json"  # 2 surfaces: some ranks have nothing to do
        alone = irradiances(self.solve(scene_on_fewer)[0])
        self.assert_same(irradiances(self.solve(scene_on_fewer, ranks=5)[0]), alone, 1e-4)

    def test_the_same_run_gives_the_same_bytes(self):
        runs = [self.solve(SCENES / "order_dependence.json", ranks=1)[0] for _ in range(2)]
        for name in ("surfaces.csv", "solution.glb"):
            self.assertEqual(*[(run / name).read_bytes() for run in runs])

    def test_eight_bands_share_the_links_and_rays_of_one(self):
        one = json.loads((SCENES / "energy_balance.json").read_text())
        for surface in one["surfaces"]:
            surface["reflectance"], surface["exitance"] = surface["reflectance"][:1], surface["exitance"][:1]
        eight = json.loads(json.dumps(one))
        for surface in eight["surfaces"]:
            surface["reflectance"] *= 8
            surface["exitance"] = [surface["exitance"][0] * (band + 1) / 8 for band in range(8)]
        runs = [self.solve(scene)[0] for scene in (one, eight)]
        for count in ("links", "rays", "form_factors", "kernels", "patches"):
            self.assertEqual(*[stats_of(run)[count] for run in runs], count)
        light, lights = map(irradiances, runs)
        for name, (irradiance,) in light.items():
            for band, got in enumerate(lights[name]):
                self.assertAlmostEqual(got, irradiance * (band + 1) / 8, delta=1e-5 * irradiance, msg=name)

    def test_bands_that_are_alike_are_solved_once_and_told_each(self):
        grey = json.loads((SCENES / "energy_balance.json").read_text())
        tinted = json.loads(json.dumps(grey))
        for i, surface in enumerate(grey["surfaces"]):
            rho, exitance = surface["reflectance"][0], surface["exitance"][0]
            surface["reflectance"], surface["exitance"] = [rho] * 3, [exitance] * 3
            tinted["surfaces"][i].update(reflectance=[rho, rho / 2, rho], exitance=[exitance] * 3)
        runs = [self.solve(scene)[0] for scene in (grey, tinted)]
        self.assertEqual([(stats_of(run)["bands"], stats_of(run)["solved_bands"]) for run in runs], [(3, 1), (3, 2)])
        for name, light in irradiances(runs[0]).items():
            self.assertEqual(len(light), 3, name)
            self.assertEqual(len(set(light)), 1, name)
        for name, (first, second, third) in irradiances(runs[1]).items():
            self.assertEqual(first, third, name)
            self.assertLessEqual(second, first, name)

    def test_a_model_keeps_the_bands_that_are_alike(self):
        (self.scratch / "m.mtl").write_text("newmtl wall\nKd 0.5 0.2 0.5\nnewmtl lamp\nKd 0.5 0.2 0.5\nKe 5 5 5\n")
        model = self.scratch / "m.obj"
        model.write_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\nv 0 1 0\nv 1 1 0\nv 1 1 -1\nv 0 1 -1\n"
                         "o floor\nusemtl wall\nf 1 2 3 4\no ceiling\nusemtl lamp\nf 5 8 7 6\n")
        run, _ = self.solve(model)
        self.assertEqual((stats_of(run)["bands"], stats_of(run)["solved_bands"]), (3, 2))
        points, answers = self.scratch / "points.json", self.scratch / "answers.json"
        points.write_text(json.dumps({"probes": [{"p": [0.5, 0.5, 0.5], "n": [0, 0, 1]}]}))
        self.assertEqual(self.run_enfilade("probe", run, "--points", points, "-o", answers).returncode, 0)
        (irradiance,) = [probe["E"] for probe in json.loads(answers.read_text())["probes"]]
        self.assertEqual(len(irradiance), 3)
        self.assertEqual(irradiance[0], irradiance[2])
        self.assertGreater(irradiance[0], irradiance[1])


if __name__ == "__main__":
    Solving.enfilade = sys.argv.pop(1)
    unittest.main()
