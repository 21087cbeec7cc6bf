# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The four commands, step by step. Everything is made in a folder of its own and kept only when all of it is there.

The value of the steps is a sentence that tells what was done.
"""
import array
import contextlib
import os
import re
import shutil
import tempfile
import typing

from . import program
from .files import MddReader, MddWriter, Part, write_json, write_obj
from .host import Head, Host, Matrix, Remembered, Timing
from .program import MienError, Progress, Steps

Spaces = typing.Callable[[int], typing.Sequence[Matrix]]  # of a row: one a mesh
MADE_BY = {"rig": "Rig from Feature Points", "table": "Extract MPEG-4"}


def clean(name: str) -> str:
    """As the name of a file."""
    return re.sub(r"[^\w.-]", "_", name).strip(".") or "_"


def _stem(path: str) -> str:
    return clean(os.path.splitext(os.path.basename(path))[0])


def _points_file(host: Host, head: Head, folder: str) -> str:
    chosen = host.points_file()
    if chosen:
        return chosen
    path = os.path.join(folder, "points.json")
    write_json(path, {"points": host.named_points(head)})
    return path


def _folder(host: Host, head: Head) -> str:
    return os.path.join(host.folder(), clean(head.name))


def _made(folder: str, name: str) -> str:
    path = os.path.join(folder, name)
    os.mkdir(path)
    return path


def _keep(made: str, folder: str) -> None:
    """Moves files into a folder, over those of an earlier run."""
    os.makedirs(folder, exist_ok=True)
    for name in sorted(os.listdir(made)):
        shutil.move(os.path.join(made, name), os.path.join(folder, name + ".new"))
        os.replace(os.path.join(folder, name + ".new"), os.path.join(folder, name))


def _parts(host: Host, head: Head, placed: typing.Sequence[array.array]) -> typing.List[Part]:
    return [Part(host.mesh_name(mesh), values, host.faces(mesh)) for mesh, values in zip(head.meshes, placed)]


def _remembered(host: Host, kind: str) -> Remembered:
    found = host.remembered(kind)
    if not found:
        raise MienError(f"Select a head that has a {kind}; {MADE_BY[kind]} makes it.")
    return found


def _split(host: Host, head: Head, source: str, spaces: Spaces, folder: str) -> Steps:
    """One cache a mesh, in its own space, from that of the head; the value is when it plays."""
    with MddReader(source) as reader, contextlib.ExitStack() as opened:
        needed = max(first + count for first, count in zip(head.first_vertices, head.counts))
        if reader.vertices < needed:
            raise MienError(f"expected {needed} vertices in the performance, found {reader.vertices}; make the rig anew.")
        timing = Timing(host.frames()[0], reader.rows, reader.rows_per_second() / host.frames_per_second())
        writers = [opened.enter_context(host.cache(folder, mesh, count, timing))
                   for mesh, count in zip(head.meshes, head.counts)]
        for row in range(reader.rows):
            values = reader.even_row(row)
            for writer, first, count, matrix in zip(writers, head.first_vertices, head.counts, spaces(row)):
                writer.row(host.moved(values[3 * first:3 * (first + count)], matrix))
            yield Progress(f"bringing {head.name} back", (row + 1) / reader.rows)
    return timing


def _perform(host: Host, head: Head, made: str, name: str, timing: Timing, is_replay: bool = False) -> None:
    """Keeps the caches of a performance and lets the head play them."""
    kept = os.path.join(_folder(host, head), name)
    _keep(made, kept)
    host.perform(head, kept, timing, is_replay)


def rig(host: Host) -> Steps:
    """Binds the selected head, as it is at this frame, to its feature points."""
    mien, head = host.program(), host.selected_head()
    kept = _folder(host, head)
    with tempfile.TemporaryDirectory(prefix="mien-") as work:
        points, neutral = _points_file(host, head, work), os.path.join(work, "head.obj")
        with host.reading(head, at_rest=True):
            write_obj(neutral, _parts(host, head, host.positions(head)))
            spaces = host.spaces(head)
        made = _made(work, "made")
        report = yield from program.running(
            mien, ["rig", neutral, "--points", points, "-o", os.path.join(made, "rig.glb")])
        _keep(made, kept)
    host.remember("rig", Remembered(head, os.path.join(kept, "rig.glb"), spaces))
    return f"{head.name}: rigged by {report['rig']['points']} feature points"


def retarget(host: Host, take: str) -> Steps:
    """Lets the rigged head of the active mesh perform a capture."""
    mien, (head, rig_file, spaces), names = host.program(), _remembered(host, "rig"), host.marker_map()
    with tempfile.TemporaryDirectory(prefix="mien-") as work:
        onto, cache, made = os.path.join(work, "onto.csv"), os.path.join(work, "performance.mdd"), _made(work, "made")
        by_names = ["--map", names] if names else []
        report = yield from program.running(mien, ["retarget", take, "--rig", rig_file, *by_names, "-o", onto])
        yield from program.running(mien, ["deform", rig_file, onto, "-o", cache])
        timing = yield from _split(host, head, cache, lambda _row: spaces, made)
        _perform(host, head, made, _stem(take), timing)
    driven = report["retarget"]["points_driven"]
    return f"{head.name}: performs {os.path.basename(take)} with {driven} points, to frame {timing.last_frame():.0f}"


def _play(mien: str, kind: str, player: str, faps: str, cache: str) -> Steps:
    """A cache of FAPs on a table, which turns the head too, or on a rig, whose caches leave its turns out."""
    turns = ["--head-motion"] if kind == "table" else []
    return program.running(mien, ["play", player, faps, *turns, "-o", cache])


def import_fap(host: Host, faps: str) -> Steps:
    """Lets the head of the active mesh play FAPs: by its table if it was extracted, else by its rig."""
    mien, kind = host.program(), "table" if host.remembered("table") else "rig"
    head, player, spaces = _remembered(host, kind)
    with tempfile.TemporaryDirectory(prefix="mien-") as work:
        cache, made = os.path.join(work, "performance.mdd"), _made(work, "made")
        yield from _play(mien, kind, player, faps, cache)
        timing = yield from _split(host, head, cache, lambda _row: spaces, made)
        _perform(host, head, made, _stem(faps), timing)
    return f"{head.name}: plays {os.path.basename(faps)} by its {kind}, to frame {timing.last_frame():.0f}"


def _export_motion(host: Host, head: Head, neutral: str, motion: str) -> Steps:
    """The head of the first frame, and its motion over the scene's frames; the value: the spaces of every frame."""
    frames, rate = host.frames(), host.frames_per_second()
    every_space: typing.List[typing.List[Matrix]] = []
    times = [row / rate for row in range(len(frames))]
    with host.reading(head, at_rest=False), MddWriter(motion, times, sum(head.counts)) as writer:
        for row, frame in enumerate(frames):
            host.show_frame(frame)
            placed = host.positions(head)
            if row == 0:
                write_obj(neutral, _parts(host, head, placed))
            writer.row(sum(placed[1:], placed[0]))
            every_space.append(host.spaces(head))
            yield Progress("reading the head", (row + 1) / len(frames), holds=True)
    return every_space


