# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Rooms include the nouns and themselves, never each other, and nothing includes a front.

usage: includes_point_inward.py ROOT
"""
import re
import rule

ROOMS = ("algorithms", "io", "live", "render", "draw")
FRONTS = ("cli", "python", "studio", "blender")
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)


def room_of(path):
    """The room a file or an included name belongs to: a room, "nouns", or nothing for the outside world."""
    parts = path.split("/")
    if parts[0] == "include":
        parts = parts[1:]
    if parts[0] == "src":
        parts = ["mien"] + parts[1:]
    if parts[0] != "mien":
        return None
    return parts[1] if len(parts) > 2 and parts[1] in ROOMS else "nouns"


def included_room(room, name):
    """An include without a room in its name means the file's own folder (src/io/text.hpp as "text.hpp")."""
    parts = name.split("/")
    if parts[0] in ROOMS:
        return parts[0]
    return room_of(name) or room


def complaints(root):
    seen = rule.files(root, folders=("include", "src"))
    sentences = []
    for path in seen:
        room = room_of(path.as_posix())
        for name in INCLUDE.findall((root / path).read_text(encoding="utf-8")):
            if any(part in FRONTS for part in name.split("/")[:-1]):
                sentences.append(f"{path}: includes {name}, but the library knows no front")
                continue
            other = included_room(room, name)
            if other not in (room, "nouns"):
                sentences.append(f"{path}: {room} includes {name}; allowed are nouns (mien/*.hpp) and {room} itself")
    return seen, sentences


if __name__ == "__main__":
    rule.main(complaints)
