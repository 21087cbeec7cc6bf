# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The selected head as the program reads it: which meshes, which feature points, where the vertices are."""
import array
import contextlib
import re
import typing

import bpy
import numpy
from mathutils import Matrix

from .mien_calling.files import Part
from .mien_calling.program import MienError

CACHE = "mien"  # the modifier by which a head performs
POINT = re.compile(r"\d+\.\d+")
Y_UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
# Modifiers that make or drop vertices; what they make follows from what stands above them.
MAKERS = {"ARRAY", "BEVEL", "BOOLEAN", "BUILD", "DECIMATE", "EDGE_SPLIT", "EXPLODE", "MASK", "MIRROR", "MULTIRES",
          "PARTICLE_INSTANCE", "REMESH", "SCREW", "SKIN", "SOLIDIFY", "SUBSURF", "TRIANGULATE", "WELD", "WIREFRAME"}
# Modifiers that leave vertices where they are.
STILL = MAKERS | {"DATA_TRANSFER", "NORMAL_EDIT", "UV_PROJECT", "UV_WARP", "VERTEX_WEIGHT_EDIT", "VERTEX_WEIGHT_MIX",
                  "VERTEX_WEIGHT_PROXIMITY", "WEIGHTED_NORMAL"}

Points = typing.Dict[str, int]


class Head(typing.NamedTuple):
    """Meshes that are one head; the program numbers their vertices through."""
    name: str
    meshes: typing.List[bpy.types.Object]
    first_vertices: typing.List[int]


def place_of_cache(thing: bpy.types.Object) -> int:
    """Before the first modifier that makes vertices, after all that move them."""
    kinds = [modifier.type for modifier in thing.modifiers if modifier.name != CACHE]
    makers = [index for index, kind in enumerate(kinds) if kind in MAKERS]
    place = makers[0] if makers else len(kinds)
    for modifier in [modifier for modifier in thing.modifiers if modifier.name != CACHE][place:]:
        if modifier.type not in STILL and modifier.show_viewport:
            raise MienError(f"{thing.name}: the modifier {modifier.name} moves vertices that one above it made; "
                            "move it up, or apply the one above.")
    return place


def _check(thing: bpy.types.Object) -> None:
    mesh = thing.data
    corners = numpy.empty(len(mesh.loops), dtype=numpy.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    loose = len(mesh.vertices) - len(numpy.unique(corners))
    if loose:
        raise MienError(f"{thing.name}: {loose} vertices belong to no face; Mesh > Clean Up > Delete Loose removes them.")
    place_of_cache(thing)


def selected_head(context: bpy.types.Context) -> Head:
    """The selected meshes, the active one first."""
    chosen = [thing for thing in context.selected_objects if thing.type == "MESH"]
    if not chosen:
        raise MienError("Select the meshes of one head first.")
    if any(thing.mode == "EDIT" for thing in chosen):
        raise MienError("Leave edit mode first.")
    active = context.view_layer.objects.active
    chosen.sort(key=lambda thing: (thing != active, thing.name))
    first_vertices, count = [], 0
    for thing in chosen:
        _check(thing)
        first_vertices.append(count)
        count += len(thing.data.vertices)
    return Head(chosen[0].name, chosen, first_vertices)


def _holders(thing: bpy.types.Object) -> typing.Dict[str, typing.List[int]]:
    names = {group.index: group.name for group in thing.vertex_groups if POINT.fullmatch(group.name)}
    found: typing.Dict[str, typing.List[int]] = {name: [] for name in names.values()}
    if names:
        for vertex in thing.data.vertices:
            for share in vertex.groups:
                if share.group in names and share.weight > 0:
                    found[names[share.group]].append(vertex.index)
    return found


def named_points(head: Head) -> Points:
    """The vertex of each vertex group that is named like a feature point."""
    points: Points = {}
    for thing, first in zip(head.meshes, head.first_vertices):
        for name, vertices in _holders(thing).items():
            if len(vertices) != 1:
                raise MienError(f"{thing.name}: expected one vertex in the vertex group {name}, found {len(vertices)}.")
            if name in points:
                raise MienError(f"{thing.name}: another mesh of the head has a vertex group {name} too.")
            points[name] = first + vertices[0]
    if not points:
        raise MienError("The head has no feature points: choose a points file, or make vertex groups named like 8.4 "
                        "that hold one vertex each.")
    return dict(sorted(points.items(), key=lambda point: [int(number) for number in point[0].split(".")]))


@contextlib.contextmanager
def bare(head: Head) -> typing.Iterator[None]:
    """The head without its performance and without what modifiers make of it, so that its vertices are its own."""
    hidden = [(thing, modifier.name) for thing in head.meshes for modifier in thing.modifiers
              if modifier.show_viewport and (modifier.name == CACHE or modifier.type in MAKERS)]
    try:
        for thing, name in hidden:
            thing.modifiers[name].show_viewport = False
        yield
    finally:
        for thing, name in hidden:
            thing.modifiers[name].show_viewport = True


def positions(head: Head, context: bpy.types.Context) -> typing.List[array.array]:
    """Where the vertices of each mesh are at the current frame, in the program's space. The head is bare."""
    graph = context.evaluated_depsgraph_get()
    found = []
    for thing in head.meshes:
        evaluated = thing.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        try:
            if len(mesh.vertices) != len(thing.data.vertices):
                raise MienError(f"{thing.name}: expected {len(thing.data.vertices)} vertices, its modifiers make "
                                f"{len(mesh.vertices)}; hide or apply the one that does.")
            local = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
            mesh.vertices.foreach_get("co", local)
        finally:
            evaluated.to_mesh_clear()
        matrix = numpy.array(Y_UP @ evaluated.matrix_world)
        found.append(array.array("f", moved(local, matrix).tobytes()))
    return found


def moved(values: numpy.ndarray, matrix: numpy.ndarray) -> numpy.ndarray:
    """x, y, z one after another, in another space."""
    return (values.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]).astype(numpy.float32).ravel()


