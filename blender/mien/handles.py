# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Bones by which a rigged head is posed by hand, one a feature point; they act on top of a performance."""

import bpy
import numpy
from mathutils import Matrix, Vector

from .head import POINT, POINTS, place_of
from .mien_calling.host import Head
from .skin import Skin, read_skin

LENGTH = 0.03  # of a bone, as a share of the head's size


def _armature(context: bpy.types.Context, head: Head, skin: Skin, to_z_up: Matrix) -> bpy.types.Object:
    """Of the head's first mesh, which it follows: that of an earlier rig with new bones, or a new one."""
    first, before = head.meshes[0], context.view_layer.objects.active
    found = next((child for child in first.children if child.type == "ARMATURE" and child.name.startswith(POINTS)), None)
    if not found:
        found = bpy.data.objects.new(f"{POINTS} of {head.name}", bpy.data.armatures.new(f"{POINTS} of {head.name}"))
        first.users_collection[0].objects.link(found)
        found.parent, found.show_in_front = first, True
    found.matrix_parent_inverse = first.matrix_world.inverted_safe()
    found.matrix_basis = Matrix()
    for bone in found.pose.bones if found.pose else ():
        bone.matrix_basis = Matrix()
    places = [to_z_up @ Vector(place) for place in skin.places]
    forward = Vector((0, -LENGTH * float(numpy.ptp(skin.places, axis=0).max()), 0))
    context.view_layer.objects.active = found
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        for bone in list(found.data.edit_bones):
            found.data.edit_bones.remove(bone)
        for name, place in zip(skin.names, places):
            bone = found.data.edit_bones.new(_bone(name))
            bone.head, bone.tail = place, place + forward
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
        context.view_layer.objects.active = before
    for name in skin.names:
        bone = found.pose.bones[_bone(name)]
        bone.lock_scale = (True, True, True)
        bone.lock_rotation = [POINT.fullmatch(name) is not None] * 3
    return found


def _bone(name: str) -> str:
    """Not that of a point, which is a vertex group that the user made."""
    return f"{POINTS} {name}"


def _weigh(thing: bpy.types.Object, skin: Skin, first: int, count: int) -> None:
    """Vertex groups that say how much of the mesh each bone holds, instead of those of an earlier rig."""
    for group in [group for group in thing.vertex_groups if group.name.startswith(POINTS + " ")]:
        thing.vertex_groups.remove(group)
    joints, weights = skin.joints[first:first + count], skin.weights[first:first + count]
    for joint in sorted({int(number) for number in numpy.unique(joints[weights > 0])}):
        group = thing.vertex_groups.new(name=_bone(skin.names[joint]))
        for vertex, column in zip(*numpy.nonzero((joints == joint) & (weights > 0))):
            group.add([int(vertex)], float(weights[vertex, column]), "REPLACE")


def give_handles(context: bpy.types.Context, head: Head, rig: str, to_z_up: Matrix) -> None:
    """Lets the bones of a rig that was just made move the head's meshes."""
    skin = read_skin(rig)
    armature = _armature(context, head, skin, to_z_up)
    for thing, first, count in zip(head.meshes, head.first_vertices, head.counts):
        _weigh(thing, skin, first, count)
        modifier = thing.modifiers.get(POINTS) or thing.modifiers.new(POINTS, "ARMATURE")
        modifier.object, modifier.use_bone_envelopes = armature, False
        place_of(context, thing, POINTS)
