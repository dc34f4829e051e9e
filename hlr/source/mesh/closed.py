"""Which bodies of a triangle mesh are closed."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Ints


def bodies(triangles: Ints, count: int) -> npt.NDArray[np.int64]:
    """(m,) the number of the body of each triangle: those that share an edge are of one body.

    triangles (m, 3): numbers of points, of which there are `count`
    """
    edge, _ = _edges(triangles, count)
    own = np.arange(len(triangles))
    beside = np.tile(own, 3)
    order = np.argsort(edge, kind="stable")
    same = edge[order][1:] == edge[order][:-1]
    shared = np.stack([beside[order][:-1][same], beside[order][1:][same]], axis=1)
    # Each triangle is paired with itself as well: the components of these pairs are those of the triangles.
    joined = np.concatenate([np.stack([own, own], axis=1), shared]).astype(np.int32)
    return np.asarray(_kernel.edge_components(np.ascontiguousarray(joined), len(own))[: len(own)], np.int64)


def of_closed_bodies(triangles: Ints, count: int) -> npt.NDArray[np.bool_]:
    """(m,) whether each triangle is of a closed body: each of its edges runs as often one way as the other.

    triangles (m, 3): numbers of points, of which there are `count`; those that share an edge are of one body
    """
    edge, sense = _edges(triangles, count)
    body = bodies(triangles, count)
    uneven = np.bincount(edge, sense) != 0.0
    is_open = np.zeros(int(body.max(initial=0)) + 1, bool)
    is_open[body[np.tile(np.arange(len(triangles)), 3)[uneven[edge]]]] = True
    return np.asarray(~is_open[body])


def _edges(triangles: Ints, count: int) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """(3 m,) the edge at each side of triangles, by its number, first sides first; whether it runs up, 1, or down."""
    a, b = triangles.astype(np.int64)[:, [0, 1, 2, 1, 2, 0]].reshape(-1, 2, 3).transpose(1, 2, 0).reshape(2, -1)
    _, edge = np.unique(np.minimum(a, b) * count + np.maximum(a, b), return_inverse=True)
    return edge.reshape(-1), np.where(a < b, 1, -1)
