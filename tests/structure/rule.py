# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What every rule over the tree shares: which files there are, and how complaints are told."""
import pathlib
import sys

SOURCE = ("*.cpp", "*.hpp")
FOLDERS = ("include", "src", "cli", "tests", "samples", "fuzz", "bench", "examples", "python", "blender", "maya")


def files(root, patterns=SOURCE, folders=FOLDERS):
    """The files of the tree that match, as paths relative to `root`."""
    root = pathlib.Path(root)
    found = [path.relative_to(root) for folder in folders for pattern in patterns
             for path in (root / folder).rglob(pattern)]
    return sorted(path for path in found if "build" not in path.parts)


def main(complaints, checked="files"):
    """Runs a rule, `complaints(root) -> (what was checked, sentences)`, as a test: a rule with nothing to check fails."""
    seen, sentences = complaints(pathlib.Path(sys.argv[1]))
    for sentence in sentences:
        print(sentence)
    print(f"{len(seen)} {checked} checked, {len(sentences)} complaints")
    sys.exit(1 if sentences or not seen else 0)
