# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The four commands of mien_maya on a stand-in for Maya (stub.py). usage: MIEN=build/release/mien maya_test.py"""
import array
import json
import pathlib
import struct
import sys
import types
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("maya", "python", "tests/cli", "tests/maya")]
import program
import stub
from program import MAP, MIEN, SAMPLES, TAKE, read_mdd, run

sys.modules["maya"] = types.SimpleNamespace(cmds=types.SimpleNamespace(), mel=types.SimpleNamespace())
import mien_maya

EYE_DISTANCE = 0.062  # of the sample head, in metres
OBJ, POINTS = SAMPLES / "head.obj", SAMPLES / "head-obj.points.json"


def read_obj(path):
    """(name, its vertices x, y, z one after another, its faces by vertices of its own) of each group."""
    groups, first = [], 1
    for line in path.read_text(encoding="utf-8").splitlines():
        word, *values = line.split() or [""]
        if word in ("g", "o"):
            first += len(groups[-1][1]) // 3 if groups else 0
            groups.append((values[0], [], []))
        elif word == "v":
            groups[-1][1].extend(map(float, values[:3]))
        elif word == "f":
            groups[-1][2].append([int(corner.split("/")[0]) - first for corner in values])
    return groups


def blocks(data):
    """(tag, data) of the blocks of an IFF."""
    at = 0
    while at < len(data):
        size = struct.unpack(">i", data[at + 4:at + 8])[0]
        yield data[at:at + 4], data[at + 8:at + 8 + size]
        at += 8 + size + -size % 4


def read_cache(path):
    """(channel, {time in ticks: positions}) of a geometry cache."""
    head, *rows = blocks(path.with_suffix(".mcc").read_bytes())
    assert head[0] == b"FOR4" and head[1][:4] == b"CACH"
    found, name = {}, None
    for tag, data in rows:
        assert tag == b"FOR4" and data[:4] == b"MYCH"
        parts = dict(blocks(data[4:]))
        values = array.array("f", parts[b"FVCA"])
        values.byteswap()
        assert struct.unpack(">i", parts[b"SIZE"])[0] == len(values) // 3
        name = parts[b"CHNM"].rstrip(b"\0").decode()
        found[struct.unpack(">i", parts[b"TIME"])[0]] = values
    return name, found


def in_mesh_space(values):
    """The shapes of the stub are turned by a quarter about y."""
    coordinates = iter(values)
    return [value for x, y, z in zip(coordinates, coordinates, coordinates) for value in (-z, y, x)]


