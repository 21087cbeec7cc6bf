# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The four commands as operators: beside the interface while there is one, at once where there is none."""
import time
import typing

import bpy

from .host import BlenderHost
from .mien_calling import tasks
from .mien_calling.program import MienError, Progress, Steps

TICK = 0.1  # seconds between looks at the program
BUSY = 0.05  # seconds of a tick that steps may take


def state(context: bpy.types.Context) -> "bpy.types.PropertyGroup":
    return context.window_manager.mien


def _draw_panel(context: bpy.types.Context) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if area.type == "VIEW_3D" and region.type == "UI":
                    region.tag_redraw()


class Command:
    """Runs steps. What they tell, and what came of them, is shown by the panel."""
    bl_options = {"REGISTER", "UNDO"}

    def steps(self, context: bpy.types.Context) -> Steps:
        raise NotImplementedError

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return not state(context).running

    def execute(self, context: bpy.types.Context) -> typing.Set[str]:
        told = state(context)
        told.message, told.is_error, told.share, told.cancel = "", False, 0, False
        self._steps, self._progress = self.steps(context), Progress("starting", holds=True)
        if bpy.app.background:
            while True:
                result = self._advance(context, 3600)
                if result:
                    return result
        told.running = True
        self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> typing.Set[str]:
        if event.type == "ESC" or state(context).cancel:
            self._steps.close()
            return self._end(context, "Stopped; nothing was kept.", {"CANCELLED"})
        if event.type == "TIMER":
            result = self._advance(context, BUSY)
            _draw_panel(context)
            return result or {"RUNNING_MODAL"}
        return {"RUNNING_MODAL"} if self._progress.holds else {"PASS_THROUGH"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender closes, or loads another file."""
        self._steps.close()
        self._end(context, "", {"CANCELLED"})

    def _advance(self, context: bpy.types.Context, seconds: float) -> typing.Set[str]:
        """Takes steps for so long; empty while there are more."""
        until = time.monotonic() + seconds
        try:
            while time.monotonic() < until:
                self._progress = next(self._steps)
        except StopIteration as end:
            return self._end(context, end.value, {"FINISHED"})
        except (MienError, OSError, ReferenceError) as error:
            return self._end(context, str(error), {"CANCELLED"}, is_error=True)
        told = state(context)
        told.message, told.share = self._progress.what, 100 * (self._progress.share or 0)
        return set()

    def _end(self, context: bpy.types.Context, message: str, result: typing.Set[str],
             is_error: bool = False) -> typing.Set[str]:
        told = state(context)
        if told.running:
            context.window_manager.event_timer_remove(self._timer)
        told.running, told.message, told.is_error, told.share = False, message, is_error, 0
        if message:
            self.report({"ERROR" if is_error else "INFO"}, message)
        return result


class FileCommand(Command):
    """A command that asks for a file first."""

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> typing.Set[str]:
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def chosen(self) -> str:
        return bpy.path.abspath(self.filepath)


class MIEN_OT_extract(Command, bpy.types.Operator):
    """Extract face animation parameters and tables from the selected, animated head, and let it play them"""
    bl_idname = "mien.extract"
    bl_label = "Extract MPEG-4"

    def steps(self, context: bpy.types.Context) -> Steps:
        return tasks.extract(BlenderHost(context))


class MIEN_OT_rig(Command, bpy.types.Operator):
    """Bind the selected head to its feature points, as it is at the current frame"""
    bl_idname = "mien.rig"
    bl_label = "Rig from Feature Points"

    def steps(self, context: bpy.types.Context) -> Steps:
        return tasks.rig(BlenderHost(context))


class MIEN_OT_retarget(FileCommand, bpy.types.Operator):
    """Let the rigged head perform a capture (.trc, .csv or .c3d)"""
    bl_idname = "mien.retarget"
    bl_label = "Retarget a Take"
    filepath: bpy.props.StringProperty(subtype="FILE_PATH")
    filter_glob: bpy.props.StringProperty(default="*.trc;*.csv;*.c3d", options={"HIDDEN"})

    def steps(self, context: bpy.types.Context) -> Steps:
        return tasks.retarget(BlenderHost(context), self.chosen())


class MIEN_OT_import_fap(FileCommand, bpy.types.Operator):
    """Let the head play face animation parameters (.fap or .fba), by its table or its rig"""
    bl_idname = "mien.import_fap"
    bl_label = "Import FAP"
    filepath: bpy.props.StringProperty(subtype="FILE_PATH")
    filter_glob: bpy.props.StringProperty(default="*.fap;*.fba", options={"HIDDEN"})

    def steps(self, context: bpy.types.Context) -> Steps:
        return tasks.import_fap(BlenderHost(context), self.chosen())


class MIEN_OT_stop(bpy.types.Operator):
    """Stop the command that is running; nothing of it is kept"""
    bl_idname = "mien.stop"
    bl_label = "Stop"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return state(context).running

    def execute(self, context: bpy.types.Context) -> typing.Set[str]:
        state(context).cancel = True
        return {"FINISHED"}


CLASSES = (MIEN_OT_extract, MIEN_OT_rig, MIEN_OT_retarget, MIEN_OT_import_fap, MIEN_OT_stop)


def register() -> None:
    for kind in CLASSES:
        bpy.utils.register_class(kind)


def unregister() -> None:
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
