# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What extraction of MPEG-4 from an animated head promises. usage: MIEN=build/release/mien extract_test.py"""
import csv
import json
import unittest

import program
from program import HEAD, MAP, POINTS, run

FILES = {"face.fat", "face.json", "face.fap", "face.fba", "points.json", "head.csv"}


class Extraction(program.ProgramTest):
    rows = 24

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.animated = cls.work / "animated.glb"
        result = run("animate", HEAD, "--points", POINTS, "--take", cls.take, "--map", MAP, "-o", cls.animated)
        assert result.returncode == 0, result.stderr

    def extract(self, *arguments):
        return self.report("extract", self.animated, "--points", POINTS, "-o", self.out / "made", *arguments)

    def test_a_performing_head_becomes_a_folder_that_plays_it_again(self):
        report = self.extract("--fps", 30)
        made = self.out / "made"
        self.assertEqual({path.name for path in made.iterdir()}, FILES)
        self.assertLess(report["replay"]["mean"], 0.005)
        self.assertLess(report["replay"]["error"], 0.25)
        self.assertEqual(len(report["replay"]["rows"]), report["animation"]["rows"])
        self.assertGreater(len(report["parameters"]), 10)
        for parameter in report["parameters"]:
            self.assertTrue(0 <= parameter["confidence"] <= 1)
        with open(made / "head.csv", encoding="utf-8", newline="") as file:
            track = list(csv.DictReader(file))
        self.assertEqual(len(track), report["animation"]["rows"])
        self.assertEqual(list(track[0]), ["time", "x", "y", "z"])
        points = json.loads((made / "points.json").read_text(encoding="utf-8"))
        self.assertEqual(len(points["points"]), report["points"]["count"])

    def test_sizes_are_those_of_the_files(self):
        report = self.extract()
        made = self.out / "made"
        sizes = report["sizes"]
        self.assertEqual(sizes["model"] + sizes["table"], (made / "face.fat").stat().st_size)
        self.assertEqual(sizes["stream"], (made / "face.fba").stat().st_size)
        ours = sizes["model"] + sizes["table"] + sizes["stream"]
        self.assertAlmostEqual(sizes["ratio_to_mdd"], sizes["baked_mdd"] / ours)

    def test_the_same_input_gives_the_same_bytes(self):
        self.extract()
        self.report("extract", self.animated, "--points", POINTS, "-o", self.out / "again", "--threads", 1)
        for name in FILES:
            self.assertEqual((self.out / "made" / name).read_bytes(), (self.out / "again" / name).read_bytes(), name)

    def test_a_folder_with_other_files_is_left_alone(self):
        made = self.out / "made"
        made.mkdir()
        (made / "letter.txt").write_text("dear", encoding="utf-8")
        result = run("extract", self.animated, "--points", POINTS, "-o", made, "-f")
        self.assertEqual(result.returncode, 3)
        self.assertIn("the folder holds other files than face.fat", result.stderr)
        self.assertEqual([path.name for path in made.iterdir()], ["letter.txt"])

    def test_a_broken_points_file_leaves_nothing_behind(self):
        broken = self.work / "broken.json"
        broken.write_text('{"2.1": 99999999}', encoding="utf-8")
        result = run("extract", self.animated, "--points", broken, "-o", self.out / "made")
        self.assertEqual(result.returncode, 1)
        self.assertIn("broken.json", result.stderr)
        self.assertEqual(list(self.out.iterdir()), [])

    def test_a_head_that_does_not_move_is_refused(self):
        result = run("extract", HEAD, "--points", POINTS, "-o", self.out / "made")
        self.assertEqual(result.returncode, 1)
        self.assertIn(HEAD.name, result.stderr)
        self.assertEqual(list(self.out.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
