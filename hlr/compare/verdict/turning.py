"""Where the surface of a mesh turns away from the viewer.

A face that is seen from its edge, such as a wall from above, has triangles that turn neither way for certain. There the
surface turns where, at one place of the drawing, the face has a neighbour toward the viewer on one of its sides and one
away from him on the other. Where both turn the same way, as at a step of a smooth slope, there is no outline.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats
from hlr.drawing.chords import numbered
from hlr.scene.scene import Scene

Bools = npt.NDArray[np.bool_]
Signs = npt.NDArray[np.int8]
Numbers = npt.NDArray[np.int64]

_CELL = 5.0
"""Errors of the mesh: both sides of a face that is seen from its edge lie at one place within two cells."""


_MOST_POINTS = 200_000.0
"""Of all segments: where they are so long that there would be more, as of a hall at full size, cells are larger."""


def cell_mm(segments: Sequence[Floats], error_mm: float) -> float:
    """How wide cells are for segments, each (k, 2, 2)."""
    length = sum(float(np.hypot(*(each[:, 1] - each[:, 0]).T).sum()) for each in segments)
    return max(_CELL * error_mm, length / _MOST_POINTS)


def turning_edges(scene: Scene, image: Floats, error_mm: float) -> Bools:
    """(m,) whether the surface turns at each edge: toward the viewer on one side of it, away from him on the other.

    image     (n, 3) millimetres, z toward the viewer
    error_mm  how far triangles may lie off the surface; one that is not wider turns neither way for certain
    """
    sign = _signs(image[scene.triangles][:, :, :2], error_mm)
    two = np.flatnonzero(np.diff(scene.offsets) == 2)
    first = scene.offsets[two]
    one, other = sign[scene.incident[first]], sign[scene.incident[first + 1]]
    turns = np.zeros(len(scene.offsets) - 1, bool)
    turns[two] = one * other < 0
    beside = (one == 0) != (other == 0)
    borders, side = two[beside], (one + other)[beside]
    toward, away = borders[side > 0], borders[side < 0]
    segments = [image[scene.edges[each]][:, :, :2] for each in (toward, away)]
    size = cell_mm(segments, error_mm)
    cells = [_Cells(each, size) for each in segments]
    turns[toward], turns[away] = cells[0].mostly_in(cells[1]), cells[1].mostly_in(cells[0])
    return turns


def _signs(corners: Floats, error_mm: float) -> Signs:
    """1: a triangle (t, 3, 2) faces the viewer; -1: it does not; 0: it is seen from its edge."""
    sides = np.roll(corners, -1, axis=1) - corners
    area = sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]
    wide = np.abs(area) > error_mm * np.sqrt((sides**2).sum(axis=2).max(axis=1))
    return np.where(wide, np.sign(area), 0.0).astype(np.int8)


class _Cells:
    """The square cells through which segments (k, 2, 2) run, `size` millimetres wide."""

    def __init__(self, segments: Floats, size: float) -> None:
        way = segments[:, 1] - segments[:, 0]
        count = np.ceil(np.hypot(*way.T) / size).astype(np.int64) + 1
        self.segment, number = numbered(count)
        share = (number / np.maximum(count[self.segment] - 1, 1))[:, None]
        self.cell = np.floor((segments[self.segment, 0] + share * way[self.segment]) / size).astype(np.int64)
        self.points = count

    def mostly_in(self, others: _Cells) -> Bools:
        """(k,) whether half of the points of each segment lie in a cell of the others, or beside one."""
        wanted = np.unique(_number(others.cell))
        near = np.zeros(len(self.cell), bool)
        for step in itertools.product((-1, 0, 1), repeat=2):
            near |= np.isin(_number(self.cell + np.array(step)), wanted)
        hits = np.bincount(self.segment, near, minlength=len(self.points))
        return np.asarray(2.0 * hits >= self.points)


def _number(cell: Numbers) -> Numbers:
    return np.asarray(cell[:, 0] * (1 << 31) + cell[:, 1])
