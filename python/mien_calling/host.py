# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""What the commands ask of the program that they live in, Blender or Maya."""
import array
import typing

from .files import Faces

Mesh = typing.Any  # what the host knows a mesh by
Matrix = typing.Sequence[float]  # 4 x 4, row by row; it stands left of a column
Points = typing.Dict[str, int]


class Head(typing.NamedTuple):
    """Meshes that are one head; the program numbers their vertices through."""
    name: str
    meshes: typing.List[Mesh]
    first_vertices: typing.List[int]
    counts: typing.List[int]


class Timing(typing.NamedTuple):
    """When a cache plays: its first row at this frame, so many rows a frame."""
    first_frame: float
    rows: int
    rows_per_frame: float

    def last_frame(self) -> float:
        return self.first_frame + (self.rows - 1) / self.rows_per_frame


class Remembered(typing.NamedTuple):
    """A head, the rig or table that was made from it, and each mesh's way from the program's space to its own."""
    head: Head
    file: str
    spaces: typing.List[Matrix]


class Host(typing.Protocol):
    """The program's space is that of the scene, y up. What is wrong is a MienError that says what to do."""

    def program(self) -> str:
        """The path of mien."""

    def points_file(self) -> str:
        """The one that was chosen, or nothing: the points are named on the head."""

    def marker_map(self) -> str:
        """The one that was chosen, or nothing."""

    def folder(self) -> str:
        """Where the files of all heads are kept."""

    def frames(self) -> typing.Sequence[int]:
        """Of the scene."""

    def frames_per_second(self) -> float: ...

    def selected_head(self) -> Head: ...

    def named_points(self, head: Head) -> Points:
        """By their vertices among those of the head."""

    def reading(self, head: Head, at_rest: bool) -> typing.ContextManager[None]:
        """While it lasts the head has its own vertices and does not replay, nor do anything else that mien had it do if it
        is at rest; then all is as before, the frame too."""

    def show_frame(self, frame: int) -> None: ...

    def positions(self, head: Head) -> typing.List[array.array]:
        """Of the vertices of each mesh at this frame, while it is read, in the program's space."""

    def faces(self, mesh: Mesh) -> Faces: ...

    def mesh_name(self, mesh: Mesh) -> str:
        """As points files have it."""

    def spaces(self, head: Head) -> typing.List[Matrix]:
        """Each mesh's way from the program's space to its own at this frame."""

    def moved(self, values: array.array, matrix: Matrix) -> array.array:
        """x, y, z one after another, in another space."""

    def cache(self, folder: str, mesh: Mesh, count: int, timing: Timing) -> typing.ContextManager:
        """Something with row(values), into files of this folder that bear the mesh's name."""

    def perform(self, head: Head, folder: str, timing: Timing, is_replay: bool) -> None:
        """Lets every mesh play its cache of this folder, instead of the one before. A replay is of what was extracted."""

    def remember(self, kind: str, what: Remembered) -> None:
        """Leaves on the meshes that this rig or table (the kind) was made from them."""

    def remembered(self, kind: str) -> typing.Optional[Remembered]:
        """The rig or table of the active mesh, with all meshes that it was made from."""
