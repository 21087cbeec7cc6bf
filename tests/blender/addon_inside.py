# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Runs inside Blender: the tests of the add-on.

usage: blender -b --factory-startup --python-exit-code 1 -P addon_inside.py -- MIEN.zip FOLDER [NAME OF A TEST...]
"""
import json
import os
import pathlib
import struct
import sys
import unittest

import bpy
import mathutils
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import HEAD, MAP, MIEN, POINTS, TAKE, run

# Debian's NumPy 1.24 has dropped names that Blender 3.4's importer still uses.
for name, kind in (("bool", bool), ("object", object), ("float", float), ("int", int)):
    if name not in numpy.__dict__:
        setattr(numpy, name, kind)

ARCHIVE, FOLDER, *CHOSEN = sys.argv[sys.argv.index("--") + 1:]
FOLDER = pathlib.Path(FOLDER)
TEMPORARY = pathlib.Path(os.environ["TMPDIR"])
ROUNDING = 2e-5  # of the head's size: float32 there and back


def meshes():
    return [thing for thing in bpy.context.scene.objects if thing.type == "MESH" and not thing.name.startswith("Icosphere")]


def evaluated(thing, frame):
    """Where its vertices are in the world at a frame, y up: an array of rows."""
    bpy.context.scene.frame_set(int(frame // 1), subframe=frame % 1)
    found = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = found.to_mesh()
    points = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
    mesh.vertices.foreach_get("co", points)
    matrix = numpy.array(found.matrix_world)
    world = points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
    found.to_mesh_clear()
    return world[:, [0, 2, 1]] * [1, 1, -1]


def evaluated_at_rest(thing):
    """Where its own vertices are, without modifiers."""
    return numpy.array([thing.matrix_world @ vertex.co for vertex in thing.data.vertices])[:, [0, 2, 1]] * [1, 1, -1]


def size(thing):
    return max(thing.dimensions)


def read_mdd(path):
    data = path.read_bytes()
    rows, vertices = numpy.frombuffer(data, ">i4", 2)
    times = numpy.frombuffer(data, ">f4", rows, 8)
    return times, numpy.frombuffer(data, ">f4", 3 * rows * vertices, 8 + 4 * rows).reshape(rows, vertices, 3)


def write(verb, *arguments):
    result = run(verb, *arguments)
    assert result.returncode == 0, result.stderr


class AddOnTest(unittest.TestCase):
    """Each test has an empty scene, a saved .blend file in a folder of its own, and the program in the preferences."""

    def setUp(self):
        bpy.ops.wm.read_homefile(app_template="", use_empty=True)
        self.out = FOLDER / self.id().rsplit(".", 1)[-1]
        self.out.mkdir()
        bpy.ops.wm.save_as_mainfile(filepath=str(self.out / "scene.blend"))
        self.preferences = bpy.context.preferences.addons["mien"].preferences
        self.preferences.program = str(MIEN)

    def tearDown(self):
        self.assertEqual([path.name for path in TEMPORARY.glob("mien*")], [], "temporary files stay")

    def load(self, path=HEAD):
        """Imports a GLB and selects its meshes, that of the face active."""
        bpy.ops.import_scene.gltf(filepath=str(path))
        for thing in bpy.context.scene.objects:
            thing.select_set(thing in meshes())
        head = next(thing for thing in meshes() if thing.data.name == "head")
        bpy.context.view_layer.objects.active = head
        return head

    def rigged(self):
        head = self.load()
        bpy.context.scene.mien.points = str(POINTS)
        self.assertEqual(bpy.ops.mien.rig(), {"FINISHED"})
        return head

    def told(self):
        return bpy.context.window_manager.mien

    def assert_refused(self, command, sentence):
        """The command fails with the sentence, in Blender's report and in the panel, and leaves nothing behind."""
        before = self.everything()
        with self.assertRaisesRegex(RuntimeError, sentence):
            command()
        self.assertRegex(self.told().message, sentence)
        self.assertTrue(self.told().is_error)
        self.assertFalse(self.told().running)
        self.assertEqual(self.everything(), before)

    def everything(self):
        """What there is in the file and beside it."""
        data = [sorted(thing.name for thing in kind) for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.actions)]
        modifiers = [(thing.name, [(m.name, m.show_viewport) for m in thing.modifiers]) for thing in bpy.data.objects]
        return data, modifiers, bpy.context.scene.frame_current, sorted(str(p) for p in self.out.rglob("*")), \
            sorted(TEMPORARY.glob("mien*"))

    def assert_performs(self, cache, rows):
        """The meshes are where a cache made from the GLB alone has them, at these of its rows."""
        times, exact = read_mdd(cache)
        first, rate = 0, bpy.context.scene.render.fps
        start = bpy.context.scene.frame_start
        by_name = {thing.data.name: thing for thing in meshes()}
        moved = 0
        for name in (mesh["name"] for mesh in gltf(HEAD)["meshes"]):
            thing = by_name[name]
            count = len(thing.data.vertices)
            for row in rows:
                there = exact[row, first:first + count]
                here = evaluated(thing, start + float(times[row] - times[0]) * rate)
                self.assertLess(numpy.abs(here - there).max(), ROUNDING * size(thing), f"{name}, row {row}")
                moved = max(moved, numpy.abs(there - exact[0, first:first + count]).max())
            first += count
        self.assertEqual(first, exact.shape[1])
        self.assertGreater(moved, 0.005 * size(by_name["head"]), "nothing moves, which shows nothing")


