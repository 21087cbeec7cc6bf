# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The selected head: which meshes, which feature points, and what its modifiers do to its vertices."""
import re
import typing

import bpy
import numpy

from .mien_calling.host import Head
from .mien_calling.host import Points as PointVertices
from .mien_calling.program import MienError

# The add-on's own modifiers, in their order: a performance, bones on top of it, the replay of what was extracted.
PERFORMANCE, POINTS, REPLAY = OWN = ("mien", "mien points", "mien replay")
POINT = re.compile(r"\d+\.\d+")
# Modifiers that make or drop vertices; what they make follows from what stands above them.
MAKERS = {"ARRAY", "BEVEL", "BOOLEAN", "BUILD", "DECIMATE", "EDGE_SPLIT", "EXPLODE", "MASK", "MIRROR", "MULTIRES",
          "PARTICLE_INSTANCE", "REMESH", "SCREW", "SKIN", "SOLIDIFY", "SUBSURF", "TRIANGULATE", "WELD", "WIREFRAME"}
# Modifiers that leave vertices where they are.
STILL = MAKERS | {"DATA_TRANSFER", "NORMAL_EDIT", "UV_PROJECT", "UV_WARP", "VERTEX_WEIGHT_EDIT", "VERTEX_WEIGHT_MIX",
                  "VERTEX_WEIGHT_PROXIMITY", "WEIGHTED_NORMAL"}


def others(thing: bpy.types.Object) -> typing.List[bpy.types.Modifier]:
    """Its modifiers that are not the add-on's."""
    return [modifier for modifier in thing.modifiers if modifier.name not in OWN]


def check_modifiers(thing: bpy.types.Object) -> int:
    """How many modifiers stand above the first that makes vertices; none below may move vertices."""
    kinds = [modifier.type in MAKERS for modifier in others(thing)]
    place = kinds.index(True) if True in kinds else len(kinds)
    for modifier in others(thing)[place:]:
        if modifier.type not in STILL and modifier.show_viewport:
            raise MienError(f"{thing.name}: the modifier {modifier.name} moves vertices that one above it made; "
                            "move it up, or apply the one above.")
    return place


def place_of(context: bpy.types.Context, thing: bpy.types.Object, name: str) -> None:
    """Moves one of the add-on's modifiers to where it belongs: after all that move vertices, before those that make some."""
    before = [own for own in OWN[:OWN.index(name)] if own in thing.modifiers]
    with context.temp_override(object=thing, active_object=thing):
        bpy.ops.object.modifier_move_to_index(modifier=name, index=check_modifiers(thing) + len(before))


def _check(thing: bpy.types.Object) -> None:
    mesh = thing.data
    corners = numpy.empty(len(mesh.loops), dtype=numpy.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    loose = len(mesh.vertices) - len(numpy.unique(corners))
    if loose:
        raise MienError(f"{thing.name}: {loose} vertices belong to no face; Mesh > Clean Up > Delete Loose removes them.")
    check_modifiers(thing)


def selected_head(context: bpy.types.Context) -> Head:
    """The selected meshes, the active one first."""
    chosen = [thing for thing in context.selected_objects if thing.type == "MESH"]
    if not chosen:
        raise MienError("Select the meshes of one head first.")
    if context.mode != "OBJECT":
        raise MienError("Go to object mode first.")
    active = context.view_layer.objects.active
    chosen.sort(key=lambda thing: (thing != active, thing.name))
    for thing in chosen:
        _check(thing)
    counts = [len(thing.data.vertices) for thing in chosen]
    return Head(chosen[0].name, chosen, [sum(counts[:number]) for number in range(len(counts))], counts)


def _holders(thing: bpy.types.Object) -> typing.Dict[str, typing.List[int]]:
    names = {group.index: group.name for group in thing.vertex_groups if POINT.fullmatch(group.name)}
    found: typing.Dict[str, typing.List[int]] = {name: [] for name in names.values()}
    if names:
        for vertex in thing.data.vertices:
            for share in vertex.groups:
                if share.group in names and share.weight > 0:
                    found[names[share.group]].append(vertex.index)
    return found


def named_points(head: Head) -> PointVertices:
    """The vertex of each vertex group that is named like a feature point."""
    points: PointVertices = {}
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
