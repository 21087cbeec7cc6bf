# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The tab in the sidebar of the 3D view."""
import textwrap

import bpy

WIDTH = 42  # letters of a line of the message


class MIEN_PT_panel(bpy.types.Panel):
    bl_label = "mien"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "mien"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.scene.mien
        self._tell(context)
        column = layout.column()
        column.prop(settings, "points")
        column.prop(settings, "folder")
        layout.operator("mien.extract", icon="EXPORT")
        layout.operator("mien.rig", icon="BONE_DATA")
        box = layout.box()
        box.prop(settings, "marker_map", text="Map")
        box.operator("mien.retarget", icon="IMPORT")
        layout.operator("mien.import_fap", icon="IMPORT")

    def _tell(self, context: bpy.types.Context) -> None:
        told = context.window_manager.mien
        if told.running:
            row = self.layout.row(align=True)
            row.prop(told, "share", text=told.message, slider=True)
            row.operator("mien.stop", text="", icon="X")
        elif told.message:
            box = self.layout.box()
            box.alert = told.is_error
            for number, line in enumerate(textwrap.wrap(told.message, WIDTH)):
                icon = "NONE" if number else "ERROR" if told.is_error else "INFO"
                box.label(text=line, icon=icon)


def register() -> None:
    bpy.utils.register_class(MIEN_PT_panel)


def unregister() -> None:
    bpy.utils.unregister_class(MIEN_PT_panel)
