"""Diagonals that the triangles of two faces share beside their common edge: one of the faces gets another one.

Along an edge that bulges out of both of its faces, as where a chamfered rim meets a flat, each face may have a triangle
or a fan of triangles between points of the edge. Then four triangles meet at the diagonal, and between the two faces is
a wedge without thickness:

```text
       m                    m
      / \\                  /|\\
     /   \\                / | \\        a, m, b: of the edge; x: of the plane face alone
    a-----b              a  |  b
     \\   /                \\ | /
      \\ /                  \\|/
       x                    x
```

Left out (as `flat_wedges` are), the edge would lie before the body.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.source.model import PartMesh

Indices = npt.NDArray[np.intp]

ROUNDS = 64
"""Of a fan of diagonals one is turned in each round."""


def without_shared_diagonals(part: PartMesh) -> PartMesh:
    """The part with other diagonals where one of the two faces is planar: as many triangles, in the same faces."""
    triangles, on = part.triangles.copy(), part.surface_parameters
    corner = None if on is None else on.corner.copy()
    for _ in range(ROUNDS):
        turned: set[int] = set()
        numbers = _numbers(triangles, len(part.points))
        for pair in _shared(numbers, part.triangle_face, part.face_planar):
            both = pair // 3
            if turned.isdisjoint(both.tolist()):
                places = _turned(part.points, triangles, both, pair % 3, numbers)
                if places is not None:
                    turned.update(both.tolist())
                    for table in (triangles, corner):
                        if table is not None:
                            table[both] = table[both].ravel()[places]
        if not turned:
            break
    if corner is None or on is None:
        return replace(part, triangles=triangles)
    return replace(part, triangles=triangles, surface_parameters=replace(on, corner=corner))


def _numbers(triangles: Ints, points: int) -> npt.NDArray[np.int64]:
    """(3t,) the number of each side of each triangle, whichever way it runs."""
    start, end = triangles.astype(np.int64), np.roll(triangles, -1, axis=1).astype(np.int64)
    return np.asarray((np.minimum(start, end) * points + np.maximum(start, end)).ravel())


def _shared(numbers: npt.NDArray[np.int64], face: Ints, planar: npt.NDArray[np.bool_]) -> list[Indices]:
    """The two sides, as numbers 3 * triangle + side, in a planar face of each diagonal that two faces share."""
    order = np.argsort(numbers, kind="stable")
    ascending = numbers[order]
    first = np.flatnonzero(np.append(True, ascending[1:] != ascending[:-1]))
    four = first[np.diff(first, append=len(ascending)) == 4]
    found = []
    for sides in order[four[:, None] + np.arange(4)]:
        faces, count = np.unique(face[sides // 3], return_counts=True)
        flat = faces[planar[faces]]
        if count.tolist() == [2, 2] and len(flat):
            found.append(sides[face[sides // 3] == flat[0]])
    return found


def _turned(
    points: Floats, triangles: Ints, both: Indices, side: Indices, numbers: npt.NDArray[np.int64]
) -> Ints | None:
    """The corners of two triangles of one plane once their common side is turned: numbers of their six corners, (2, 3).

    side: of each, that which they have in common. None where the other diagonal does not lie inside them, or is the
    side of a triangle already.
    """
    k, j = (int(i) for i in side)
    at = [k, (k + 1) % 3, (k + 2) % 3, 3 + (j + 2) % 3]
    corners = triangles[both].ravel()
    a, b, m, x = corners[at].tolist()
    normal = np.cross(points[b] - points[a], points[m] - points[a])
    new = [(a, x, m), (x, b, m)]
    if min(m, x) * len(points) + max(m, x) in numbers:
        return None
    if not all(np.cross(points[q] - points[p], points[r] - points[p]) @ normal > 0.0 for p, q, r in new):
        return None
    place = dict(zip((a, b, m, x), at, strict=True))
    return np.array([[place[i] for i in each] for each in new], np.int32)
