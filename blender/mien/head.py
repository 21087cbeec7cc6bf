# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The selected head: which meshes, which feature points, and what its modifiers do to its vertices."""
import re
import typing

import bpy
import numpy

from .mien_calling.host import Head, Points
from .mien_calling.program import MienError

CACHE = "mien"  # the modifier by which a head performs
POINT = re.compile(r"\d+\.\d+")
# Modifiers that make or drop vertices; what they make follows from what stands above them.
MAKERS = {"ARRAY", "BEVEL", "BOOLEAN", "BUILD", "DECIMATE", "EDGE_SPLIT", "EXPLODE", "MASK", "MIRROR", "MULTIRES",
          "PARTICLE_INSTANCE", "REMESH", "SCREW", "SKIN", "SOLIDIFY", "SUBSURF", "TRIANGULATE", "WELD", "WIREFRAME"}
# Modifiers that leave vertices where they are.
STILL = MAKERS | {"DATA_TRANSFER", "NORMAL_EDIT", "UV_PROJECT", "UV_WARP", "VERTEX_WEIGHT_EDIT", "VERTEX_WEIGHT_MIX",
                  "VERTEX_WEIGHT_PROXIMITY", "WEIGHTED_NORMAL"}


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
