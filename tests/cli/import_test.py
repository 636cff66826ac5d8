#!/usr/bin/python3
"""What import tells of a model, and what it does not let a model do.

import_test.py ENFILADE [unittest arguments]"""
import json
import os
import stat
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

import cli_test
from cli_test import ROOT, InScratch, enfilade, said

GLTF = ROOT / "tests/data/scene/lamp.gltf"
IFC = ROOT / "scenes/house.ifc"
HAS_NODE = subprocess.run(["sh", "-c", "node --version"], capture_output=True).returncode == 0
ROOM_OBJ = """mtllib room.mtl
v 0 0 0\nv 4 0 0\nv 4 0 -5\nv 0 0 -5\nv 0 3 0\nv 4 3 0\nv 4 3 -5\nv 0 3 -5
v 1.5 2.99 -2\nv 2.5 2.99 -2\nv 2.5 2.99 -3\nv 1.5 2.99 -3
usemtl wall\nf 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4
usemtl lamp\nf 12 11 10 9
"""
ROOM_MTL = "newmtl wall\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 100 100 100\n"


class InModel(InScratch):
    def write(self, name, text):
        path = self.scratch / name
        path.write_text(text if isinstance(text, str) else json.dumps(text))
        return path

    def gltf(self, change, name="model.gltf"):
        document = json.loads(GLTF.read_text())
        change(document)
        return self.write(name, document)

    def imported(self, *arguments):
        """Result, and the scene that was written (none where there is none)."""
        scene = self.scratch / "scene.json"
        result = enfilade("import", *arguments, "-o", scene, timeout=60)
        return result, json.loads(scene.read_text()) if scene.exists() else None

    def assert_import_refused(self, *arguments, words=()):
        result, scene = self.imported(*arguments)
        self.assert_refused(result, *words)
        self.assertIsNone(scene)


class Reports(InModel):
    def test_lamps_lumens_and_size_are_told_and_solve_takes_what_is_written(self):
        self.write("room.mtl", ROOM_MTL)
        result, scene = self.imported(self.write("room.obj", ROOM_OBJ))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for line in (r"extent +4 x 5 x 3 m", r"emitting surfaces +1", r"emitted +314\.2, 314\.2, 314\.2 lm"):
            self.assertRegex(result.stdout, rf"(?m)^  {line}$")
        self.assertEqual(len(scene["surfaces"]), 7)
        result = enfilade("solve", self.scratch / "scene.json", "-o", self.scratch / "run", "--no-pictures")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_darkness_is_told_by_import_and_solve(self):
        self.write("room.mtl", ROOM_MTL.replace("Ke", "Ka"))
        result, _ = self.imported(self.write("room.obj", ROOM_OBJ))
        self.assertIn("enfilade: warning: scene: has no light", result.stderr)
        result = enfilade("solve", self.scratch / "scene.json", "-o", self.scratch / "run", "--no-pictures")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(len([line for line in said(result) if "has no light" in line]), 1, result.stderr)

    def test_a_room_inside_out_is_told(self):
        turned = "\n".join(line if not line.startswith("f ") or "9" in line else
                           "f " + " ".join(reversed(line[2:].split())) for line in ROOM_OBJ.splitlines())
        self.write("room.mtl", ROOM_MTL)
        result, _ = self.imported(self.write("room.obj", turned))
        self.assertRegex(result.stderr, r"faces away from the lamps: 100 % of their light falls on black backs")

    def test_the_unit_is_guessed_by_nobody_but_asked_for(self):
        self.write("room.mtl", ROOM_MTL)
        thousands = "\n".join("v " + " ".join(str(1000 * float(x)) for x in line.split()[1:]) if line.startswith("v ")
                              else line for line in ROOM_OBJ.splitlines())
        model = self.write("room.obj", thousands)
        result, _ = self.imported(model)
        self.assertIn("4000 x 5000 x 3000 m: unlike a building", result.stderr)
        result, _ = self.imported(model, "--units", "mm")
        self.assertEqual(result.stderr, "")
        self.assertRegex(result.stdout, r"extent +4 x 5 x 3 m")
        result, _ = self.imported(model, "--units", "mm", "--up", "z", "--scale", "2")
        self.assertRegex(result.stdout, r"extent +8 x 6 x 10 m")
        result = enfilade("import", model, "-o", self.scratch / "x.json", "--units", "miles")
        self.assertEqual(result.returncode, 2)


