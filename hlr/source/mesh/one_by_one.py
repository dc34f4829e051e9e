"""The bodies of a closed mesh, each with its hollows."""

from __future__ import annotations

from itertools import islice

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.source.mesh.closed import bodies


def body_numbers(points: Floats, triangles: Ints) -> npt.NDArray[np.int64]:
    """(m,) of which body each of triangles (m, 3) of points (n, 3) is, by numbers from 0; a hollow is of that around.

    All have one number where it cannot be told which body that is.
    """
    number = bodies(triangles, len(points))
    count = int(number.max(initial=-1)) + 1
    corners = points[triangles]
    a, b, c = corners.transpose(1, 0, 2)
    volumes = np.bincount(number, (np.cross(a, b) * c).sum(axis=1), count)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, number, corners.min(axis=1))
    np.maximum.at(high, number, corners.max(axis=1))
    hollows = np.flatnonzero(volumes <= 0.0)
    if not len(hollows):
        return number
    order = np.argsort(number, kind="stable")
    ends = np.searchsorted(number[order], np.arange(count + 1))
    # The smallest that is around a hollow has it.
    solids = np.argsort(volumes, kind="stable")[len(hollows) :]
    lows, highs = low[solids].T.copy(), high[solids].T.copy()
    holder = np.arange(count)

    def holds(body: int, place: Floats) -> bool:
        return _is_around(corners[order[ends[body] : ends[body + 1]]], place)

    for k in hollows.tolist():
        has_room = volumes[solids] + volumes[k] > 0.0
        for axis in range(3):
            has_room &= (lows[axis] <= low[k, axis]) & (highs[axis] >= high[k, axis])
        around = solids[has_room].tolist()
        if len(around) > 1:
            # Their boxes do not tell which of them it is: a ring has none of what stands in its middle.
            place = corners[order[ends[k]]].mean(axis=0)
            around = list(islice((n for n in around if holds(n, place)), 1))
        if not around:
            return np.zeros(len(triangles), np.int64)
        (holder[k],) = around
    return np.asarray(np.unique(holder[number], return_inverse=True)[1], np.int64).reshape(-1)


def one_by_one(triangles: Ints, number: npt.NDArray[np.int64]) -> list[Ints]:
    """The triangles (k, 3) of each body. triangles (m, 3); number (m,): as of `body_numbers`."""
    order = np.argsort(number, kind="stable")
    return np.split(triangles[order], np.flatnonzero(np.diff(number[order])) + 1)


def _is_around(corners: Floats, place: Floats) -> bool:
    """Whether a place (3,) lies within the closed surface of triangles (m, 3, 3).

    A ray upward leaves it once more than it enters it.
    """
    x, y, z = place
    ends = corners[..., :2]
    near = (ends.min(axis=1) <= (x, y)).all(axis=1) & (ends.max(axis=1) >= (x, y)).all(axis=1)
    near &= corners[..., 2].max(axis=1) >= z
    found = corners[near]
    start, end = found, np.roll(found, -1, axis=1)
    # Both triangles at a side find it in the same place, and a corner on the ray counts once.
    swap = (start[..., 1] > end[..., 1])[..., None]
    under, over = np.where(swap, end, start), np.where(swap, start, end)
    beside = (under[..., 1] <= y) & (over[..., 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (y - under[..., 1]) / (over[..., 1] - under[..., 1])
        beside &= under[..., 0] + share * (over[..., 0] - under[..., 0]) > x
    hit = found[beside.sum(axis=1) % 2 == 1]
    normal = np.cross(hit[:, 1] - hit[:, 0], hit[:, 2] - hit[:, 0])
    above = ((hit[:, 0] - place) * normal).sum(axis=1) * normal[:, 2] > 0.0
    return bool(np.sign(normal[above, 2]).sum() > 0.0)
