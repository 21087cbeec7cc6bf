# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Every public header compiles as the only thing a file includes.

usage: headers_compile_alone.py ROOT COMPILER WORK_FOLDER
"""
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys

import rule

FLAGS = ("-std=c++20", "-O0", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wno-sign-conversion",
         "-Werror")


def compile_alone(root, compiler, work, path):
    """What the compiler says about a file that includes nothing else; ccache, where it is, remembers its answers."""
    name = path.relative_to("include").as_posix()
    source = work / (name.replace("/", "_") + ".cpp")
    source.write_text(f'#include "{name}"\n', encoding="utf-8")
    command = [compiler, *FLAGS, "-I", str(root / "include"), "-c", str(source), "-o", str(source.with_suffix(".o"))]
    done = subprocess.run(([shutil.which("ccache")] if shutil.which("ccache") else []) + command,
                          capture_output=True, text=True)
    return f"{path} does not compile alone:\n{done.stderr}" if done.returncode else None


def complaints(root, compiler=None, work=None):
    compiler = compiler or sys.argv[2]
    work = pathlib.Path(work or sys.argv[3]).resolve()
    work.mkdir(parents=True, exist_ok=True)
    seen = rule.files(root, ("*.hpp",), ("include",))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = pool.map(lambda path: compile_alone(root.resolve(), compiler, work, path), seen)
    return seen, [sentence for sentence in found if sentence]


if __name__ == "__main__":
    rule.main(complaints, "public headers")
