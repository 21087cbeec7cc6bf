# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What mien says about animated heads. usage: MIEN=build/release/mien sequence_test.py"""
import json
import struct
import unittest

import program
from program import HEAD, MAP, POINTS, run


class AnimatedHeads(program.ProgramTest):
    def animated(self, name, *flags):
        path = self.out / name
        result = run("animate", HEAD, "--points", POINTS, "--take", self.take, "--map", MAP, "-o", path, *flags)
        self.assertEqual(result.returncode, 0, result.stderr)
        return path

    def refused(self, path, *words):
        """Exit status 1, and one sentence that names the file and the place."""
        result = run("inspect", path)
        self.assertEqual(result.returncode, 1, result.stderr)
        for word in (str(path), *words):
            self.assertIn(word, result.stderr)

    def test_a_glb_says_what_moves_and_how_long(self):
        take = self.report("inspect", self.take)
        joints = self.report("inspect", self.animated("joints.glb"))
        self.assertEqual(len(joints["animations"]), 1)
        animation = joints["animations"][0]
        self.assertAlmostEqual(animation["seconds"], take["seconds"], places=4)
        self.assertIn("8.4", animation["moving_nodes"])
        self.assertIn("head", animation["moving_skins"])
        self.assertNotIn("moving_morph_targets", animation)
        morphs = self.report("inspect", self.animated("morphs.glb", "--bake", "morphs"))["animations"][0]
        self.assertAlmostEqual(morphs["seconds"], take["seconds"], places=4)
        self.assertGreater(len(morphs["moving_morph_targets"]), 3)
        self.assertNotIn("moving_skins", morphs)
        self.assertNotIn("animations", self.report("inspect", HEAD))

    def test_caches_and_folders_say_how_many_rows_they_hold(self):
        vertices = self.report("inspect", HEAD)["vertices"]
        for name in ("a.mdd", "a.pc2", "frames"):
            report = self.report("inspect", self.animated(name))
            self.assertEqual((report["rows"], report["vertices"]), (self.rows, vertices), name)
        take = self.report("inspect", self.take)
        self.assertAlmostEqual(self.report("inspect", self.out / "a.mdd")["seconds"], take["seconds"], places=3)

    def test_a_cache_that_is_cut_or_lies_is_refused(self):
        whole = self.animated("a.mdd").read_bytes()
        path = self.out / "cut.mdd"
        for size in (0, 7, 8, 100, len(whole) - 1):
            path.write_bytes(whole[:size])
            self.refused(path, f"mdd byte {size}: expected")
        path.write_bytes(struct.pack(">ii", 2**31 - 1, 2**31 - 1) + whole[8:])
        self.refused(path, "expected the end after 2147483647 rows of 2147483647 vertices")
        path.write_bytes(whole[:-4] + struct.pack(">f", float("nan")))
        self.refused(path, f"mdd byte {len(whole) - 4}: expected a finite number")
        other = self.out / "other.pc2"
        other.write_bytes(whole)
        self.refused(other, "pc2 byte 0")

    def test_a_folder_of_other_faces_is_refused_with_the_frame(self):
        folder = self.out / "frames"
        folder.mkdir()
        for number, last in ((1, 3), (2, 3), (10, 4)):
            text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n" + f"f 1 2 {last}\n"
            (folder / f"frame_{number}.obj").write_text(text, encoding="utf-8")
        self.refused(folder, str(folder / "frame_10.obj"), "expected face 0")

    def test_an_fbx_file_is_read_or_said_to_need_assimp(self):
        path = self.out / "bad.fbx"
        path.write_text("Objects: {\n", encoding="utf-8")
        self.refused(path, "Assimp")
        result = run("inspect", path, "--json")
        self.assertTrue(result.stdout == "" or json.loads(result.stdout))


if __name__ == "__main__":
    unittest.main()