def gltf(path):
    """The document of a GLB."""
    data = path.read_bytes()
    return json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])


class RigAndPerform(AddOnTest):
    def test_a_take_moves_the_head_in_blender_as_it_moves_the_file(self):
        rig, onto, cache = self.out / "rig.glb", self.out / "onto.csv", self.out / "exact.mdd"
        write("rig", HEAD, "--points", POINTS, "-o", rig)
        write("retarget", TAKE, "--rig", rig, "--map", MAP, "-o", onto)
        write("deform", rig, onto, "-o", cache)
        self.rigged()
        bpy.context.scene.mien.marker_map = str(MAP)
        self.assertEqual(bpy.ops.mien.retarget(filepath=str(TAKE)), {"FINISHED"})
        self.assertRegex(self.told().message, "performs take.trc with [0-9]+ points, to frame")
        self.assert_performs(cache, (0, 101, 240, 479))


    def test_faps_move_the_head_in_blender_as_they_move_the_file(self):
        faps, rig, cache = self.out / "take.fap", self.out / "rig.glb", self.out / "exact.mdd"
        write("faps", TAKE, "--points", MAP, "--rate", "24", "-o", faps)
        write("rig", HEAD, "--points", POINTS, "-o", rig)
        write("play", rig, faps, "-o", cache)
        self.rigged()
        self.assertEqual(bpy.ops.mien.import_fap(filepath=str(faps)), {"FINISHED"})
        self.assertIn("plays take.fap by its rig", self.told().message)
        self.assert_performs(cache, (0, 60, 150))

    def test_a_head_that_is_turned_moved_and_subdivided_performs_in_its_own_space(self):
        head = self.rigged()
        rest = {thing.name: evaluated(thing, 1) for thing in meshes()}
        for thing in meshes():
            thing.location, thing.rotation_euler[2], thing.scale = (1, 2, 3), 1.2, (2, 2, 2)
            thing.modifiers.new("Smooth", "SUBSURF").levels = 1
        bpy.context.scene.mien.marker_map = str(MAP)
        bpy.ops.mien.retarget(filepath=str(TAKE))
        for thing in meshes():
            self.assertEqual([modifier.name for modifier in thing.modifiers], ["mien", "mien points", "Smooth"])
            thing.modifiers["Smooth"].show_viewport = False
            turned = numpy.array(thing.matrix_world.to_3x3())
            still = rest[thing.name] @ [[1, 0, 0], [0, 0, 1], [0, -1, 0]] @ turned.T + [1, 2, 3]
            self.assertLess(numpy.abs(evaluated(thing, 1) - still @ [[1, 0, 0], [0, 0, -1], [0, 1, 0]]).max(), 0.05 * size(head))

    def test_one_performance_follows_another_and_nothing_piles_up(self):
        self.rigged()
        bpy.context.scene.mien.marker_map = str(MAP)
        bpy.ops.mien.retarget(filepath=str(TAKE))
        before = self.everything()
        bpy.ops.mien.rig()
        bpy.ops.mien.retarget(filepath=str(TAKE))
        self.assertEqual(self.everything(), before)
        self.assertEqual({len(thing.modifiers) for thing in meshes()}, {2})
        self.assertTrue(all(thing.modifiers["mien"].filepath.startswith("//mien/head/take/") for thing in meshes()))

    def test_vertex_groups_that_are_named_like_points_are_feature_points(self):
        head = self.load()
        points = json.loads(POINTS.read_text(encoding="utf-8"))["points"]
        by_name = {thing.data.name: thing for thing in meshes()}
        for name, point in points.items():
            by_name[point["mesh"]].vertex_groups.new(name=name).add([point["vertex"]], 1, "REPLACE")
        head.vertex_groups.new(name="no point").add([1, 2, 3], 1, "REPLACE")
        self.assertEqual(bpy.ops.mien.rig(), {"FINISHED"})
        by_groups = (self.out / "mien" / "head" / "rig.glb").read_bytes()
        bpy.context.scene.mien.points = str(POINTS)
        bpy.ops.mien.rig()
        self.assertEqual((self.out / "mien" / "head" / "rig.glb").read_bytes(), by_groups)


    def test_a_bone_moves_the_skin_as_that_of_the_rig_file_does_on_top_of_a_performance(self):
        head = self.load()
        for thing in meshes():
            thing.location = (1, 2, 3)
        bpy.context.scene.mien.points, bpy.context.scene.mien.marker_map = str(POINTS), str(MAP)
        bpy.ops.mien.rig()
        bpy.ops.mien.retarget(filepath=str(TAKE))
        before = {thing.name: evaluated(thing, 60) for thing in meshes()}
        armature = bpy.data.objects["mien points of head"]
        bone = armature.pose.bones["mien points 8.4"]
        place = armature.matrix_world @ bone.bone.head_local
        vertex = json.loads(POINTS.read_text(encoding="utf-8"))["points"]["8.4"]["vertex"]
        self.assertLess(numpy.abs(evaluated_at_rest(head)[vertex] - [place.x, place.z, -place.y]).max(), ROUNDING)

        def pose(bone):
            bone.location = bone.bone.matrix_local.to_3x3().inverted() @ mathutils.Vector((0.01, 0, 0))

        pose(bone)
        moved = evaluated(head, 60) - before["head"]
        self.assertGreater(moved[vertex, 0], 0.0099)
        own = set(bpy.data.objects)
        bpy.ops.import_scene.gltf(filepath=str(self.out / "mien" / "head" / "rig.glb"))
        judge = {thing.type: thing for thing in set(bpy.data.objects) - own if thing.type == "ARMATURE" or thing.name == "head.001"}
        still = evaluated(judge["MESH"], 60)
        pose(judge["ARMATURE"].pose.bones["8.4"])
        wanted = evaluated(judge["MESH"], 60) - still
        self.assertLess(numpy.abs(moved - wanted).max(), ROUNDING * size(head))