def largest_difference(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


class InMaya(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.groups = read_obj(OBJ)
        lines = TAKE.read_text(encoding="utf-8").splitlines()
        first = next(i for i, line in enumerate(lines) if i > 2 and line.split("\t")[0].strip().isdigit())
        cls.take.write_text("\n".join(lines[:first] + lines[first + 96:first + 116]) + "\n", encoding="utf-8")

    def setUp(self):
        super().setUp()
        self.scene = stub.Scene(self.out, str(MIEN))
        for name, values, faces in self.groups:
            self.scene.shapes[f"|{name}|{name}Shape"] = stub.Shape(name, in_mesh_space(values), faces)
        self.scene.selection = list(self.scene.shapes)
        mien_maya.cmds = self.scene
        mien_maya.mel = self.scene

    def tearDown(self):
        self.assertEqual(self.scene.windows, 0, "a progress window stays open")

    def refused(self, command, sentence):
        before = sorted(self.out.rglob("*"))
        with self.assertRaisesRegex(RuntimeError, sentence):
            command()
        self.assertEqual(sorted(self.out.rglob("*")), before)
        self.assertEqual(self.scene.caches, {})

    def assert_plays(self, exact, folder):
        """The caches that the shapes play are this performance, in their own space and from the first frame on."""
        times, rows = exact
        first = 0
        self.assertEqual(len(self.scene.caches), len(self.groups))
        for cache, (name, values, _faces) in zip(self.scene.caches.values(), self.groups):
            self.assertEqual(cache, {"attachFile": True, "fileName": name, "directory": str(folder), "channelName": name,
                                     "inAttr": f"switch_{name}.inp[0]"})
            self.assertTrue(self.scene.play["switch_" + name])
            channel, found = read_cache(folder / name)
            self.assertEqual(channel, name)
            ticks = [round(6000 * (1 / 24 + time - times[0])) for time in times]
            self.assertEqual(list(found), ticks)
            described = xml.etree.ElementTree.parse(folder / f"{name}.xml").getroot()
            self.assertEqual(described.find("Channels/channel0").get("ChannelName"), name)
            self.assertEqual(described.find("time").get("Range"), f"{ticks[0]}-{ticks[-1]}")
            for row in (0, len(rows) // 2, len(rows) - 1):
                there = rows[row][3 * first:3 * first + len(values)]
                self.assertLess(largest_difference(found[ticks[row]], in_mesh_space(there)), 5e-6, f"{name}, row {row}")
            first += len(values) // 3

    def test_a_rigged_head_performs_a_take_as_the_program_has_it(self):
        rig, onto, cache = self.out / "rig.glb", self.out / "onto.csv", self.out / "exact.mdd"
        self.report("rig", OBJ, "--points", POINTS, "-o", rig)
        self.report("retarget", self.take, "--rig", rig, "--map", MAP, "-o", onto)
        self.report("deform", rig, onto, "-o", cache)
        self.assertRegex(mien_maya.rig(str(POINTS)), "head: rigged by [0-9]+ feature points")
        self.assertRegex(mien_maya.retarget(str(self.take), str(MAP)), "head: performs short.trc")
        self.assert_plays(read_mdd(cache), self.out / "mien" / "head" / "short")
        mien_maya.retarget(str(self.take), str(MAP))
        self.assertEqual(len(self.scene.caches), len(self.groups), "performances pile up")

    def test_a_rigged_head_plays_faps_as_the_program_has_it(self):
        faps, rig, cache = self.out / "take.fap", self.out / "rig.glb", self.out / "exact.mdd"
        self.report("faps", self.take, "--points", MAP, "--rate", "24", "-o", faps)
        self.report("rig", OBJ, "--points", POINTS, "-o", rig)
        self.report("play", rig, faps, "-o", cache)
        mien_maya.rig(str(POINTS))
        self.assertRegex(mien_maya.import_fap(str(faps)), "head: plays take.fap by its rig")
        self.assert_plays(read_mdd(cache), self.out / "mien" / "head" / "take")

    def test_an_animated_head_replays_what_was_extracted_within_the_error_that_is_told(self):
        onto, cache = self.out / "onto.csv", self.out / "exact.mdd"
        mien_maya.rig(str(POINTS))
        rig = self.out / "mien" / "head" / "rig.glb"
        self.report("retarget", self.take, "--rig", rig, "--map", MAP, "-o", onto)
        self.report("deform", rig, onto, "-o", cache)
        first = 0
        for shape in self.scene.shapes.values():
            count = len(shape.positions)
            shape.rows = [in_mesh_space(row[first:first + count]) for row in read_mdd(cache)[1]]
            first += count
        self.scene.range, self.scene.rate = (1.0, 20.0), "ntscf"
        self.assertRegex(mien_maya.extract(str(POINTS)), "head: extracted; the replay is .* % of the eye distance away")
        folder = self.out / "mien" / "head"
        allowed = json.loads((folder / "mpeg4" / "report.json").read_text(encoding="utf-8"))["replay"]["max"]
        for shape in self.scene.shapes.values():
            _channel, found = read_cache(folder / "replay" / shape.transform)
            self.assertEqual(len(found), 20)
            for row, values in enumerate(found.values()):
                self.assertLess(largest_difference(values, shape.rows[row]), allowed * EYE_DISTANCE + 1e-5)
        self.assertEqual(len(self.scene.replays), len(self.groups))

    def test_sets_of_one_vertex_are_feature_points(self):
        points = json.loads(POINTS.read_text(encoding="utf-8"))["points"]
        mien_maya.rig(str(POINTS))
        by_file = (self.out / "mien" / "head" / "rig.glb").read_bytes()
        starts = [sum(len(values) // 3 for _name, values, _faces in self.groups[:n]) for n in range(len(self.groups))]
        for name, vertex in points.items():
            group = max(n for n, start in enumerate(starts) if start <= vertex)
            member = f"{self.groups[group][0]}.vtx[{vertex - starts[group]}]"
            self.scene.members["point_" + name.replace(".", "_")] = [member]
        mien_maya.rig()
        self.assertEqual((self.out / "mien" / "head" / "rig.glb").read_bytes(), by_file)
        self.scene.members["point_8_4"].append("head.vtx[7]")
        self.refused(mien_maya.rig, "expected one vertex in the set point_8_4, found 2")

    def test_what_is_wrong_is_told_and_leaves_nothing_behind(self):
        self.refused(mien_maya.rig, "no feature points: give a points file, or make sets")
        self.refused(lambda: mien_maya.retarget(str(self.take)), "Select a head that has a rig")
        broken = self.out / "broken.json"
        broken.write_text('{"8.4": 99999}', encoding="utf-8")
        self.refused(lambda: mien_maya.rig(str(broken)), "broken.json: points /8.4: expected a vertex index")
        self.scene.options["mienProgram"] = "/nowhere/mien"
        self.refused(lambda: mien_maya.rig(str(POINTS)), "There is no program at /nowhere/mien")
        self.scene.up = "z"
        self.refused(lambda: mien_maya.rig(str(POINTS)), "Set the world's up axis to y")
        self.scene.up, self.scene.selection = "y", []
        self.scene.options["mienProgram"] = str(MIEN)
        self.refused(lambda: mien_maya.rig(str(POINTS)), "Select the meshes of one head")

    def test_escape_stops_a_command(self):
        mien_maya.rig(str(POINTS))
        self.scene.cancels_after = self.scene.steps + 3
        before = sorted(self.out.rglob("*"))
        self.assertEqual(mien_maya.retarget(str(self.take), str(MAP)), "Stopped; nothing was kept.")
        self.assertEqual(sorted(self.out.rglob("*")), before)


if __name__ == "__main__":
    unittest.main()
