# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""mien shapes: the file it writes, what it says about it, its sheet, and an artist's shapes.

usage: MIEN=build/release/mien shapes_test.py
"""
import csv
import json
import pathlib
import struct
import tempfile
import unittest

from program import HEAD, POINTS, SHARED, run


def document(glb):
    """The JSON of a binary glTF file."""
    data = glb.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def names_in(glb):
    """The target names of each mesh that has some, by the mesh's name."""
    return {mesh.get("name", str(i)): mesh["extras"]["targetNames"]
            for i, mesh in enumerate(document(glb)["meshes"]) if "targetNames" in mesh.get("extras", {})}


def column(table, name):
    with open(SHARED / "names" / table, newline="", encoding="utf-8") as rows:
        return [row[name] for row in csv.DictReader(rows) if row[name]]


class Shapes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = pathlib.Path(cls.folder.name)
        cls.head = cls.work / "shapes.glb"
        made = run("shapes", HEAD, "--points", POINTS, "-o", cls.head, "--json")
        assert made.returncode == 0, made.stderr
        cls.report = json.loads(made.stdout)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_head_has_every_shape_by_name(self):
        names = max(names_in(self.head).values(), key=len)
        self.assertEqual(len(names), 85)
        if SHARED.is_dir():
            wanted = column("arkit52.csv", "name") + column("oculus_visemes.csv", "rpm_morph_name")
            self.assertEqual(names[:len(wanted)], wanted)
            self.assertEqual(set(names[len(wanted):]), set(column("vrm_expressions.csv", "vrm1_preset")))

    def test_shapes_are_sparse_and_at_rest(self):
        file = document(self.head)
        for mesh in file["meshes"]:
            self.assertFalse(any(mesh.get("weights", [])))
        skin = max(file["meshes"], key=lambda mesh: len(mesh["extras"].get("targetNames", [])) if "extras" in mesh else 0)
        targets = [file["accessors"][t["POSITION"]] for t in skin["primitives"][0]["targets"]]
        self.assertGreater(sum("sparse" in target for target in targets), 60)
        self.assertNotIn("animations", file)

    def test_the_report_says_what_must_be_true(self):
        shapes = self.report["shapes"]
        self.assertLess(shapes["blink_left_open"]["widest"], 0.05)
        self.assertLess(shapes["blink_right_open"]["widest"], 0.05)
        self.assertLess(shapes["upper_lip_in_jaw_open"], 0.03)
        self.assertLess(shapes["jaw_open_with_mouth_close_open"]["widest"], 0.02)
        self.assertLess(shapes["flipped_faces"], 0.003)
        self.assertTrue(shapes["head_is_symmetric"])

    def test_the_same_bytes_for_any_number_of_threads(self):
        again = self.work / "one-thread.glb"
        self.assertEqual(run("shapes", HEAD, "--points", POINTS, "-o", again, "--threads", "1").returncode, 0)
        self.assertEqual(again.read_bytes(), self.head.read_bytes())

    def test_one_set_alone(self):
        visemes = self.work / "visemes.glb"
        self.assertEqual(run("shapes", HEAD, "--points", POINTS, "-o", visemes, "--sets", "visemes").returncode, 0)
        self.assertEqual(len(max(names_in(visemes).values(), key=len)), 15)

    def test_an_artists_shapes_are_kept(self):
        artist, all_of_them = self.work / "artist.glb", self.work / "all.glb"
        self.assertEqual(run("shapes", HEAD, "--points", POINTS, "-o", artist, "--sets", "arkit", "--gain",
                             "mouthSmileLeft=1.5").returncode, 0)
        result = run("shapes", HEAD, "--points", POINTS, "--examples", artist, "-o", all_of_them, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("mouthSmileLeft", json.loads(result.stdout)["shapes"]["kept_from_the_artist"])
        judged = run("evaluate", artist, "--points", POINTS, "--json")
        self.assertEqual(judged.returncode, 0, judged.stderr)

    def test_examples_of_another_head_are_refused(self):
        result = run("shapes", HEAD.parent / "cartoon.glb", "--points", HEAD.parent / "cartoon.points.json",
                     "--examples", self.head, "-o", self.work / "wrong.glb")
        self.assertEqual(result.returncode, 1)
        self.assertIn("shapes are of another head", result.stderr)

    def test_a_gain_of_no_shape_is_refused(self):
        for gain, word in (("smirk=2", "smirk"), ("jawOpen", "SHAPE=NUMBER"), ("jawOpen=x", "SHAPE=NUMBER")):
            result = run("shapes", HEAD, "--points", POINTS, "-o", self.work / "gain.glb", "--gain", gain)
            self.assertEqual(result.returncode, 1)
            self.assertIn(word, result.stderr)

    def test_the_sheet_is_drawn(self):
        sheet = self.work / "sheet.png"
        result = run("shapes", HEAD, "--points", POINTS, "-o", self.head, "-f", "--sheet", sheet, "--show",
                     "jawOpen,eyeBlinkLeft", "--size", "48x56", "--quality", "draft", "--software")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sheet.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    unittest.main()
