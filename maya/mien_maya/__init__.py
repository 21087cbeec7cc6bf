# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""mien in Maya: rig(), retarget(), import_fap() and extract() for the selected head. Not run in Maya; see README.md."""
import array
import contextlib
import json
import os
import re
import typing

from maya import cmds, mel

from mien_calling import tasks
from mien_calling.host import Head, Points, Remembered, Timing
from mien_calling.program import MienError, Steps, find_program

from .geometry_cache import GeometryCacheWriter

# Rates that Maya has names for; the others say their number, such as 29.97fps.
RATES = {"game": 15, "film": 24, "pal": 25, "ntsc": 30, "show": 48, "palf": 50, "ntscf": 60}
POINT_SET = re.compile(r"point_(\d+)_(\d+)")


class MayaHost:
    """See mien_calling.host.Host. Meshes are the full paths of shapes."""

    def __init__(self, points: str = "", marker_map: str = ""):
        self._points = points
        self._marker_map = marker_map
        if cmds.upAxis(query=True, axis=True) != "y":
            raise MienError("Set the world's up axis to y: Windows > Settings/Preferences > Preferences > Settings.")

    def program(self) -> str:
        return find_program(cmds.optionVar(query="mienProgram") if cmds.optionVar(exists="mienProgram") else "")

    def points_file(self) -> str:
        return self._points

    def marker_map(self) -> str:
        return self._marker_map

    def folder(self) -> str:
        return os.path.join(cmds.workspace(query=True, rootDirectory=True), "mien")

    def frames(self) -> typing.Sequence[int]:
        first, last = (cmds.playbackOptions(query=True, **{end: True}) for end in ("minTime", "maxTime"))
        return range(round(first), round(last) + 1)

    def frames_per_second(self) -> float:
        name = cmds.currentUnit(query=True, time=True)
        return RATES.get(name) or float(name.replace("df", "").replace("fps", ""))

    def selected_head(self) -> Head:
        shapes = cmds.ls(selection=True, dagObjects=True, type="mesh", noIntermediate=True, long=True)
        if not shapes:
            raise MienError("Select the meshes of one head first.")
        counts = [cmds.polyEvaluate(shape, vertex=True) for shape in shapes]
        first_vertices = [sum(counts[:number]) for number in range(len(counts))]
        return Head(self.mesh_name(shapes[0]), shapes, first_vertices, counts)

    def named_points(self, head: Head) -> Points:
        points: Points = {}
        for name in cmds.ls("point_*_*", type="objectSet"):
            match = POINT_SET.fullmatch(name)
            vertices = cmds.ls(cmds.sets(name, query=True) or [], flatten=True) if match else []
            if match and len(vertices) != 1:
                raise MienError(f"expected one vertex in the set {name}, found {len(vertices)}")
            for vertex in vertices:
                shape = cmds.ls(vertex, objectsOnly=True, long=True)[0]
                if shape in head.meshes:
                    index = int(vertex[vertex.rindex("[") + 1:-1])
                    points[".".join(match.groups())] = head.first_vertices[head.meshes.index(shape)] + index
        if not points:
            raise MienError("The head has no feature points: give a points file, or make sets named like point_8_4 that "
                            "hold one vertex each.")
        return points

    @contextlib.contextmanager
    def reading(self, head: Head, at_rest: bool) -> typing.Iterator[None]:
        frame = cmds.currentTime(query=True)
        performing = [switch for switch in map(self._switch, head.meshes)
                      if switch and (at_rest or self._caches(switch, "mienReplay"))]
        try:
            for switch in performing:
                cmds.setAttr(switch + ".playFromCache", False)
            yield
        finally:
            for switch in performing:
                cmds.setAttr(switch + ".playFromCache", True)
            cmds.currentTime(frame)

    def show_frame(self, frame: int) -> None:
        cmds.currentTime(frame)

    def positions(self, head: Head) -> typing.List[array.array]:
        return [array.array("f", cmds.xform(shape + ".vtx[*]", query=True, worldSpace=True, translation=True))
                for shape in head.meshes]

    def faces(self, mesh: str) -> typing.List[typing.List[int]]:
        # A line a face: its number, a colon, its vertices.
        lines = cmds.polyInfo(mesh, faceToVertex=True)
        return [[int(word) for word in line.split(":")[1].split() if word.isdigit()] for line in lines]

    def mesh_name(self, mesh: str) -> str:
        return cmds.listRelatives(mesh, parent=True)[0]

    def spaces(self, head: Head) -> typing.List[typing.List[float]]:
        # Maya's matrices stand right of a row.
        found = [cmds.getAttr(shape + ".worldInverseMatrix") for shape in head.meshes]
        return [[matrix[4 * column + row] for row in range(4) for column in range(4)] for matrix in found]

    def moved(self, values: array.array, matrix: typing.Sequence[float]) -> array.array:
        (a, b, c, p, d, e, f, q, g, h, i, r), coordinates = matrix[:12], iter(values)
        return array.array("f", (value for x, y, z in zip(coordinates, coordinates, coordinates) for value in (
            a * x + b * y + c * z + p, d * x + e * y + f * z + q, g * x + h * y + i * z + r)))

    def cache(self, folder: str, mesh: str, count: int, timing: Timing) -> GeometryCacheWriter:
        rate = self.frames_per_second()
        seconds = [(timing.first_frame + row / timing.rows_per_frame) / rate for row in range(timing.rows)]
        name = tasks.clean(self.mesh_name(mesh))
        return GeometryCacheWriter(os.path.join(folder, name), name, seconds, rate)

    def perform(self, head: Head, folder: str, timing: Timing, is_replay: bool) -> None:
        for shape in head.meshes:
            switch = self._switch(shape) or mel.eval(f'createHistorySwitch("{shape}", false)')
            before = self._caches(switch)
            if before:
                cmds.delete(before)
            name = tasks.clean(self.mesh_name(shape))
            cache = cmds.cacheFile(attachFile=True, fileName=name, directory=folder, channelName=name,
                                   inAttr=switch + ".inp[0]")
            if is_replay:
                cmds.addAttr(cache, longName="mienReplay", attributeType="bool")
            cmds.setAttr(switch + ".playFromCache", True)

    def _switch(self, shape: str) -> str:
        found = cmds.listConnections(shape + ".inMesh", type="historySwitch")
        return found[0] if found else ""

    def _caches(self, switch: str, with_attribute: str = "") -> typing.List[str]:
        found = cmds.listConnections(switch, type="cacheFile") or []
        return [cache for cache in found
                if not with_attribute or cmds.attributeQuery(with_attribute, node=cache, exists=True)]

    def remember(self, kind: str, what: Remembered) -> None:
        name = "mien" + kind.capitalize()
        for shape, first, space in zip(what.head.meshes, what.head.first_vertices, what.spaces):
            if not cmds.attributeQuery(name, node=shape, exists=True):
                cmds.addAttr(shape, longName=name, dataType="string")
            note = {"head": what.head.name, "file": what.file, "first": first, "space": space}
            cmds.setAttr(f"{shape}.{name}", json.dumps(note), type="string")

    def remembered(self, kind: str) -> typing.Optional[Remembered]:
        name = "mien" + kind.capitalize()
        notes = {shape: json.loads(cmds.getAttr(f"{shape}.{name}") or "{}")
                 for shape in cmds.ls(type="mesh", noIntermediate=True, long=True)
                 if cmds.attributeQuery(name, node=shape, exists=True)}
        selected = cmds.ls(selection=True, dagObjects=True, type="mesh", noIntermediate=True, long=True)
        file = next((notes[shape].get("file") for shape in selected if shape in notes), None)
        if not file:
            return None
        shapes = sorted((shape for shape in notes if notes[shape].get("file") == file),
                        key=lambda shape: (notes[shape]["first"], shape))
        head = Head(notes[shapes[0]]["head"], shapes, [notes[shape]["first"] for shape in shapes],
                    [cmds.polyEvaluate(shape, vertex=True) for shape in shapes])
        return Remembered(head, file, [notes[shape]["space"] for shape in shapes])


