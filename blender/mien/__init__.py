# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""mien in Blender: an animated head becomes MPEG-4 face animation, any head performs captures and FAP files.

A front: it writes what is selected to files, calls the program mien and brings what that wrote back to the head.
"""
bl_info = {
    "name": "mien",
    "author": "the mien authors",
    "version": (0, 0, 0),  # the build writes the project's
    "blender": (3, 4, 0),
    "category": "Animation",
    "location": "3D View > Sidebar > mien",
    "description": "Brings any face mesh to life from feature points",
}

from . import operators, panel, preferences, settings

MODULES = (preferences, settings, operators, panel)


def register() -> None:
    for module in MODULES:
        module.register()


def unregister() -> None:
    for module in reversed(MODULES):
        module.unregister()