def _shifts(track: str) -> typing.List[Matrix]:
    """Where the head went in each row, by the track that was extracted: time,x,y,z."""
    with open(track, encoding="utf-8") as file:
        return [_shift(*map(float, line.split(",")[1:])) for line in file.read().splitlines()[1:]]


def _shift(x: float, y: float, z: float) -> Matrix:
    return [1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1]


def _after(second: Matrix, first: Matrix) -> Matrix:
    """One way, then the other."""
    return [sum(second[4 * row + k] * first[4 * k + column] for k in range(4)) for row in range(4) for column in range(4)]


def extract(host: Host) -> Steps:
    """MPEG-4 face animation of the selected, animated head, and the head playing it."""
    mien, head = host.program(), host.selected_head()
    kept = os.path.join(_folder(host, head), "mpeg4")
    with tempfile.TemporaryDirectory(prefix="mien-") as work:
        points = _points_file(host, head, work)
        neutral, motion, table = (os.path.join(work, name) for name in ("head.obj", "motion.mdd", "mpeg4"))
        spaces = yield from _export_motion(host, head, neutral, motion)
        report = yield from program.running(mien, ["extract", motion, "--head", neutral, "--points", points, "--fps",
                                                   f"{host.frames_per_second():.9g}", "-o", table])
        write_json(os.path.join(table, "report.json"), report)
        cache, made = os.path.join(work, "performance.mdd"), _made(work, "made")
        yield from _play(mien, "table", os.path.join(table, "face.fat"), os.path.join(table, "face.fap"), cache)
        model = report["head"]["from_model_to_animation"]
        ways = [[_after(space, _after(model, shift)) for space in of_frame]
                for of_frame, shift in zip(spaces, _shifts(os.path.join(table, "head.csv")))]
        timing = yield from _split(host, head, cache, lambda row: ways[min(row, len(ways) - 1)], made)
        _keep(table, kept)
        _perform(host, head, made, "replay", timing, is_replay=True)
    still = [_after(space, model) for space in spaces[0]]
    host.remember("table", Remembered(head, os.path.join(kept, "face.fat"), still))
    away = 100 * report["replay"]["mean"]
    return f"{head.name}: extracted; the replay is {away:.2g} % of the eye distance away on average"