def _chosen(path: str, caption: str, endings: str) -> str:
    if path:
        return path
    found = cmds.fileDialog2(fileMode=1, caption=caption, fileFilter=f"{caption} ({endings})")
    return found[0] if found else ""


def _shown(steps: Steps) -> str:
    """Takes the steps under a progress window; Escape stops them. What went wrong is Maya's error."""
    cmds.progressWindow(title="mien", isInterruptable=True)
    try:
        while True:
            step = next(steps)
            cmds.progressWindow(edit=True, status=step.what, progress=round(100 * (step.share or 0)))
            if cmds.progressWindow(query=True, isCancelled=True):
                steps.close()
                return "Stopped; nothing was kept."
    except StopIteration as end:
        return end.value
    except (MienError, OSError) as error:
        return cmds.error(str(error))
    finally:
        cmds.progressWindow(endProgress=True)


def _run(steps: typing.Callable[[], Steps]) -> str:
    try:
        sentence = _shown(steps())
    except MienError as error:
        return cmds.error(str(error))
    print(sentence)
    return sentence


def rig(points: str = "") -> str:
    """Binds the selected head, as it is at this frame, to its feature points."""
    return _run(lambda: tasks.rig(MayaHost(points)))


def retarget(take: str = "", marker_map: str = "") -> str:
    """Lets the selected, rigged head perform a capture."""
    take = _chosen(take, "Take", "*.trc *.csv *.c3d")
    return _run(lambda: tasks.retarget(MayaHost(marker_map=marker_map), take)) if take else ""


def import_fap(faps: str = "") -> str:
    """Lets the selected head play FAPs, by its table if it was extracted, else by its rig."""
    faps = _chosen(faps, "Face animation parameters", "*.fap *.fba")
    return _run(lambda: tasks.import_fap(MayaHost(), faps)) if faps else ""


def extract(points: str = "") -> str:
    """MPEG-4 face animation of the selected, animated head over the playback range."""
    return _run(lambda: tasks.extract(MayaHost(points)))
