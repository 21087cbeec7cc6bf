# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The four commands, step by step. Everything is made in a folder of its own and kept only when all of it is there."""
import os
import shutil
import tempfile
import typing

import bpy
from mathutils import Matrix

from . import head as heads
from . import performance
from .mien_calling import commands
from .mien_calling.files import MddWriter, write_obj, write_points
from .mien_calling.program import MienError, Progress, Steps
from .preferences import program


def _points_file(context: bpy.types.Context, head: heads.Head, folder: str) -> str:
    chosen = context.scene.mien.points
    if chosen:
        return bpy.path.abspath(chosen)
    path = os.path.join(folder, "points.json")
    write_points(path, heads.named_points(head))
    return path


def _frames_per_second(scene: bpy.types.Scene) -> float:
    return scene.render.fps / scene.render.fps_base


def _own_folder(context: bpy.types.Context, name: str) -> str:
    """Where what belongs to the head of this name is kept."""
    folder = context.scene.mien.folder
    if folder.startswith("//") and not bpy.data.filepath:
        raise MienError("Save the .blend file first, or choose a folder: the head's files are kept beside it.")
    return os.path.join(bpy.path.abspath(folder), bpy.path.clean_name(name))


def _keep(made: str, folder: str) -> None:
    """Moves files into a folder, over those of an earlier run."""
    os.makedirs(folder, exist_ok=True)
    for name in sorted(os.listdir(made)):
        shutil.move(os.path.join(made, name), os.path.join(folder, name + ".new"))
        os.replace(os.path.join(folder, name + ".new"), os.path.join(folder, name))


def _made(folder: str, name: str) -> str:
    path = os.path.join(folder, name)
    os.mkdir(path)
    return path


def rig(context: bpy.types.Context) -> Steps:
    """Binds the selected head, as it is at the current frame, to its feature points."""
    found, head = program(context), heads.selected_head(context)
    kept = _own_folder(context, head.name)
    with tempfile.TemporaryDirectory(prefix="mien-") as work:
        points, neutral = _points_file(context, head, work), os.path.join(work, "head.obj")
        with heads.bare(head):
            write_obj(neutral, heads.parts(head, heads.positions(head, context)))
        made = _made(work, "made")
        report = yield from commands.rig(found, neutral, points, os.path.join(made, "rig.glb"))
        _keep(made, kept)
    heads.remember(head, "rig", performance.relative(os.path.join(kept, "rig.glb")), heads.spaces(head))
    return f"{head.name}: rigged by {report['rig']['points']} feature points"


def _perform(context: bpy.types.Context, head: heads.Head, made: str, name: str, rows: performance.Rows) -> float:
    """Keeps the caches of a performance and lets the head play them; the last frame."""
    kept = os.path.join(_own_folder(context, head.name), bpy.path.clean_name(name))
    _keep(made, kept)
    rows_per_frame = rows.per_second / _frames_per_second(context.scene)
    timing = performance.Timing(context.scene.frame_start, rows_per_frame)
    performance.perform(head, kept, timing)
    return timing.first_frame + (rows.count - 1) / rows_per_frame


def retarget(context: bpy.types.Context, take: str) -> Steps:
    """Lets the rigged head of the active mesh perform a capture."""
    found = program(context)
    head, rig_file, matrices = heads.remembered_head(context, "rig")
    names = bpy.path.abspath(context.scene.mien.marker_map)
    with tempfile.TemporaryDirectory(prefix="mien-") as work:
        cache, made = os.path.join(work, "performance.mdd"), _made(work, "made")
        report = yield from commands.perform(found, take, names, rig_file, cache)
        rows = yield from performance.split(head, cache, lambda _row: matrices, made)
        last = _perform(context, head, made, commands.stem(take), rows)
    driven = report["retarget"]["points_driven"]
    return f"{head.name}: performs {os.path.basename(take)} with {driven} points, to frame {last:.0f}"


def import_fap(context: bpy.types.Context, faps: str) -> Steps:
    """Lets the head of the active mesh play FAPs: by its table if it was extracted, else by its rig."""
    found, kind = program(context), heads.kind_of(context.view_layer.objects.active)
    head, player, matrices = heads.remembered_head(context, kind)
    with tempfile.TemporaryDirectory(prefix="mien-") as work:
        cache, made = os.path.join(work, "performance.mdd"), _made(work, "made")
        yield from commands.play(found, player, faps, cache)
        rows = yield from performance.split(head, cache, lambda _row: matrices, made)
        last = _perform(context, head, made, commands.stem(faps), rows)
    return f"{head.name}: plays {os.path.basename(faps)} by its {kind}, to frame {last:.0f}"


def _export_motion(context: bpy.types.Context, head: heads.Head, neutral: str, motion: str) -> Steps:
    """The head of the first frame, and its motion over the scene's frames; the value: the spaces of every frame."""
    scene, before = context.scene, context.scene.frame_current
    frames = range(scene.frame_start, scene.frame_end + 1)
    rate = _frames_per_second(scene)
    count = sum(len(thing.data.vertices) for thing in head.meshes)
    matrices: typing.List[typing.List[Matrix]] = []
    try:
        with heads.bare(head), MddWriter(motion, [row / rate for row in range(len(frames))], count) as writer:
            for row, frame in enumerate(frames):
                scene.frame_set(frame)
                placed = heads.positions(head, context)
                if row == 0:
                    write_obj(neutral, heads.parts(head, placed))
                writer.row(sum(placed[1:], placed[0]))
                matrices.append(heads.spaces(head))
                yield Progress("reading the head", (row + 1) / len(frames), holds=True)
    finally:
        scene.frame_set(before)
    return matrices


def extract(context: bpy.types.Context) -> Steps:
    """MPEG-4 face animation of the selected, animated head, and the head playing it."""
    found, head = program(context), heads.selected_head(context)
    kept = os.path.join(_own_folder(context, head.name), "mpeg4")
    with tempfile.TemporaryDirectory(prefix="mien-") as work:
        points = _points_file(context, head, work)
        neutral, motion, table = (os.path.join(work, name) for name in ("head.obj", "motion.mdd", "mpeg4"))
        matrices = yield from _export_motion(context, head, neutral, motion)
        rate = _frames_per_second(context.scene)
        report = yield from commands.extract(found, neutral, motion, points, rate, table)
        cache, made = os.path.join(work, "performance.mdd"), _made(work, "made")
        yield from commands.play(found, os.path.join(table, "face.fat"), os.path.join(table, "face.fap"), cache)
        spaces = (lambda row: matrices[min(row, len(matrices) - 1)])
        rows = yield from performance.split(head, cache, spaces, made)
        _keep(table, kept)
        _perform(context, head, made, "replay", rows)
    heads.remember(head, "table", performance.relative(os.path.join(kept, "face.fat")), matrices[0])
    replay = report["replay"]
    return f"{head.name}: extracted; the replay is {100 * replay['mean']:.2g} % of the eye distance away on average"
