"""Wedges between two faces of a solid that have no thickness: the same triangle seen from both sides.

A plane that touches the saddle of a ring cuts it in an eight. Where its two loops nearly meet, the ring's face and the
cut face have a small triangle between the same three points.

```text
         \\   /
          \\_/        the neck of the eight: a triangle of the cut face, and one of the ring behind it
          / \\        that faces the other way
         /   \\
```
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr.common.types import Ints
from hlr.source.mesh.duplicate_triangles import row_numbers


def flat_wedges(triangles: Ints, face: Ints, points: int) -> npt.NDArray[np.bool_]:
    """(t,) bool: the triangle is half of such a wedge. Without both, the surface is as closed as before.

    Both faces must have other triangles: a sheet seen from both sides is not a wedge. The surface around the wedge must
    be closed.

    triangles (t, 3): corners, below `points`; face (t,): of each.
    """
    found = np.zeros(len(triangles), bool)
    number = row_numbers(np.sort(triangles, axis=1), points)
    order = np.argsort(number, kind="stable")
    pairs = np.flatnonzero(np.bincount(number) == 2)
    first = np.searchsorted(number[order], pairs)
    one, other = order[first], order[first + 1]
    opposite = _is_reversed(triangles[one], triangles[other]) & (face[one] != face[other])
    one, other = one[opposite], other[opposite]
    if not len(one):
        return found
    # Faces all of which lies on other faces are no wedges.
    wedges = np.bincount(face[np.concatenate([one, other])], minlength=int(face.max()) + 1)
    whole = wedges == np.bincount(face, minlength=len(wedges))
    some = ~whole[face[one]] & ~whole[face[other]]
    one, other = one[some], other[some]
    closed = _closed_around(triangles, np.concatenate([one, other]), points)
    some = closed[: len(one)] & closed[len(one) :]
    found[one[some]] = found[other[some]] = True
    return found


def _is_reversed(one: Ints, other: Ints) -> npt.NDArray[np.bool_]:
    """(n,) whether triangles of the same corners run around them in opposite directions."""
    place = np.argmax(other == one[:, :1], axis=1)
    after = np.take_along_axis(other, ((place + 1) % 3)[:, None], axis=1)[:, 0]
    return np.asarray(after == one[:, 2])


def _closed_around(triangles: Ints, some: npt.NDArray[np.intp], points: int) -> npt.NDArray[np.bool_]:
    """(n,) whether the surface goes on around these triangles as it should without them.

    Along each side as many triangles run one way as the other, and on two sides at least there are others than the two
    halves of the wedge. At a tip, where two faces meet at both sides of a corner, there are none on two sides: without
    the wedge the part would be shorter.
    """
    start, end = triangles.astype(np.int64), np.roll(triangles, -1, axis=1).astype(np.int64)
    side = np.minimum(start, end) * points + np.maximum(start, end)
    asked, place = np.unique(side[some], return_inverse=True)
    near = np.isin(side, asked)
    at, way = np.searchsorted(asked, side[near]), np.where(start < end, 1, -1)[near]
    balance, number = np.bincount(at, way, len(asked)), np.bincount(at, minlength=len(asked))
    place = place.reshape(-1, 3)
    return np.asarray((balance == 0)[place].all(axis=1) & (np.count_nonzero(number[place] > 2, axis=1) >= 2))
