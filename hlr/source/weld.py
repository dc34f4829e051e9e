"""Clean triangle meshes: equal corners joined, impossible triangles left out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.source.model import Floats, Ints
from hlr.source.precision import precision


@dataclass(frozen=True, slots=True)
class Clean:
    """points (n, 3), each used and each once; triangles (m, 3) without repeated corners; what was left out.

    kept: of the triangles that were given (m,) which each of these was; precision: how far coordinates may be off.
    """

    points: Floats
    triangles: Ints
    not_finite: int
    out_of_range: int
    degenerate: int
    kept: npt.NDArray[np.intp]
    precision: float


def clean(points: npt.NDArray[np.floating], triangles: npt.NDArray[np.integer]) -> Clean:
    """Join corners with exactly equal coordinates and drop triangles that have none, NaN or repeated corners.

    Kept points are in order of first use by number, so the result depends on the input alone.
    """
    points = np.array(points, dtype=np.float64, copy=True).reshape(-1, 3)
    points += 0.0  # minus zero becomes zero: equal numbers, equal bits
    faces = np.asarray(triangles).reshape(-1, 3)
    given = np.arange(len(faces))
    inside = ((faces >= 0) & (faces < len(points))).all(axis=1)
    out_of_range = int(len(faces) - inside.sum())
    if out_of_range:
        faces, given = faces[inside], given[inside]
    finite_points = np.logical_and.reduce(np.isfinite(points), axis=1)
    not_finite = 0
    if not finite_points.all():
        finite = finite_points[faces].all(axis=1)
        not_finite = int(len(faces) - finite.sum())
        faces, given = faces[finite], given[finite]
        points[~finite_points] = 0.0
    used = np.zeros(len(points), dtype=bool)
    used[faces] = True
    kept = np.flatnonzero(used)
    points = points[kept]
    number = np.zeros(len(used), dtype=np.int32)
    first, rank = equal_rows(points)
    number[kept] = rank
    faces = number[faces]
    a, b, c = faces.T
    whole = (a != b) & (b != c) & (c != a)
    degenerate = int(len(faces) - whole.sum())
    whole_faces = np.ascontiguousarray(faces[whole], np.int32)
    points = points[first]
    return Clean(points, whole_faces, not_finite, out_of_range, degenerate, given[whole], precision(points))


def equal_rows(points: Floats) -> tuple[npt.NDArray[np.intp], Ints]:
    """(first occurrence of each distinct row, in order; for every row the rank of its first occurrence)."""
    if not len(points):
        return np.empty(0, dtype=np.intp), np.empty(0, dtype=np.int32)
    bits = np.ascontiguousarray(points).view(np.uint64)
    # One 64-bit hash sorts several times faster than three columns; should two different rows ever share one, the
    # columns are sorted after all.
    mixed = bits[:, 0] * np.uint64(0x9E3779B97F4A7C15)
    mixed ^= mixed >> np.uint64(29)
    mixed = (mixed + bits[:, 1]) * np.uint64(0xBF58476D1CE4E5B9)
    mixed ^= mixed >> np.uint64(32)
    mixed = (mixed + bits[:, 2]) * np.uint64(0x94D049BB133111EB)
    mixed ^= mixed >> np.uint64(31)
    _, first, inverse = np.unique(mixed, return_index=True, return_inverse=True)
    if not np.array_equal(points[first[inverse]], points):
        _, first, inverse = np.unique(points, axis=0, return_index=True, return_inverse=True)
    inverse = inverse.ravel()
    order = np.argsort(first)
    rank = np.empty(len(first), dtype=np.int32)
    rank[order] = np.arange(len(first), dtype=np.int32)
    return first[order], rank[inverse]
