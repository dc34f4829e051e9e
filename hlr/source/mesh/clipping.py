"""Triangles clipped by a plane: those that reach beyond it end at it, and share the points there."""

from __future__ import annotations

import numpy as np

from hlr.common.types import Floats, Ints


def clipped(points: Floats, triangles: Ints, normal: Floats, heights: Floats, near: float) -> tuple[Floats, Ints]:
    """Points (n, 3) and triangles (m, 3) without what lies before a plane; where triangles are cut, points are added.

    normal (3,): of the plane; heights (n,): how far the points lie before it; near: what is no farther lies on it, and
    of the triangles on it those stay that look to where the normal points
    """
    heights = np.where(np.abs(heights) <= near, 0.0, heights)
    at = heights[triangles]
    above, below = at > 0.0, at < 0.0
    flat = triangles[~(above | below).any(axis=1)]
    a, b, c = points[flat].transpose(1, 0, 2)
    whole = triangles[~above.any(axis=1) & below.any(axis=1)]
    crossing = above.any(axis=1) & below.any(axis=1)
    corners, above = triangles[crossing], above[crossing]
    # Each is turned so that its first corner lies before the plane, and the last one does not.
    first = np.argmax(above & ~np.roll(above, 1, axis=1), axis=1)
    turn = (first[:, None] + np.arange(3)) % 3
    corners, above = np.take_along_axis(corners, turn, axis=1), np.take_along_axis(above, turn, axis=1)
    one, two = corners[~above[:, 1]], corners[above[:, 1]]
    sides = np.concatenate([one[:, [1, 0]], one[:, [2, 0]], two[:, [2, 1]], two[:, [2, 0]]])
    added, cut = _points_on(points, heights, sides)
    leaving, entering = cut[: len(one)], cut[len(one) : 2 * len(one)]
    ends = cut[2 * len(one) :].reshape(2, -1)
    made = np.concatenate(
        [
            np.stack([leaving, one[:, 1], one[:, 2]], axis=1),
            np.stack([leaving, one[:, 2], entering], axis=1),
            np.stack([ends[0], two[:, 2], ends[1]], axis=1),
        ]
    )
    # Of a triangle with a corner on the plane less is left.
    made = made[(made != np.roll(made, 1, axis=1)).all(axis=1)]
    left = np.concatenate([whole, flat[np.cross(b - a, c - a) @ normal > 0.0], made])
    return np.concatenate([points, added]), left.astype(triangles.dtype)


def _points_on(points: Floats, heights: Floats, sides: Ints) -> tuple[Floats, Ints]:
    """Points (k, 3) to add, and the number of that at which each side (n, 2) crosses the plane.

    sides: each from a point on or behind the plane to one before it; one that starts on the plane crosses it there
    """
    starts = heights[sides[:, 0]] < 0.0
    keys, number = np.unique(sides[starts], axis=0, return_inverse=True)
    low, high = heights[keys[:, 0]], heights[keys[:, 1]]
    share = (low / (low - high))[:, None]
    found = sides[:, 0].copy()
    found[starts] = len(points) + number.reshape(-1)
    return points[keys[:, 0]] + share * (points[keys[:, 1]] - points[keys[:, 0]]), found
