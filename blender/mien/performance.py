# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""A performance that the program wrote, on the head itself: a point cache in each mesh's own space, and its modifier."""
import array
import contextlib
import os
import typing

import bpy
import numpy
from mathutils import Matrix

from .head import CACHE, Head, moved, place_of_cache
from .mien_calling.files import MddReader, MddWriter
from .mien_calling.program import MienError, Progress, Steps

Spaces = typing.Callable[[int], typing.Sequence[Matrix]]  # of a row: one matrix a mesh


class Timing(typing.NamedTuple):
    """When a cache plays: its first row at this frame, so many rows a frame."""
    first_frame: float
    rows_per_frame: float


class Rows(typing.NamedTuple):
    """Of a cache."""
    count: int
    per_second: float


def file_name(thing: bpy.types.Object) -> str:
    return bpy.path.clean_name(thing.name) + ".mdd"


def split(head: Head, source: str, spaces: Spaces, folder: str) -> Steps:
    """One cache a mesh from that of the head; the value is what rows they have."""
    counts = [len(thing.data.vertices) for thing in head.meshes]
    with MddReader(source) as reader, contextlib.ExitStack() as opened:
        needed = max(first + count for first, count in zip(head.first_vertices, counts))
        if reader.vertices < needed:
            raise MienError(f"expected {needed} vertices in the performance, found {reader.vertices}; make the rig anew.")
        rows = Rows(reader.rows, reader.rows_per_second())
        times = [row / rows.per_second for row in range(rows.count)]
        writers = [opened.enter_context(MddWriter(os.path.join(folder, file_name(thing)), times, count))
                   for thing, count in zip(head.meshes, counts)]
        for row in range(rows.count):
            values = numpy.frombuffer(reader.even_row(row), dtype=numpy.float32)
            for writer, first, count, matrix in zip(writers, head.first_vertices, counts, spaces(row)):
                own = moved(values[3 * first:3 * (first + count)], numpy.array(matrix))
                writer.row(array.array("f", own.tobytes()))
            yield Progress(f"bringing {head.name} back", (row + 1) / rows.count)
    return rows


def perform(head: Head, folder: str, timing: Timing) -> None:
    """Lets every mesh play its cache of this folder, instead of the one before."""
    places = [place_of_cache(thing) for thing in head.meshes]
    for thing, place in zip(head.meshes, places):
        cache = thing.modifiers.get(CACHE) or thing.modifiers.new(CACHE, "MESH_CACHE")
        with bpy.context.temp_override(object=thing, active_object=thing):
            bpy.ops.object.modifier_move_to_index(modifier=CACHE, index=place)
        cache.cache_format = "MDD"
        cache.time_mode = "FRAME"
        cache.play_mode = "SCENE"
        cache.frame_scale = timing.rows_per_frame
        cache.frame_start = timing.first_frame * timing.rows_per_frame
        cache.filepath = relative(os.path.join(folder, file_name(thing)))
        thing.update_tag()


def relative(path: str) -> str:
    """To the .blend file, where there is one on the same drive."""
    if not bpy.data.filepath:
        return path
    try:
        return bpy.path.relpath(path)
    except ValueError:
        return path
