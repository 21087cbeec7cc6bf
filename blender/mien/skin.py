# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The skin of a rig file: where its joints are and what they hold."""
import json
import struct
import typing

import numpy

from .mien_calling.program import MienError

KINDS = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"VEC3": 3, "VEC4": 4, "MAT4": 16}
JSON = 0x4E4F534A


class Skin(typing.NamedTuple):
    names: typing.List[str]
    places: numpy.ndarray  # joints x 3, y up
    joints: numpy.ndarray  # vertices x influences
    weights: numpy.ndarray  # the same


def _accessor(document: dict, binary: bytes, number: int) -> numpy.ndarray:
    accessor = document["accessors"][number]
    view = document["bufferViews"][accessor["bufferView"]]
    width, start = WIDTHS[accessor["type"]], view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    values = numpy.frombuffer(binary, KINDS[accessor["componentType"]], accessor["count"] * width, start)
    return values.reshape(-1, width)


def _sets(document: dict, binary: bytes, name: str) -> numpy.ndarray:
    """JOINTS or WEIGHTS of all vertices: primitives one after another, sets beside each other."""
    rows = []
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            numbers = sorted(key for key in primitive["attributes"] if key.startswith(name))
            rows.append(numpy.hstack([_accessor(document, binary, primitive["attributes"][key]) for key in numbers]))
    return numpy.vstack(rows)


def read_skin(path: str) -> Skin:
    """Of a file that mien rig wrote."""
    with open(path, "rb") as file:
        data = file.read()
    length, kind = struct.unpack_from("<II", data, 12)
    if kind != JSON:
        raise MienError(f"{path}: expected a rig that mien wrote, found something else")
    document, binary = json.loads(data[20:20 + length]), data[28 + length:]
    skin = document["skins"][0]
    inverse = _accessor(document, binary, skin["inverseBindMatrices"])  # column by column, without turns
    names = [document["nodes"][joint]["name"] for joint in skin["joints"]]
    return Skin(names, -inverse[:, 12:15], _sets(document, binary, "JOINTS_"), _sets(document, binary, "WEIGHTS_"))
