#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Blender plays what mien wrote: its vertices are where mien says, within the error that mien printed.

usage: MIEN=build/release/mien compare.py
For each performance a GLB and an MDD are written from the same rig and take. Blender imports the GLB; at the first row,
the one that moves most and the last, its evaluated vertices are held against the MDD, which has the exact rig. They may
differ by what the cut to a few joints per vertex costs, which `mien --json` printed, and by rounding (1e-5 of the size).
"""
import array
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import HEAD, MAP, POINTS, SHARED, TAKE, read_mdd, run

ROUNDING = 1e-5


def read_glb(path):
    """The JSON and the binary chunk."""
    data = path.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def indices(document, binary, primitive):
    if "indices" not in primitive:
        return range(document["accessors"][primitive["attributes"]["POSITION"]]["count"])
    accessor = document["accessors"][primitive["indices"]]
    view = document["bufferViews"][accessor["bufferView"]]
    kind = {5121: "B", 5123: "H", 5125: "I"}[accessor["componentType"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return array.array(kind, binary[start:start + accessor["count"] * struct.calcsize(kind)])


def vertices_of_meshes(document, binary):
    """Mesh name -> the rows of the point cache that Blender keeps, in its order: those that a face uses, by primitive.

    Primitives that share one vertex list are read by Blender once; mien's files give each its own.
    """
    found, first = {}, 0
    for mesh in document["meshes"]:
        kept = []
        for primitive in mesh["primitives"]:
            kept += [first + index for index in sorted(set(indices(document, binary, primitive)))]
            first += document["accessors"][primitive["attributes"]["POSITION"]]["count"]
        found[mesh["name"]] = kept
    if len(found) != len(document["meshes"]):
        sys.exit("two meshes have one name: Blender's objects cannot be told apart")
    return found, first


def evaluate(glb, times, folder):
    target = folder / "evaluated.json"
    program = shutil.which("blender") or sys.exit("there is no blender on the PATH")
    # Debian's Blender takes the first Python of its version on the PATH for its own; another's has no NumPy.
    path = os.path.dirname(program) + os.pathsep + os.environ["PATH"]
    done = subprocess.run(
        [program, "-b", "--factory-startup", "--python-exit-code", "1", "-P",
         str(pathlib.Path(__file__).with_name("evaluate.py")), "--", str(glb), str(target), *map(repr, times)],
        env={**os.environ, "HOME": str(folder), "PATH": path}, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600)
    if done.returncode:
        sys.exit(f"Blender failed on {glb}:\n{done.stdout}\n{done.stderr}")
    return json.loads(target.read_text(encoding="utf-8"))


def largest_distance(evaluated, exact, meshes):
    if set(evaluated) != set(meshes):
        sys.exit(f"Blender has the meshes {sorted(evaluated)}, the file {sorted(meshes)}")
    worst = 0.0
    for name, kept in meshes.items():
        points = evaluated[name]
        if len(points) != 3 * len(kept):
            sys.exit(f"{name}: Blender has {len(points) // 3} vertices, expected {len(kept)}")
        worst = max([worst, *(math.dist(points[3 * i:3 * i + 3], exact[3 * v:3 * v + 3])
                              for i, v in enumerate(kept))])
    return worst


def write(command, output):
    result = run(*command, "-o", output, "--json")
    if result.returncode:
        sys.exit(f"mien {command[0]}: {result.stderr}")
    return json.loads(result.stdout)


def largest_motion(positions, neutral):
    """Of any tenth vertex, which is enough to choose a row by."""
    return max(math.dist(positions[i:i + 3], neutral[i:i + 3]) for i in range(0, len(neutral), 30))


def compare(name, command, folder):
    glb, mdd = folder / f"{name}.glb", folder / f"{name}.mdd"
    allowed = write(command, glb)["influence_cut"]["max_error"]
    write(command, mdd)
    times, exact = read_mdd(mdd)
    meshes, vertices = vertices_of_meshes(*read_glb(glb))
    if len(exact[0]) != 3 * vertices:
        sys.exit(f"{name}: {len(exact[0]) // 3} vertices in the point cache, {vertices} in the GLB")
    size = max(exact[0]) - min(exact[0])
    motion = [largest_motion(positions, exact[0]) for positions in exact]
    moved = max(motion)
    rows = [0, motion.index(moved), len(times) - 1]
    agreed = True
    for row, evaluated in zip(rows, evaluate(glb, [times[row] for row in rows], folder)):
        worst = largest_distance(evaluated, exact[row], meshes)
        agreed &= worst <= allowed + ROUNDING * size
        print(f"{name}, row {row}: Blender differs by {worst:.3g} at most, mien printed {allowed:.3g} "
              f"(size {size:.3g}, moved {moved:.3g})")
    if moved <= allowed:
        print(f"{name}: moves less than the error that is allowed, which shows nothing")
    return agreed and moved > allowed


def performances(folder):
    """(name, the mien command without its output)"""
    def animate(head, points, take, names):
        return "animate", head, "--points", points, "--take", take, "--map", names

    yield "sample", animate(HEAD, POINTS, TAKE, MAP)
    rig, onto = folder / "rig.glb", folder / "onto.csv"
    write(("rig", HEAD, "--points", POINTS), rig)
    write(("retarget", TAKE, "--rig", rig, "--map", MAP), onto)
    yield "sample-deform", ("deform", rig, onto)
    if SHARED.is_dir():
        head, capture = SHARED / "mh-caucasian", SHARED / "markers-41"
        yield "caucasian", animate(head / "mh-caucasian-female.glb", head / "points-glb.json", capture / "jaw.trc",
                                   capture / "markers-to-fdp.json")


with tempfile.TemporaryDirectory() as work:
    verdicts = [compare(name, command, pathlib.Path(work)) for name, command in performances(pathlib.Path(work))]
    print(f"Blender agrees on {sum(verdicts)} of {len(verdicts)} performances")
    sys.exit(0 if all(verdicts) else 1)
