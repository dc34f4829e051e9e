"""Walks along creases and borders of meshes: their edges, joined end to end."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints

STRAIGHT_ON = 30.0
"""Degrees: where more than two creases meet, a chain continues along the straightest one if it turns by no more than
this, and no other is nearly as straight. A rim of twelve chords continues; the edges of a box never do."""

Keys = npt.NDArray[np.int64]


def edge_keys(edges: Ints, n: int) -> Keys:
    """(e, 2) -> (e,) one sortable number per edge, lower vertex first."""
    return np.asarray(edges[:, 0], np.int64) * np.int64(n) + edges[:, 1]


def crease_walks(points: Floats, edges: Ints, kind: npt.NDArray[np.uint8], part: Ints) -> _kernel.Walks:
    """Creases and borders of meshes, joined where exactly two of a kind meet, or one goes straight on.

    points (n, 3); edges (e, 2); kind (e,): EdgeClass or 255 for none; part (e,).
    """
    chosen = np.flatnonzero(kind != 255).astype(np.int32)
    key = part[chosen].astype(np.int32) * 8 + kind[chosen]
    offsets, order, backward = _kernel.chain(
        np.ascontiguousarray(edges[chosen]), np.ascontiguousarray(key), points, STRAIGHT_ON
    )
    member = chosen[order]
    head = member[offsets[:-1]]
    return _kernel.Walks(offsets, member, backward, kind[head], part[head].astype(np.int32))
