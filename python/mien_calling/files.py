# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The files between a host and the program: a head as OBJ, its motion and its performance as MDD, its points and reports as JSON.

Vertices are y up, as in glTF, and in the order of the host: the program keeps it.
"""
import array
import bisect
import json
import os
import struct
import sys
import typing

from .program import MienError

EVEN = 1e-3  # of a row: times of a cache are single precision
Faces = typing.Sequence[typing.Sequence[int]]


class Part(typing.NamedTuple):
    """One mesh of a head: x, y, z of its vertices one after another, and its faces by vertex numbers of its own."""
    name: str
    positions: typing.Sequence[float]
    faces: Faces


def write_obj(path: str, parts: typing.Sequence[Part]) -> None:
    """One group a part; the vertices of all parts are numbered through."""
    first = 1
    with open(path, "w", encoding="utf-8") as file:
        for part in parts:
            file.write(f"g {part.name}\n")
            values = iter(part.positions)
            file.writelines(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in zip(values, values, values))
            file.writelines("f " + " ".join(str(first + vertex) for vertex in face) + "\n" for face in part.faces)
            first += len(part.positions) // 3


def write_json(path: str, value: typing.Mapping[str, typing.Any]) -> None:
    with open(path, "w", encoding="utf-8") as file:
        json.dump(value, file, indent=1)


def _big_endian(values: array.array) -> bytes:
    swapped = array.array("f", values)
    if sys.byteorder == "little":
        swapped.byteswap()
    return swapped.tobytes()


class MddWriter:
    """An MDD point cache that is written row by row; rows are array("f") of x, y, z one after another."""

    def __init__(self, path: str, times: typing.Sequence[float], vertices: int):
        self._file = open(path, "wb")
        self._file.write(struct.pack(">ii", len(times), vertices) + _big_endian(array.array("f", times)))
        self._values = 3 * vertices

    def row(self, values: array.array) -> None:
        if len(values) != self._values:
            raise MienError(f"expected {self._values // 3} vertices in every frame, found {len(values) // 3}")
        self._file.write(_big_endian(values))

    def __enter__(self) -> "MddWriter":
        return self

    def __exit__(self, *_) -> None:
        self._file.close()


class MddReader:
    """An MDD point cache that the program wrote, read row by row."""

    def __init__(self, path: str):
        self._file = open(path, "rb")
        head = self._file.read(8)
        self.rows, self.vertices = struct.unpack(">ii", head) if len(head) == 8 else (0, 0)
        self.times = self._floats(self.rows)
        if os.path.getsize(path) != 8 + 4 * self.rows + 12 * self.rows * self.vertices:
            self._file.close()
            raise MienError(f"{path}: this point cache is cut")

    def _floats(self, count: int) -> array.array:
        values = array.array("f", self._file.read(4 * count))
        if sys.byteorder == "little":
            values.byteswap()
        return values

    def row(self, number: int) -> array.array:
        self._file.seek(8 + 4 * self.rows + 12 * self.vertices * number)
        return self._floats(3 * self.vertices)

    def rows_per_second(self) -> float:
        """On average; 1 for a cache of a single row."""
        span = self.times[-1] - self.times[0] if self.rows > 1 else 0
        return (self.rows - 1) / span if span > 0 else 1

    def even_row(self, number: int) -> array.array:
        """The row that would be here if rows were evenly spaced, as hosts play them: between its neighbours in time."""
        place = self.times[0] + number / self.rows_per_second()
        after = min(bisect.bisect_left(self.times, place), self.rows - 1)
        for near in (max(after - 1, 0), after):
            if abs(self.times[near] - place) * self.rows_per_second() < EVEN:
                return self.row(near)
        low, high = self.row(after - 1), self.row(after)
        share = (place - self.times[after - 1]) / (self.times[after] - self.times[after - 1])
        return array.array("f", (x + share * (y - x) for x, y in zip(low, high)))

    def __enter__(self) -> "MddReader":
        return self

    def __exit__(self, *_) -> None:
        self._file.close()
