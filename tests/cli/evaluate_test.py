# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""mien evaluate: what it says, its picture, and its gate.

usage: MIEN=build/release/mien evaluate_test.py
"""
import json
import pathlib
import tempfile
import unittest

from program import HEAD, MAP, POINTS, TAKE, run, some_rows


class Evaluate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = pathlib.Path(cls.folder.name)
        take = cls.work / "take.trc"
        take.write_text(some_rows(TAKE, 12), encoding="utf-8")
        cls.head = cls.work / "with-shapes.glb"
        made = run("animate", HEAD, "--points", POINTS, "--take", take, "--map", MAP, "--bake", "morphs", "--morphs", "3",
                   "-o", cls.head)
        assert made.returncode == 0, made.stderr

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def evaluate(self, *flags):
        return run("evaluate", self.head, "--points", POINTS, *flags)

    def test_a_table_for_people_has_a_line_per_shape(self):
        result = self.evaluate()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("with-shapes.glb: 3 shapes", result.stdout)
        self.assertEqual(sum(line.startswith("morph") for line in result.stdout.splitlines()), 3)

    def test_json_has_every_method_shape_and_region(self):
        result = self.evaluate("--json", "--method", "biharmonic", "--method", "surface-distance:paper")
        self.assertEqual(result.returncode, 0, result.stderr)
        methods = json.loads(result.stdout)["methods"]
        self.assertEqual([m["method"] for m in methods], ["biharmonic", "surface-distance:paper"])
        self.assertLess(methods[0]["error"], methods[1]["error"])
        for method in methods:
            self.assertEqual(len(method["shapes"]), 3)
            self.assertIn("mouth", [region["region"] for region in method["shapes"][0]["regions"]])

    def test_an_error_above_what_is_allowed_is_told_and_exits_with_4(self):
        result = self.evaluate("--max-error", "0.0001")
        self.assertEqual(result.returncode, 4)
        self.assertIn("--max-error allows 0.000", result.stderr)
        self.assertIn("biharmonic", result.stdout)

    def test_an_error_that_is_allowed_exits_with_0(self):
        self.assertEqual(self.evaluate("--max-error", "0.9").returncode, 0)

    def test_a_head_without_shapes_is_refused(self):
        result = run("evaluate", HEAD, "--points", POINTS)
        self.assertEqual(result.returncode, 1)
        self.assertIn("expected a head with shapes", result.stderr)

    def test_an_unknown_shape_is_refused_with_the_names_there_are(self):
        result = self.evaluate("--shapes", "smirk")
        self.assertEqual(result.returncode, 1)
        self.assertIn("found smirk", result.stderr)

    def test_an_unknown_method_is_bad_usage(self):
        self.assertEqual(self.evaluate("--method", "wishes").returncode, 2)

    def test_the_picture_is_drawn_and_named(self):
        picture = self.work / "shapes.png"
        result = self.evaluate("--picture", picture, "--size", "48x56", "--quality", "draft", "--software")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_a_picture_that_is_there_is_not_overwritten(self):
        picture = self.work / "there.png"
        picture.write_bytes(b"mine")
        self.assertEqual(self.evaluate("--picture", picture).returncode, 3)
        self.assertEqual(picture.read_bytes(), b"mine")


if __name__ == "__main__":
    unittest.main()
