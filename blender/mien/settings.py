# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What the panel asks for, what a head remembers, and what is told of the last command."""
import bpy


class MienSettings(bpy.types.PropertyGroup):
    """Of a scene."""
    points: bpy.props.StringProperty(
        name="Points", subtype="FILE_PATH",
        description="A points file (.json); empty: vertex groups named like 8.4 that hold one vertex each")
    folder: bpy.props.StringProperty(
        name="Folder", subtype="DIR_PATH", default="//mien",
        description="Where rigs, tables and performances are kept; // is the folder of the .blend file")
    marker_map: bpy.props.StringProperty(
        name="Marker Map", subtype="FILE_PATH",
        description="Which marker is which feature point (.csv or .json); empty: markers are named like points")


class MienHead(bpy.types.PropertyGroup):
    """Of every mesh of a head: the rig or the table that was made from it."""
    head: bpy.props.StringProperty(description="The name of the head: its folder")
    file: bpy.props.StringProperty(subtype="FILE_PATH", description="What mien made")
    first_vertex: bpy.props.IntProperty(description="Where the vertices of this mesh begin among those of the head")
    vertices: bpy.props.IntProperty(description="How many there are")
    to_object: bpy.props.FloatVectorProperty(
        size=16, description="From the space of the program to that of the mesh, row by row")


class MienState(bpy.types.PropertyGroup):
    """Of this session of Blender."""
    running: bpy.props.BoolProperty()
    cancel: bpy.props.BoolProperty()
    message: bpy.props.StringProperty()
    is_error: bpy.props.BoolProperty()
    share: bpy.props.FloatProperty(name="Done", min=0, max=100, subtype="PERCENTAGE")


CLASSES = (MienSettings, MienHead, MienState)


def register() -> None:
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.mien = bpy.props.PointerProperty(type=MienSettings)
    bpy.types.Object.mien_rig = bpy.props.PointerProperty(type=MienHead)
    bpy.types.Object.mien_table = bpy.props.PointerProperty(type=MienHead)
    bpy.types.WindowManager.mien = bpy.props.PointerProperty(type=MienState)


def unregister() -> None:
    del bpy.types.WindowManager.mien
    del bpy.types.Object.mien_table
    del bpy.types.Object.mien_rig
    del bpy.types.Scene.mien
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
