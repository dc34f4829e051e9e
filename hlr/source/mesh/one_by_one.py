"""The bodies of a closed mesh, each with its hollows."""

from __future__ import annotations

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
    holder = np.arange(count)
    for k in np.flatnonzero(volumes <= 0.0).tolist():
        around = (volumes > 0.0) & (low <= low[k]).all(axis=1) & (high >= high[k]).all(axis=1)
        # Boxes do not tell which of several it is: the smallest that has room for it.
        smallest = int(np.argmin(np.where(around, volumes, np.inf)))
        if not around[smallest] or volumes[smallest] + volumes[k] <= 0.0:
            return np.zeros(len(triangles), np.int64)
        holder[k] = smallest
    return np.asarray(np.unique(holder[number], return_inverse=True)[1], np.int64).reshape(-1)


def one_by_one(triangles: Ints, number: npt.NDArray[np.int64]) -> list[Ints]:
    """The triangles (k, 3) of each body. triangles (m, 3); number (m,): as of `body_numbers`."""
    order = np.argsort(number, kind="stable")
    return np.split(triangles[order], np.flatnonzero(np.diff(number[order])) + 1)
