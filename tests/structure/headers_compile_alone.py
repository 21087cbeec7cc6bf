# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Every public header compiles as the only thing a file includes.

usage: headers_compile_alone.py ROOT COMPILER
"""
import concurrent.futures
import os
import subprocess
import sys

import rule


def compile_alone(root, compiler, path):
    name = path.relative_to("include").as_posix()
    done = subprocess.run(
        [compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion",
         "-Wno-sign-conversion", "-Werror", "-I", str(root / "include"), "-x", "c++", "-"],
        input=f'#include "{name}"\n', capture_output=True, text=True)
    return f"{path} does not compile alone:\n{done.stderr}" if done.returncode else None


def complaints(root, compiler=None):
    compiler = compiler or sys.argv[2]
    seen = rule.files(root, ("*.hpp",), ("include",))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = pool.map(lambda path: compile_alone(root, compiler, path), seen)
    return seen, [sentence for sentence in found if sentence]


if __name__ == "__main__":
    rule.main(complaints, "public headers")
