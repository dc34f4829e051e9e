"""Triangles clipped by planes: those that reach beyond one are split at it, and share the points there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.source.stepped import Stepped


@dataclass(frozen=True, slots=True, eq=False)
class Split:
    """Triangles of which none crosses a plane any more.

    points (n, 3), triangles (m, 3); of (m,): which of the triangles before each is, or is a piece of
    """

    points: Floats
    triangles: Ints
    of: npt.NDArray[np.int64]

    def at(self, normal: Floats, level: float, near: float) -> Split:
        """Split at one more plane: what is no farther from it than `near` lies on it."""
        heights = self.points @ normal - level
        sides = np.where(np.abs(heights) <= near, 0, np.sign(heights)).astype(int)[self.triangles]
        crossing = (sides > 0).any(axis=1) & (sides < 0).any(axis=1)
        if not crossing.any():
            return self
        corners, sides = self.triangles[crossing], sides[crossing]
        # Each is turned so that its first corner is alone on its side.
        alone = (sides != 0) & (sides != np.roll(sides, 1, axis=1)) & (sides != np.roll(sides, -1, axis=1))
        turn = (np.argmax(alone, axis=1)[:, None] + np.arange(3)) % 3
        corners, sides = np.take_along_axis(corners, turn, axis=1), np.take_along_axis(sides, turn, axis=1)
        first, second, third = corners.T
        added, (leaving, entering) = _points_on(self.points, heights, first, corners[:, 1:].T, sides[:, 1:].T)
        made = np.concatenate(
            [
                np.stack([first, leaving, entering], axis=1),
                np.stack([leaving, second, third], axis=1),
                np.stack([leaving, third, entering], axis=1),
            ]
        )
        # Of a triangle with a corner on the plane there are two.
        real = (made != np.roll(made, 1, axis=1)).all(axis=1)
        triangles = np.concatenate([self.triangles[~crossing], made[real]])
        of = np.concatenate([self.of[~crossing], np.tile(self.of[crossing], 3)[real]])
        return Split(np.concatenate([self.points, added]), triangles, of)


def split_at(points: Floats, triangles: Ints, planes: Stepped, near: float, levels: bool = True) -> Split:
    """Points (n, 3) and triangles (m, 3) split at steps, and at the levels of planes unless only at the steps.

    near: what is no farther from a plane lies on it
    """
    found = Split(points, triangles, np.arange(len(triangles), dtype=np.int64))
    for step in planes.steps.tolist():
        found = found.at(planes.along, step, near)
    for level in np.unique(planes.levels).tolist() if levels else ():
        found = found.at(planes.normal, level, near)
    return found


def clipped(points: Floats, triangles: Ints, planes: Stepped, near: float) -> tuple[Floats, Ints]:
    """Points (n, 3) and triangles (m, 3) without what lies before planes; where triangles are cut, points are added.

    near: what is no farther from a plane lies on it, and of the triangles on it those stay that look to the viewer
    """
    found = split_at(points, triangles, planes, near)
    corners = found.points[found.triangles]
    heights = planes.heights(corners.mean(axis=1))
    on_plane = np.abs(heights) <= near
    a, b, c = corners.transpose(1, 0, 2)
    looks = np.cross(b - a, c - a) @ planes.normal > 0.0
    return found.points, found.triangles[np.where(on_plane, looks, heights < 0.0)]


def _points_on(points: Floats, heights: Floats, first: Ints, others: Ints, sides: Ints) -> tuple[Floats, Ints]:
    """Points (k, 3) to add, and the numbers (2, n) of those at which two sides of each triangle cross the plane.

    first (n,), others (2, n): the ends of the sides; sides (2, n): where the latter lie, 0 on the plane
    """
    ends = np.stack([np.broadcast_to(first, others.shape), others], axis=-1)
    crossing = sides != 0
    # The lower number comes first, so that all triangles of an edge find the same point.
    keys, number = np.unique(np.sort(ends[crossing], axis=1), axis=0, return_inverse=True)
    a, b = heights[keys[:, 0]], heights[keys[:, 1]]
    found: Ints = others.astype(np.int32)
    found[crossing] = len(points) + number.reshape(-1)
    return points[keys[:, 0]] + (a / (a - b))[:, None] * (points[keys[:, 1]] - points[keys[:, 0]]), found
