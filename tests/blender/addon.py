# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The add-on in real Blender: its zip is installed, enabled and used as a user would, without a window and with one.

usage: MIEN=build/release/mien addon.py [NAME OF A TEST...]
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import MIEN, ROOT


INSIDE = pathlib.Path(__file__).parent


def environment(folder):
    """A home and a place for temporary files of its own."""
    (folder / "tmp").mkdir(parents=True)
    # Debian's Blender takes the first Python of its version on the PATH for its own; another's has no NumPy.
    path = os.path.dirname(BLENDER) + os.pathsep + os.environ["PATH"]
    return {**os.environ, "HOME": str(folder), "TMPDIR": str(folder / "tmp"), "MIEN": str(MIEN), "PATH": path,
            "LIBGL_ALWAYS_SOFTWARE": "1"}


def without_window(archive, folder, chosen):
    return subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "-P", str(INSIDE / "addon_inside.py"),
                           "--", str(archive), str(folder), *chosen],
                          env=environment(folder), stdin=subprocess.DEVNULL, timeout=900).returncode


def with_window(archive, folder):
    """On a screen that nobody sees."""
    screen = shutil.which("xvfb-run")
    if not screen:
        print("a window: xvfb-run is not there, left out")
        return 0
    return subprocess.run([screen, "-a", "-s", "-screen 0 1280x800x24", BLENDER, "--factory-startup", "-P",
                           str(INSIDE / "addon_window.py"), "--", str(archive), str(folder)],
                          env=environment(folder), stdin=subprocess.DEVNULL, timeout=300).returncode


BLENDER = shutil.which("blender") or sys.exit("there is no blender on the PATH")
with tempfile.TemporaryDirectory() as work:
    archive = pathlib.Path(work) / "mien.zip"
    subprocess.run([sys.executable, "-B", str(ROOT / "blender" / "build_zip.py"), str(archive)], check=True)
    failed = without_window(archive, pathlib.Path(work) / "without", sys.argv[1:])
    failed |= 0 if sys.argv[1:] else with_window(archive, pathlib.Path(work) / "with")
    sys.exit(failed)
