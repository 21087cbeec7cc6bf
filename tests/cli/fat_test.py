# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What the verbs of face animation tables promise. usage: MIEN=build/release/mien fat_test.py"""
import json
import unittest

import program
from program import HEAD, POINTS, fap_text, run


class FaceAnimationTables(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.rig = cls.work / "rig.glb"
        assert run("rig", HEAD, "--points", POINTS, "-o", cls.rig).returncode == 0
        cls.fat = cls.work / "face.fat"
        made = run("fat", cls.rig, "-o", cls.fat, "--json")
        assert made.returncode == 0, made.stderr
        cls.made = json.loads(made.stdout)
        cls.talk = cls.work / "talk.fap"
        cls.talk.write_text(fap_text([{3: 60 * i, 23: 900 * i, 24: 900 * i, 49: 2000 * i} for i in range(12)]), encoding="utf-8")

    def test_a_rig_becomes_a_table_within_what_is_said(self):
        self.assertLess(self.made["parameters_alone"]["max_error_share_of_eye_distance"], 0.03)
        self.assertIn("open_jaw", [one["name"] for one in self.made["parameters"]])
        report = self.report("inspect", self.fat)
        self.assertEqual(report["kind"], "face definition")
        self.assertEqual(len(report["parameters"]), len(self.made["parameters"]))
        self.assertGreater(report["units"]["mw"], 0)

    def test_a_table_is_the_same_after_text_and_json(self):
        self.report("fat", self.fat, "-o", self.out / "a.json")
        self.report("fat", self.out / "a.json", "-o", self.out / "b.fat")
        self.report("fat", self.out / "b.fat", "-o", self.out / "c.json")
        self.assertEqual((self.out / "a.json").read_bytes(), (self.out / "c.json").read_bytes())

    def test_points_and_units_are_files_of_their_own(self):
        self.report("fat", self.fat, "-o", self.out / "a.fdp")
        self.report("fat", self.fat, "-o", self.out / "a.fapu")
        points, units = self.report("inspect", self.out / "a.fdp"), self.report("inspect", self.out / "a.fapu")
        self.assertGreater(len(points["feature_points"]), 60)
        self.assertNotIn("feature_points", units)
        self.assertEqual(points["units"], units["units"])

    def test_a_table_plays_as_morphs_caches_and_frames(self):
        report = self.report("play", self.fat, self.talk, "-o", self.out / "a.glb")
        self.assertLess(report["morph_bake"]["max_error_share_of_height"], 1e-5)
        self.assertIn("--head-motion", report["head_turns"])
        self.assertEqual(report["parameters_not_in_the_table"], [])
        turned = self.report("play", self.fat, self.talk, "--head-motion", "-o", self.out / "turned.glb")
        self.assertNotIn("head_turns", turned)
        self.assertEqual(self.report("play", self.fat, self.talk, "-o", self.out / "a.mdd")["wrote"]["rows"], 12)
        self.report("play", self.fat, self.talk, "-o", self.out / "frames")
        self.assertEqual(len(list((self.out / "frames").iterdir())), 12)

    def test_a_table_becomes_a_head_with_a_target_per_parameter(self):
        self.report("fat", self.fat, "-o", self.out / "a.glb")
        names = self.report("inspect", self.out / "a.glb")["morph_targets"]
        self.assertIn("open_jaw", [name.removesuffix("_below") for name in names])

    def test_shapes_bend_a_table(self):
        shaped = self.work / "shaped.glb"
        self.assertEqual(run("shapes", HEAD, "--points", POINTS, "-o", shaped).returncode, 0)
        report = self.report("fat", self.rig, "--shapes", shaped, "-o", self.out / "a.fat")
        self.assertLess(report["shapes"]["mean_error"], 1)
        self.assertIn(1, [one["fap"] for one in report["parameters"]])

    def test_a_table_is_one_more_thing_to_draw(self):
        self.report("render", self.fat, "--take", self.talk, "--time", "0.4", "--quality", "draft", "--size", "120x160",
                    "-o", self.out / "a.png")
        self.assertGreater((self.out / "a.png").stat().st_size, 1000)

    def test_what_is_no_table_is_refused(self):
        broken = self.work / "broken.fat"
        broken.write_text("FDP { faceDefTables [\n FaceDefTables { fapID 99 } ] }", encoding="utf-8")
        self.refuses(1, ["broken.fat", "line 2", "found 99"], "play", broken, self.talk, "-o", self.out / "a.glb")
        empty = self.work / "empty.fat"
        empty.write_text("FDP { }", encoding="utf-8")
        self.refuses(1, ["expected a face definition with a table"], "play", empty, self.talk, "-o", self.out / "a.glb")
        self.refuses(1, ["--shapes"], "fat", self.fat, "--shapes", self.rig, "-o", self.out / "a.fat")
        self.refuses(2, [".fat"], "fat", self.rig, "-o", self.out / "a.obj")


if __name__ == "__main__":
    unittest.main()
