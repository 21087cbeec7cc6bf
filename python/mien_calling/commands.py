# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The four commands that fronts offer, as calls of the program: steps whose value is the program's report."""
import os

from .program import Steps, running


def extract(program: str, head: str, motion: str, points: str, rate: float, folder: str) -> Steps:
    """FDP, FAPU, FAP and FAT of a head and its motion, into a folder that is not there yet."""
    return running(program, ["extract", motion, "--head", head, "--points", points, "--fps", f"{rate:.9g}", "-o", folder])


def rig(program: str, head: str, points: str, output: str) -> Steps:
    """The head bound to its feature points."""
    return running(program, ["rig", head, "--points", points, "-o", output])


def play(program: str, player: str, faps: str, output: str) -> Steps:
    """Face animation parameters on a rig (.glb) or a face animation table (.fat)."""
    return running(program, ["play", player, faps, "-o", output])


def perform(program: str, take: str, marker_map: str, rig_file: str, output: str) -> Steps:
    """A performer's take on a rig. The value is the report of the retargeting."""
    onto = os.path.join(os.path.dirname(output), "onto.csv")
    names = ["--map", marker_map] if marker_map else []
    report = yield from running(program, ["retarget", take, "--rig", rig_file, *names, "-o", onto])
    yield from running(program, ["deform", rig_file, onto, "-o", output])
    return report


def stem(path: str) -> str:
    """The name of a file without its ending: what a performance is called."""
    return os.path.splitext(os.path.basename(path))[0]


