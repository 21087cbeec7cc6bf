# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Blender as the host of the commands. What a head performs is a point cache of each mesh, played by a modifier."""
import array
import contextlib
import os
import typing

import bpy
import numpy
from mathutils import Matrix

from . import head as heads
from . import preferences
from .handles import give_handles
from .mien_calling.files import MddWriter
from .mien_calling.host import Head, Points, Remembered, Timing
from .mien_calling.program import MienError
from .mien_calling.tasks import clean

Y_UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))


def relative(path: str) -> str:
    """To the .blend file, where there is one on the same drive."""
    if not bpy.data.filepath:
        return path
    try:
        return bpy.path.relpath(path)
    except ValueError:
        return path


class BlenderHost:
    """See mien_calling.host.Host."""

    def __init__(self, context: bpy.types.Context):
        self._context = context
        self._scene = context.scene

    def program(self) -> str:
        return preferences.program(self._context)

    def points_file(self) -> str:
        return bpy.path.abspath(self._scene.mien.points)

    def marker_map(self) -> str:
        return bpy.path.abspath(self._scene.mien.marker_map)

    def folder(self) -> str:
        folder = self._scene.mien.folder
        if folder.startswith("//") and not bpy.data.filepath:
            raise MienError("Save the .blend file first, or choose a folder: the head's files are kept beside it.")
        return bpy.path.abspath(folder)

    def frames(self) -> typing.Sequence[int]:
        return range(self._scene.frame_start, self._scene.frame_end + 1)

    def frames_per_second(self) -> float:
        return self._scene.render.fps / self._scene.render.fps_base

    def selected_head(self) -> Head:
        return heads.selected_head(self._context)

    def named_points(self, head: Head) -> Points:
        return heads.named_points(head)

    @contextlib.contextmanager
    def reading(self, head: Head, at_rest: bool) -> typing.Iterator[None]:
        left_out = heads.OWN if at_rest else (heads.REPLAY,)
        hidden = [(thing, modifier.name) for thing in head.meshes for modifier in thing.modifiers
                  if modifier.show_viewport and (modifier.name in left_out or modifier.type in heads.MAKERS)]
        frame = self._scene.frame_current
        try:
            for thing, name in hidden:
                thing.modifiers[name].show_viewport = False
            yield
        finally:
            for thing, name in hidden:
                thing.modifiers[name].show_viewport = True
            if self._scene.frame_current != frame:
                self._scene.frame_set(frame)

    def show_frame(self, frame: int) -> None:
        self._scene.frame_set(frame)

    def positions(self, head: Head) -> typing.List[array.array]:
        graph = self._context.evaluated_depsgraph_get()
        found = []
        for thing, count in zip(head.meshes, head.counts):
            evaluated = thing.evaluated_get(graph)
            mesh = evaluated.to_mesh()
            try:
                if len(mesh.vertices) != count:
                    raise MienError(f"{thing.name}: expected {count} vertices, its modifiers make {len(mesh.vertices)}; "
                                    "hide or apply the one that does.")
                local = numpy.empty(3 * count, dtype=numpy.float32)
                mesh.vertices.foreach_get("co", local)
            finally:
                evaluated.to_mesh_clear()
            matrix = Y_UP @ evaluated.matrix_world
            found.append(self.moved(local, [value for row in matrix for value in row]))
        return found

    def faces(self, mesh: bpy.types.Object) -> typing.List[typing.List[int]]:
        return [list(face.vertices) for face in mesh.data.polygons]

    def mesh_name(self, mesh: bpy.types.Object) -> str:
        return mesh.data.name

    def spaces(self, head: Head) -> typing.List[typing.List[float]]:
        ways = [(Y_UP @ thing.matrix_world).inverted_safe() for thing in head.meshes]
        return [[value for row in way for value in row] for way in ways]

    def moved(self, values: typing.Sequence[float], matrix: typing.Sequence[float]) -> array.array:
        way = numpy.array(matrix).reshape(4, 4)
        points = numpy.asarray(values, dtype=numpy.float32).reshape(-1, 3) @ way[:3, :3].T + way[:3, 3]
        return array.array("f", points.astype(numpy.float32).tobytes())

    def cache(self, folder: str, mesh: bpy.types.Object, count: int, timing: Timing) -> MddWriter:
        rate = timing.rows_per_frame * self.frames_per_second()
        return MddWriter(self._cache_file(folder, mesh), [row / rate for row in range(timing.rows)], count)

    def _cache_file(self, folder: str, mesh: bpy.types.Object) -> str:
        return os.path.join(folder, clean(mesh.name) + ".mdd")

    def perform(self, head: Head, folder: str, timing: Timing, is_replay: bool) -> None:
        name = heads.REPLAY if is_replay else heads.PERFORMANCE
        for thing in head.meshes:
            if not is_replay and heads.REPLAY in thing.modifiers:
                thing.modifiers.remove(thing.modifiers[heads.REPLAY])
            cache = thing.modifiers.get(name) or thing.modifiers.new(name, "MESH_CACHE")
            heads.place_of(self._context, thing, name)
            cache.cache_format, cache.time_mode, cache.play_mode = "MDD", "FRAME", "SCENE"
            cache.frame_scale = timing.rows_per_frame
            cache.frame_start = timing.first_frame * timing.rows_per_frame
            cache.filepath = relative(self._cache_file(folder, thing))
            thing.update_tag()

    def remember(self, kind: str, what: Remembered) -> None:
        for thing, first, count, space in zip(what.head.meshes, what.head.first_vertices, what.head.counts, what.spaces):
            note = getattr(thing, "mien_" + kind)
            note.head, note.file, note.first_vertex, note.vertices = what.head.name, relative(what.file), first, count
            note.to_object = space
        if kind == "rig":
            give_handles(self._context, what.head, what.file, Y_UP.inverted())

    def remembered(self, kind: str) -> typing.Optional[Remembered]:
        active = self._context.view_layer.objects.active
        note = getattr(active, "mien_" + kind) if active else None
        if not note or not note.file:
            return None
        notes = [(getattr(thing, "mien_" + kind), thing) for thing in self._scene.objects if thing.type == "MESH"]
        own = sorted(((other, thing) for other, thing in notes if other.file == note.file),
                     key=lambda pair: (pair[0].first_vertex, pair[1].name))
        for other, thing in own:
            if other.vertices != len(thing.data.vertices):
                raise MienError(f"{thing.name}: expected {other.vertices} vertices as when its {kind} was made, found "
                                f"{len(thing.data.vertices)}; make it anew.")
            heads.check_modifiers(thing)
        head = Head(note.head, [thing for _other, thing in own], [other.first_vertex for other, _thing in own],
                    [other.vertices for other, _thing in own])
        return Remembered(head, bpy.path.abspath(note.file), [list(other.to_object) for other, _thing in own])
