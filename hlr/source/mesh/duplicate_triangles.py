"""Of triangles with the same three corners one stays, whatever the order in which they are listed."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints


def unique_triangles(points: Floats, triangles: Ints, face: Ints) -> Ints:
    """(m,) ascending indices: of each set of triangles with the same corners one, oriented as most of them.

    Where both orientations are equally frequent, the mesh is two-sided. Then one side stays, consistently from
    neighbour to neighbour: the side of adjoining triangles without duplicate, else the one that encloses a volume.

    points (n, 3); triangles (t, 3); face (t,): of equal ones the triangle of the lowest face stays.
    """
    number = row_numbers(np.sort(triangles, axis=1), len(points))
    sets = int(number.max(initial=-1)) + 1
    if sets == len(triangles):
        return np.arange(len(triangles), dtype=np.int32)
    # Even: an even permutation of the ascending corners, whichever is first. It tells the two orientations apart.
    even = ((triangles[:, 1] > triangles[:, 0]) ^ (triangles[:, 2] > triangles[:, 1])) == (
        triangles[:, 0] < triangles[:, 2]
    )
    balance = np.bincount(number, np.where(even, 1, -1), sets)
    stays = np.where(even, 1, -1) * np.where(balance == 0, 1, balance)[number]
    order = np.lexsort((face, -stays, number))
    tied = np.flatnonzero(balance == 0)
    chosen = order[np.searchsorted(number[order], np.arange(sets))]
    if len(tied):
        want = even[chosen] ^ _to_reverse(points, triangles[chosen], balance != 0)
        order = np.lexsort((face, even != want[number], number))
        chosen = np.where(balance == 0, order[np.searchsorted(number[order], np.arange(sets))], chosen)
    return np.sort(chosen).astype(np.int32)


def row_numbers(corners: Ints, count: int) -> npt.NDArray[np.int64]:
    """(t,) ranks of rows of three numbers below `count`: equal for equal rows, ascending with the rows."""
    wide = corners.astype(np.int64)
    # Three indices do not fit 64 bits for large meshes: the first two are ranked, then joined with the third.
    _, pair = np.unique(wide[:, 0] * count + wide[:, 1], return_inverse=True)
    _, number = np.unique(pair.ravel() * count + wide[:, 2], return_inverse=True)
    return np.asarray(number.ravel(), np.int64)


def _to_reverse(points: Floats, triangles: Ints, fixed: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """(t,) bool: the triangle must be reversed for a consistent orientation with its neighbours.

    Every triangle stands for two, one of each orientation. Two that run through their common edge in opposite
    directions are connected, so an orientable mesh falls apart into two sheets. A `fixed` triangle has one orientation.
    """
    both = np.concatenate([triangles, triangles[:, ::-1]])
    count = len(triangles)
    there = np.concatenate([np.ones(count, bool), ~fixed])
    start, end = both.ravel().astype(np.int64), np.roll(both, -1, axis=1).ravel().astype(np.int64)
    owner = np.repeat(np.arange(2 * count, dtype=np.int32), 3)
    low, high = np.minimum(start, end), np.maximum(start, end)
    _, side, uses = np.unique(low * np.int64(len(points)) + high, return_inverse=True, return_counts=True)
    side = side.ravel()
    # Both copies of two triangles make four uses. A non-manifold edge connects nothing.
    live = uses[side] == 4
    order = np.flatnonzero(live)[np.lexsort((owner[live], start[live] > end[live], side[live]))]
    up, down = order.reshape(-1, 4)[:, :2], order.reshape(-1, 4)[:, 2:]
    pairs = []
    for i in (0, 1):
        for j in (0, 1):
            one, other = owner[up[:, i]], owner[down[:, j]]
            pairs.append(np.stack([one, other], axis=1)[one % count != other % count])
    alone = np.arange(2 * count, dtype=np.int32)
    graph = np.concatenate([*pairs, np.stack([alone, alone], axis=1)])
    graph = graph[there[graph].all(axis=1)]
    sheet = np.zeros(2 * count, np.int64)
    sheet[graph[:, 0]] = _kernel.edge_components(np.ascontiguousarray(graph), 2 * count)
    middle = points.mean(axis=0)
    a, b, c = (points[both[:, k]] - middle for k in range(3))
    volume = np.bincount(sheet[there], np.einsum("ij,ij->i", a, np.cross(b, c))[there], sheet.max() + 1)
    singles = np.bincount(sheet[:count][fixed], minlength=len(volume))
    mine, reverse = sheet[:count], sheet[count:]
    # A tie goes to the sheet with the lower number, so that a sheet without volume has one orientation throughout.
    better = reverse < mine
    for score in (volume, singles):
        better = np.where(score[mine] != score[reverse], score[reverse] > score[mine], better)
    return np.asarray(better & ~fixed)
