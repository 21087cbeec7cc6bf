# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The layout of every C++ file is what clang-format 14 makes of it.

usage: layout_is_clang_format.py ROOT
Exit status 77 (skipped) where clang-format-14 is not installed; ./check installs it.
"""
import re
import shutil
import subprocess
import sys

import rule

TOOL = "clang-format-14"


def complaints(root):
    seen = rule.files(root)
    done = subprocess.run([TOOL, "--dry-run", *map(str, seen)], cwd=root, stderr=subprocess.PIPE, text=True)
    wrong = sorted(set(re.findall(r"^(.*?):\d+:\d+: ", done.stderr, re.MULTILINE)))
    return seen, [f"{path}: run {TOOL} -i on it" for path in wrong]


if __name__ == "__main__":
    if shutil.which(TOOL) is None:
        print(f"{TOOL} is not installed: layout not checked")
        sys.exit(77)
    rule.main(complaints)
