# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Rigs that learn from example shapes, from the command line. usage: MIEN=build/release/mien examples_test.py"""
import json
import struct
import unittest

import program
from program import HEAD, MAP, POINTS, SAMPLES, TAKE, run

MAN, MAN_POINTS = SAMPLES / "man.glb", SAMPLES / "man.points.json"


def glb_json(path):
    data = path.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


class Examples(program.ProgramTest):
    rows = 12

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shapes = cls.work / "shapes.glb"
        done = run("animate", HEAD, "--points", POINTS, "--take", cls.take, "--map", MAP, "--bake", "morphs", "--morphs",
                   "6", "-o", cls.shapes)
        assert done.returncode == 0, done.stderr

    def rig(self, head, points, *flags):
        file = self.out / "rig.glb"
        return file, self.report("rig", head, "--points", points, "-o", file, *flags)

    def test_shapes_of_the_head_itself_are_taken_as_its_own(self):
        file, report = self.rig(HEAD, POINTS, "--examples", self.shapes)
        self.assertEqual(report["rig"]["method"], "prior")
        self.assertEqual(report["examples"][0]["of"], "this head")
        self.assertEqual(report["prior"]["solve"], "shapes are only added")
        extension = glb_json(file)["extensions"]["MIEN_rig"]
        self.assertEqual(len(extension["prior"]["shapes"]), report["prior"]["shapes"])

    def test_a_linear_prior_has_no_stiffness(self):
        file, report = self.rig(HEAD, POINTS, "--examples", self.shapes, "--linear-prior")
        self.assertEqual(report["prior"]["solve"], "linear")
        self.assertEqual(glb_json(file)["extensions"]["MIEN_rig"]["prior"]["stiffness"], {"count": 0})

    def test_shapes_of_another_head_are_carried_over_through_its_points(self):
        _, report = self.rig(MAN, MAN_POINTS, "--examples", self.shapes, "--examples-points", POINTS)
        self.assertEqual(report["prior"]["solve"], "linear")
        result = run("rig", MAN, "--points", MAN_POINTS, "--examples", self.shapes, "-o", self.out / "other.glb")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--examples-points", result.stderr)

    def test_an_animated_head_plays_its_shapes_over_time(self):
        file = self.out / "a.glb"
        self.report("animate", HEAD, "--points", POINTS, "--take", self.take, "--map", MAP, "--examples", self.shapes, "-o",
                  file)
        root = glb_json(file)
        paths = {channel["target"]["path"] for channel in root["animations"][0]["channels"]}
        self.assertLessEqual({"translation", "weights"}, paths)
        self.assertTrue(any("targets" in primitive for mesh in root["meshes"] for primitive in mesh["primitives"]))

    def test_a_rig_file_with_shapes_is_retargeted_to_and_deforms(self):
        file, _ = self.rig(HEAD, POINTS, "--examples", self.shapes)
        onto = self.out / "onto.csv"
        self.report("retarget", self.take, "--map", MAP, "--rig", file, "-o", onto)
        self.report("deform", file, onto, "-o", self.out / "d.mdd")
        frames, points = struct.unpack_from(">II", (self.out / "d.mdd").read_bytes())
        self.assertEqual((frames, points), (12, json.loads(run("inspect", HEAD, "--json").stdout)["vertices"]))

    def test_a_file_without_shapes_and_flags_that_contradict_are_refused(self):
        output = self.out / "r.glb"
        result = run("rig", HEAD, "--points", POINTS, "--examples", MAN, "--examples-points", MAN_POINTS, "-o", output)
        self.assertEqual(result.returncode, 1)
        self.assertIn("expected shapes to learn from", result.stderr)
        for flags in (["--linear-prior"], ["--examples-points", POINTS],
                      ["--examples", self.shapes, "--method", "biharmonic"]):
            self.assertEqual(run("rig", HEAD, "--points", POINTS, *flags, "-o", output).returncode, 2, flags)
        result = run("rig", HEAD, "--points", POINTS, "--examples", self.shapes, "-o", self.shapes, "-f")
        self.assertEqual(result.returncode, 1)
        self.assertFalse(output.exists())


if __name__ == "__main__":
    unittest.main()
