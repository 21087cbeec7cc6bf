# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Runs inside a Blender with a window: commands beside a live interface, told by the panel, stopped half way.

usage: blender --factory-startup -P addon_window.py -- MIEN.zip FOLDER
Ends Blender with status 0 when all is well.
"""
import os
import pathlib
import sys
import time
import traceback

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import HEAD, MIEN, POINTS

for name, kind in (("bool", bool), ("object", object), ("float", float), ("int", int)):
    if name not in numpy.__dict__:
        setattr(numpy, name, kind)

ARCHIVE, FOLDER = sys.argv[sys.argv.index("--") + 1:]
FOLDER = pathlib.Path(FOLDER)
# Tells its progress and then never ends.
ENDLESS = """#!/bin/sh
echo $$ > {pid}
printf '\\r\\033[Kbending the sheet [###       ] 3 of 10' >&2
exec sleep 600
"""


def told():
    return bpy.context.window_manager.mien


def is_alive(process):
    try:
        os.kill(process, 0)
    except OSError:
        return False
    return True


def until(condition, what, seconds=60):
    """Steps until the condition holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"{what}: not within {seconds} s; told {told().message!r}"
        yield


def started(command):
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window, screen=window.screen):
        assert command("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    assert told().running and not bpy.ops.mien.rig.poll()


def script():
    bpy.ops.preferences.addon_install(filepath=ARCHIVE)
    bpy.ops.preferences.addon_enable(module="mien")
    preferences = bpy.context.preferences.addons["mien"].preferences
    preferences.program = str(MIEN)
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.wm.save_as_mainfile(filepath=str(FOLDER / "scene.blend"))
    bpy.ops.import_scene.gltf(filepath=str(HEAD))
    bpy.ops.object.select_by_type(type="MESH")
    bpy.context.view_layer.objects.active = next(t for t in bpy.context.scene.objects if t.data and t.data.name == "head")
    bpy.context.scene.mien.points = str(POINTS)

    started(bpy.ops.mien.rig)
    yield from until(lambda: not told().running, "rigging")
    assert "rigged by" in told().message and not told().is_error, told().message
    assert (FOLDER / "mien" / "head" / "rig.glb").is_file()

    before = sorted(FOLDER.rglob("*"))  # with the folder for temporary files
    program, pid = FOLDER / "endless", FOLDER / "pid"
    program.write_text(ENDLESS.format(pid=pid), encoding="utf-8")
    program.chmod(0o755)
    preferences.program = str(program)
    started(bpy.ops.mien.rig)
    yield from until(lambda: told().message == "bending the sheet", "progress")
    assert abs(told().share - 30) < 1e-3, told().share
    process = int(pid.read_text(encoding="utf-8"))
    assert is_alive(process)
    bpy.ops.mien.stop()
    yield from until(lambda: not told().running, "stopping")
    assert told().message.startswith("Stopped"), told().message
    assert not is_alive(process)
    pid.unlink()
    program.unlink()
    assert sorted(FOLDER.rglob("*")) == before, "a command that was stopped leaves something behind"

    started(bpy.ops.mien.rig)
    yield from until(lambda: not told().running, "refusing")
    assert told().is_error and "There is no program at" in told().message, told().message


def tick(steps):
    try:
        next(steps)
        return 0.1
    except StopIteration:
        print("a window: rigging beside the interface, progress, stop and refusal are well", flush=True)
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)


steps = script()
bpy.app.timers.register(lambda: tick(steps), first_interval=1)