class Limits(InModel):
    def test_what_doubles_at_every_level_is_refused(self):
        self.assert_import_refused(self.gltf(lambda d: d.update(
            nodes=[{"children": [i + 1, i + 1]} for i in range(24)] + [{"mesh": 0}])), words=["parent already"])
        for i in range(25):
            self.write(f"b{i}.rad", f"!xform -t 1 0 0 b{i + 1}.rad\n!xform b{i + 1}.rad\n")
        self.write("b25.rad", "void plastic g 0 0 5 .5 .5 .5 0 0\ng polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n")
        self.assert_import_refused(self.scratch / "b0.rad", words=["more than 100000 times"])
        array = self.write("a.rad", "void plastic g 0 0 5 .5 .5 .5 0 0\n!genbox g b 1 1 1 | xform -a 900000 -t 2 0 0\n")
        self.assert_import_refused(array, words=["more than 4000000 surfaces"])

    def test_only_regular_files_below_the_model_are_read(self):
        (self.scratch / "house").mkdir()
        self.write("secret.mtl", "newmtl secret\nKd 1 1 oops\n")
        os.mkfifo(self.scratch / "house/pipe.mtl")
        for library, words in (("../secret.mtl", ["outside", "--allow-outside"]), ("/etc/passwd", ["outside"]),
                               ("pipe.mtl", ["no regular file"])):
            with self.subTest(library):
                model = self.write("house/model.obj", f"mtllib {library}\n" + ROOM_OBJ)
                self.assert_import_refused(model, words=["model.obj: line 1: ", *words])
        model = self.write("house/model.obj", "mtllib ../secret.mtl\n" + ROOM_OBJ)
        self.assert_import_refused(model, "--allow-outside", words=["secret.mtl: line 2: \"oops\""])
        for uri in ("/etc/passwd", "../../../../etc/passwd", "/dev/zero"):
            with self.subTest(uri):
                self.assert_import_refused(self.gltf(lambda d, u=uri: d["buffers"][0].update(uri=u)), words=["outside"])
        self.assert_import_refused(self.write("dev.rad", "!xform -t 1 0 0 /dev/zero\n"), words=["outside"])
        os.mkfifo(self.scratch / "pipe.gltf")
        self.assert_import_refused(self.scratch / "pipe.gltf", words=["no regular file"])

    def test_names_are_kept_and_do_not_reach_the_terminal_raw(self):
        name = "<script>\x1b[31m\n=1+1"

        def rename(document):
            for key in ("nodes", "meshes", "materials"):
                for entry in document[key]:
                    entry["name"] = name
        result, scene = self.imported(self.gltf(rename))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(scene["surfaces"][0]["object"], name)
        self.assertNotIn("\x1b", result.stdout + result.stderr)


class Ifc(InModel):
    def node(self, script):
        """A folder for PATH with another program in place of Node.js."""
        program = self.scratch / "bin/node"
        program.parent.mkdir(exist_ok=True)
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        return mock.patch.dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}")

    def test_a_crash_of_the_reader_is_one_line(self):
        for script, word in (("kill -SEGV $$", "crashed its reader (Segmentation fault)"), ("exit 3", "exit status 3"),
                             ("echo 'JavaScript heap out of memory' >&2; kill -ABRT $$", "needs more memory"),
                             ("echo '{'", "within its answer"), ("echo '{\"fault\": \"no web-ifc\"}'", "needs web-ifc")):
            with self.subTest(script), self.node(script):
                self.assert_import_refused(IFC, words=[word])

    def test_without_node_the_remedy_is_named(self):
        with mock.patch.dict(os.environ, PATH=str(self.scratch)):
            self.assert_import_refused(IFC, words=["needs Node.js", "apt-get install nodejs npm"])

    @unittest.skipUnless(HAS_NODE, "needs Node.js")
    def test_a_house_arrives(self):
        result, scene = self.imported(IFC)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("has no light", result.stderr)
        self.assertRegex(result.stdout, r"portals +3")
        self.assertEqual({p["kind"] for p in scene["portals"]}, {"IfcOpeningElement"})


if __name__ == "__main__":
    cli_test.ENFILADE = cli_test.ENFILADE or sys.argv.pop(1)
    unittest.main()