def spaces(head: Head) -> typing.List[Matrix]:
    """For each mesh the way from the program's space to its own, at the current frame."""
    return [(Y_UP @ thing.matrix_world).inverted_safe() for thing in head.meshes]


def parts(head: Head, placed: typing.List[array.array]) -> typing.List[Part]:
    """The head with its vertices at these positions. Parts have the names of the meshes, as a file they came from."""
    return [Part(thing.data.name, values, [list(face.vertices) for face in thing.data.polygons])
            for thing, values in zip(head.meshes, placed)]


def remember(head: Head, kind: str, file: str, matrices: typing.List[Matrix]) -> None:
    """Leaves on the meshes which rig or table (the kind) was made from them, and in which spaces."""
    for thing, first, matrix in zip(head.meshes, head.first_vertices, matrices):
        note = getattr(thing, "mien_" + kind)
        note.head, note.file, note.first_vertex = head.name, file, first
        note.vertices = len(thing.data.vertices)
        note.to_object = [value for row in matrix for value in row]


def kind_of(thing: typing.Optional[bpy.types.Object]) -> str:
    """What FAPs can be played on: the table of an extracted head, else a rig."""
    return "table" if thing and thing.mien_table.file else "rig"


def remembered_head(context: bpy.types.Context, kind: str) -> typing.Tuple[Head, str, typing.List[Matrix]]:
    """The head of the active mesh, its rig or table, and the spaces that was made in."""
    active = context.view_layer.objects.active
    note = getattr(active, "mien_" + kind) if active else None
    if not note or not note.file:
        wanted = "Rig from Feature Points" if kind == "rig" else "Extract MPEG-4"
        raise MienError(f"Select a head that has a {kind}; {wanted} makes it.")
    notes = [(getattr(thing, "mien_" + kind), thing) for thing in context.scene.objects if thing.type == "MESH"]
    own = sorted(((other, thing) for other, thing in notes if other.file == note.file),
                 key=lambda pair: (pair[0].first_vertex, pair[1].name))
    for other, thing in own:
        if other.vertices != len(thing.data.vertices):
            raise MienError(f"{thing.name}: expected {other.vertices} vertices as when its {kind} was made, found "
                            f"{len(thing.data.vertices)}; make it anew.")
        place_of_cache(thing)
    matrices = [Matrix([other.to_object[row:row + 4] for row in range(0, 16, 4)]) for other, _thing in own]
    head = Head(note.head, [thing for _other, thing in own], [other.first_vertex for other, _thing in own])
    return head, bpy.path.abspath(note.file), matrices
