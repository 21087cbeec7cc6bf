# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The add-on in real Blender: its zip is installed, enabled and used as a user would, without a window.

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


def main():
    program = shutil.which("blender") or sys.exit("there is no blender on the PATH")
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        archive, temporary = folder / "mien.zip", folder / "tmp"
        temporary.mkdir()
        subprocess.run([sys.executable, "-B", str(ROOT / "blender" / "build_zip.py"), str(archive)], check=True)
        # Debian's Blender takes the first Python of its version on the PATH for its own; another's has no NumPy.
        environment = {**os.environ, "HOME": work, "TMPDIR": str(temporary), "MIEN": str(MIEN),
                       "PATH": os.path.dirname(program) + os.pathsep + os.environ["PATH"]}
        done = subprocess.run([program, "-b", "--factory-startup", "--python-exit-code", "1", "-P",
                               str(pathlib.Path(__file__).with_name("addon_inside.py")), "--", str(archive), work, *sys.argv[1:]],
                              env=environment, stdin=subprocess.DEVNULL, timeout=900)
    sys.exit(done.returncode)


main()