class Extract(AddOnTest):
    """A head that a skin animates, its own motion too, on an object that turns and moves."""

    @classmethod
    def setUpClass(cls):
        cls.animated, cls.still = FOLDER / "animated.glb", FOLDER / "still.glb"
        animate = ("animate", HEAD, "--points", POINTS, "--take", TAKE, "--map", MAP)
        write(*animate, "--head-motion", "-o", cls.animated)
        write(*animate, "-o", cls.still)

    def animated_head(self, turned=0.0, turn=0.2, way=(0.02, 0.05, 0.01), path=None):
        head = self.load(path or self.animated)
        bpy.context.scene.mien.points = str(POINTS)
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = 11, 82
        stand = bpy.data.objects.new("stand", None)
        bpy.context.scene.collection.objects.link(stand)
        for thing in bpy.context.scene.objects:
            if thing != stand and not thing.parent:
                thing.parent = stand
        for frame, turn, place in ((11, turned, (0, 0, 0)), (82, turned + turn, way)):
            stand.rotation_euler[2], stand.location = turn, place
            stand.keyframe_insert("rotation_euler", frame=frame)
            stand.keyframe_insert("location", frame=frame)
        return head

    def eye_distance(self, head):
        points = json.loads(POINTS.read_text(encoding="utf-8"))["points"]
        by_name = {thing.data.name: evaluated_at_rest(thing) for thing in meshes()}
        left, right = (by_name[points[point]["mesh"]][points[point]["vertex"]] for point in ("3.5", "3.6"))
        return numpy.linalg.norm(left - right)

    def played(self):
        """Where all meshes are at some frames: frames x vertices x 3."""
        frames = [frame for frame in (11, 20, 38, 60, 82) if frame <= bpy.context.scene.frame_end]
        return numpy.array([numpy.vstack([evaluated(thing, frame) for thing in meshes()]) for frame in frames])

    def assert_replays(self, before, eye_distance):
        """All vertices are within the largest error that mien reported, and on average not much above its average."""
        report = json.loads((self.out / "mien" / "head" / "mpeg4" / "report.json").read_text(encoding="utf-8"))
        away = numpy.linalg.norm(self.played() - before, axis=2) / eye_distance
        print(f"replay: {away.mean():.2g} eye distances away on average, {away.max():.2g} at most; mien told "
              f"{report['replay']['mean']:.2g} and {report['replay']['max']:.2g}")
        self.assertLess(away.max(), report["replay"]["max"] * 1.001 + ROUNDING * 10)
        self.assertLess(away.mean(), report["replay"]["mean"] * 1.5 + ROUNDING * 10)
        self.assertGreater(numpy.abs(before[-1] - before[0]).max() / eye_distance, 0.05, "nothing moves, which shows nothing")

    def test_an_animated_head_replays_what_was_extracted_within_the_error_that_is_told(self):
        head = self.animated_head()
        before, eye_distance = self.played(), self.eye_distance(head)
        self.assertEqual(bpy.ops.mien.extract(), {"FINISHED"})
        self.assertRegex(self.told().message, "head: extracted; the replay is .* % of the eye distance away")
        kept = self.out / "mien" / "head" / "mpeg4"
        self.assertTrue((kept / "face.fat").is_file() and (kept / "face.fap").is_file())
        self.assert_replays(before, eye_distance)
        self.assertEqual(bpy.context.scene.frame_current, 82)
        once = self.everything()
        bpy.ops.mien.extract()
        self.assertEqual(self.everything(), once)
        self.assert_replays(before, eye_distance)

    def test_a_head_that_looks_elsewhere_replays_in_its_place(self):
        head = self.animated_head(turned=1.2)
        before, eye_distance = self.played(), self.eye_distance(head)
        bpy.ops.mien.extract()
        self.assert_replays(before, eye_distance)

    def test_an_extracted_head_plays_faps_by_its_table(self):
        head = self.animated_head(turn=0, way=(0, 0, 0), path=self.still)
        bpy.context.scene.frame_end = 40
        eye_distance = self.eye_distance(head)
        bpy.ops.mien.extract()
        replayed = evaluated(head, 30)
        bpy.ops.mien.import_fap(filepath=str(self.out / "mien" / "head" / "mpeg4" / "face.fap"))
        self.assertIn("plays face.fap by its table, to frame 40", self.told().message)
        self.assertEqual([modifier.name for modifier in head.modifiers if modifier.type == "MESH_CACHE"], ["mien"])
        self.assertLess(numpy.abs(evaluated(head, 30) - replayed).max() / eye_distance, 0.001)
        self.assertGreater(numpy.abs(replayed - evaluated_at_rest(head)).max() / eye_distance, 0.05)
        before = self.played()
        self.assertEqual(bpy.ops.mien.extract(), {"FINISHED"})  # what is extracted now is the performance
        self.assert_replays(before, eye_distance)

    def test_a_broken_points_file_leaves_an_animated_head_as_it_was(self):
        self.animated_head()
        before = self.played()
        broken = self.out / "broken.json"
        broken.write_text('{"points": {"8.4": {"mesh": "nobody", "vertex": 1}}}', encoding="utf-8")
        bpy.context.scene.mien.points = str(broken)
        self.assert_refused(bpy.ops.mien.extract, "broken.json: points /points/8.4/mesh: expected the name or number of a mesh")
        self.assertTrue(numpy.array_equal(self.played(), before))


