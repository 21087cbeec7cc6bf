# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""Runs inside Blender: imports a GLB and writes where its vertices are at given times.

usage: blender -b --factory-startup --python-exit-code 1 -P evaluate.py -- IN.glb OUT.json SECONDS...
OUT.json: a list per time of {"mesh name": [x, y, z, x, ...]} in glTF axes, vertices in Blender's order.
"""
import json
import sys

import numpy

# Debian's NumPy 1.24 has dropped names that Blender 3.4's importer still uses.
for name, kind in (("bool", bool), ("object", object), ("float", float), ("int", int)):
    if name not in numpy.__dict__:
        setattr(numpy, name, kind)

import bpy

FRAMES_PER_SECOND = 100  # any rate does: frames may be fractions


def positions(scene, seconds):
    frame = seconds * FRAMES_PER_SECOND
    scene.frame_set(int(frame // 1), subframe=frame % 1)
    graph = bpy.context.evaluated_depsgraph_get()
    found = {}
    for thing in scene.objects:
        # The importer adds a shape of its own to draw bones with.
        if thing.type != "MESH" or thing.name.startswith("Icosphere"):
            continue
        evaluated = thing.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        points = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
        mesh.vertices.foreach_get("co", points)
        matrix = numpy.array(evaluated.matrix_world)
        world = points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
        # Blender is z up: (x, y, z) there is (x, z, -y) in glTF.
        found[thing.data.name] = (world[:, [0, 2, 1]] * [1, 1, -1]).ravel().tolist()
        evaluated.to_mesh_clear()
    return found


source, target, *times = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
bpy.context.scene.render.fps = FRAMES_PER_SECOND
bpy.ops.import_scene.gltf(filepath=source, merge_vertices=False)
with open(target, "w", encoding="utf-8") as file:
    json.dump([positions(bpy.context.scene, float(seconds)) for seconds in times], file)
