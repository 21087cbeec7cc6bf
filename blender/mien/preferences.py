# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Where the program is."""
import bpy

from .mien_calling.program import MienError, find_program


class MienPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program", subtype="FILE_PATH",
        description="The program mien; empty: the first one on the PATH")

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.prop(self, "program")
        try:
            self.layout.label(text=f"Found: {find_program(self.program)}", icon="CHECKMARK")
        except MienError as error:
            self.layout.label(text=str(error), icon="ERROR")


def program(context: bpy.types.Context) -> str:
    """The program that the preferences name or the PATH has."""
    try:
        return find_program(bpy.path.abspath(context.preferences.addons[__package__].preferences.program))
    except MienError as error:
        raise MienError(f"{error} The path is under Edit > Preferences > Add-ons > mien.") from error


def register() -> None:
    bpy.utils.register_class(MienPreferences)


def unregister() -> None:
    bpy.utils.unregister_class(MienPreferences)