class Refusals(AddOnTest):
    def test_a_broken_points_file_is_told_and_leaves_nothing_behind(self):
        self.load()
        broken = self.out / "broken.json"
        bpy.context.scene.mien.points = str(broken)
        broken.write_text('{"points": {"8.4": {"mesh": "head", "vertex": 99999}}}', encoding="utf-8")
        self.assert_refused(bpy.ops.mien.rig, "broken.json: points /points/8.4: expected a vertex index from 0, below [0-9]+, found .99999.")
        broken.write_text('{"points": {"8.4": ', encoding="utf-8")
        self.assert_refused(bpy.ops.mien.rig, "broken.json: ")
        bpy.context.scene.mien.points = str(self.out / "nowhere.json")
        self.assert_refused(bpy.ops.mien.rig, "nowhere.json: cannot read")

    def test_a_program_that_is_missing_is_told_with_what_to_do(self):
        self.load()
        bpy.context.scene.mien.points = str(POINTS)
        self.preferences.program = str(self.out / "nothing")
        self.assert_refused(bpy.ops.mien.rig, "There is no program at .*nothing.*Preferences")
        self.preferences.program = ""
        path, os.environ["PATH"] = os.environ["PATH"], str(self.out)
        try:
            self.assert_refused(bpy.ops.mien.rig, "was not found on the PATH; set the path to it.*Preferences")
            (self.out / "mien").symlink_to(MIEN)
            self.assertEqual(bpy.ops.mien.rig.poll(), True)
        finally:
            os.environ["PATH"] = path

    def test_a_program_on_the_path_is_found(self):
        self.load()
        bpy.context.scene.mien.points = str(POINTS)
        self.preferences.program = ""
        (self.out / "bin").mkdir()
        (self.out / "bin" / "mien").symlink_to(MIEN)
        path = os.environ["PATH"]
        os.environ["PATH"] = str(self.out / "bin") + os.pathsep + path
        try:
            self.assertEqual(bpy.ops.mien.rig(), {"FINISHED"})
        finally:
            os.environ["PATH"] = path

    def test_a_head_without_points_a_rig_or_a_selection_is_told_what_it_lacks(self):
        head = self.load()
        self.assert_refused(bpy.ops.mien.rig, "no feature points: choose a points file, or make vertex groups")
        self.assert_refused(lambda: bpy.ops.mien.retarget(filepath=str(TAKE)), "has a rig; Rig from Feature Points makes it")
        self.assert_refused(lambda: bpy.ops.mien.import_fap(filepath="x.fap"), "has a rig; Rig from Feature Points makes it")
        head.vertex_groups.new(name="8.4").add([1, 2], 1, "REPLACE")
        self.assert_refused(bpy.ops.mien.rig, "expected one vertex in the vertex group 8.4, found 2")
        bpy.ops.object.select_all(action="DESELECT")
        self.assert_refused(bpy.ops.mien.rig, "Select the meshes of one head")

    def test_files_that_are_no_takes_or_faps_are_told(self):
        self.rigged()
        (self.out / "no.trc").write_text("nonsense", encoding="utf-8")
        (self.out / "no.fap").write_text("nonsense", encoding="utf-8")
        self.assert_refused(lambda: bpy.ops.mien.retarget(filepath=str(self.out / "no.trc")), "no.trc: ")
        self.assert_refused(lambda: bpy.ops.mien.import_fap(filepath=str(self.out / "no.fap")), "no.fap: ")

    def test_vertices_without_faces_and_modifiers_in_the_way_are_told(self):
        head = self.load()
        bpy.context.scene.mien.points = str(POINTS)
        head.modifiers.new("Smooth", "SUBSURF")
        head.modifiers.new("Bend", "SIMPLE_DEFORM")
        self.assert_refused(bpy.ops.mien.rig, "the modifier Bend moves vertices that one above it made")
        head.modifiers.clear()
        head.data.vertices.add(3)
        self.assert_refused(bpy.ops.mien.rig, "3 vertices belong to no face")

    def test_an_unsaved_file_asks_for_a_folder(self):
        bpy.ops.wm.read_homefile(app_template="", use_empty=True)
        bpy.context.preferences.addons["mien"].preferences.program = str(MIEN)
        self.load()
        bpy.context.scene.mien.points = str(POINTS)
        self.assert_refused(bpy.ops.mien.rig, "Save the .blend file first, or choose a folder")
        bpy.context.scene.mien.folder = str(self.out)
        self.assertEqual(bpy.ops.mien.rig(), {"FINISHED"})
        self.assertTrue((self.out / "head" / "rig.glb").is_file())


bpy.ops.preferences.addon_install(filepath=ARCHIVE)
bpy.ops.preferences.addon_enable(module="mien")
program = unittest.main(argv=["addon", "-v", *CHOSEN], exit=False)
sys.exit(0 if program.result.wasSuccessful() and program.result.testsRun else 1)
