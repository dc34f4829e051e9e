"""What keeps a mesh from being closed though its surface is: mended before it is cut, as it would be drawn.

Triangles that are listed twice, borders that run along one another with other corners, triangles that are turned over.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.source.mesh.duplicate_triangles import unique_triangles

MAX_GAP_SHARE = 5e-5
"""Of a part's extent, at most: exporters state no tolerance. 0.01 mm of a part of 200 mm, by which CAD programs let the
ends of edges miss one another. Of a mesh made face by face the gaps end well below, and up to twice that no new are
found; what lies farther apart is a gap of the model's own."""


def mended(points: Floats, triangles: Ints) -> Ints:
    """Triangles (k, 3) of the same surface as triangles (m, 3), among the same points (n, 3), without these faults."""
    face = np.zeros(len(triangles), np.int32)
    once = np.ascontiguousarray(triangles[unique_triangles(points, triangles, face)])
    joined, _, _ = _kernel.stitched(points, once, MAX_GAP_SHARE * float(np.ptp(points, axis=0).max()))
    return turned_alike(joined, len(points))


def turned_alike(triangles: Ints, count: int) -> Ints:
    """The triangles (m, 3) of points, `count` in number, turned as most are that they are connected to.

    Only edges with two triangles connect. What has but one side, as a band of Moebius, stays as it is.
    """
    own = np.arange(len(triangles), dtype=np.int32)
    one, other, reverse = _neighbours(triangles, count)
    # Each triangle stands for two, one turned over, and is connected to those beside it that run as it does.
    first = np.concatenate([one, one + len(own)])
    second = np.where(reverse, other + len(own), other)
    second = np.concatenate([second, (second + len(own)) % (2 * len(own))])
    alone = np.arange(2 * len(own), dtype=np.int32)
    graph = np.concatenate([np.stack([first, second], axis=1), np.stack([alone, alone], axis=1)]).astype(np.int32)
    sheet = np.zeros(2 * len(own), np.int64)
    sheet[graph[:, 0]] = _kernel.edge_components(np.ascontiguousarray(graph), 2 * len(own))
    mine, turned = sheet[: len(own)], sheet[len(own) :]
    given = np.bincount(mine, minlength=int(sheet.max(initial=-1)) + 1)
    turn = given[turned] > given[mine]
    turn |= (given[turned] == given[mine]) & (turned < mine)
    return np.ascontiguousarray(np.where(turn[:, None], triangles[:, ::-1], triangles))


def _neighbours(triangles: Ints, count: int) -> tuple[Ints, Ints, npt.NDArray[np.bool_]]:
    """Of each edge with two triangles: one of them, the other one, and whether they run alike along it."""
    start, end = triangles.ravel().astype(np.int64), np.roll(triangles, -1, axis=1).ravel().astype(np.int64)
    _, edge, uses = np.unique(
        np.minimum(start, end) * count + np.maximum(start, end), return_inverse=True, return_counts=True
    )
    sides = np.argsort(edge, kind="stable")
    pairs = sides[(uses == 2)[edge[sides]]].reshape(-1, 2)
    beside = (pairs // 3).astype(np.int32)
    along = (start < end)[pairs]
    return beside[:, 0], beside[:, 1], np.asarray(along[:, 0] == along[:, 1])
