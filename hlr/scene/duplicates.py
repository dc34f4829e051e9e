"""Duplicated triangles and faces of a part are left out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from hlr.common.distinct import distinct
from hlr.common.types import Floats, Ints
from hlr.scene.flat_wedges import flat_wedges
from hlr.source.mesh.duplicate_triangles import row_numbers, unique_triangles
from hlr.source.model import PartMesh

Indices = npt.NDArray[np.intp]

Kept = npt.NDArray[np.bool_]
"""Per triangle, whether it stays."""


def without_duplicates(part: PartMesh, triangles: bool = True, places: bool = True) -> tuple[PartMesh, Indices]:
    """The part without repeated triangles and faces, and the numbers (n,) of the triangles that stay, ascending.

    One of each set of duplicates stays. Duplicates would make every edge between them non-manifold, or count as two
    surfaces in contact. triangles: a triangle may have the corners of another one; places: two triangles may lie in
    one place. A caller that knows better says False, which saves the search.
    """
    staying: Indices = np.arange(len(part.triangles))
    if triangles:
        part, kept = _without_repeated_triangles(part)
        staying = staying[kept]
    if places:
        part, kept = _without_repeated_faces(part)
        staying = staying[kept]
    return part, staying


def without_flat_wedges(part: PartMesh) -> tuple[PartMesh, Indices]:
    """The part without wedges that have no thickness, and the numbers (n,) of the triangles that stay, ascending."""
    kept = ~flat_wedges(part.triangles, part.triangle_face, len(part.points))
    return _with_triangles(part, kept), np.flatnonzero(kept)


def _without_repeated_triangles(part: PartMesh) -> tuple[PartMesh, Kept]:
    """The part without triangles that have the corners of another one, in either orientation."""
    kept = np.zeros(len(part.triangles), bool)
    kept[unique_triangles(part.points, part.triangles, part.triangle_face)] = True
    return _with_triangles(part, kept), kept


def _without_repeated_faces(part: PartMesh) -> tuple[PartMesh, Kept]:
    """The part without faces whose triangles all coincide with those of others, with the same orientation.

    Two equal solids in one place have such faces. Only whole faces are left out: single triangles of overlapping
    neighbours may coincide, and leaving them out would make holes. The orientation must be the same: two bodies in
    contact at equal faces each need their own.
    """
    _, place = equal_rows(part.points + 0.0)  # minus zero becomes zero, so that equal numbers have equal bits
    turned = np.argmin(place[part.triangles], axis=1)[:, None]
    nodes = np.take_along_axis(part.triangles, (turned + np.arange(3)) % 3, axis=1)
    first = _first_equal(place[nodes], len(part.points))
    own = first == np.arange(len(first))
    # A face that has the first of a set of equal triangles stays whole, so that one of each set stays.
    kept = np.bincount(part.triangle_face, weights=own, minlength=len(part.face_planar))[part.triangle_face] > 0
    if kept.all():
        return part, kept
    # Edges of the removed faces now use the coincident nodes of the faces that stay.
    node = np.arange(len(part.points), dtype=np.int32)
    node[nodes[~kept]] = nodes[first[~kept]]
    used = distinct(part.triangles[kept])
    node[used] = used
    return replace(_with_triangles(part, kept), edge_nodes=node[part.edge_nodes]), kept


def _first_equal(corners: Ints, n: int) -> Indices:
    """(t,) for each row of three numbers below n the index of the first equal row."""
    number = row_numbers(corners, n)
    _, first = np.unique(number, return_index=True)
    return np.asarray(first[number], np.intp)


def _with_triangles(part: PartMesh, kept: Kept) -> PartMesh:
    if kept.all():
        return part
    on = part.surface_parameters
    origin = np.flatnonzero(kept).astype(np.int32)
    return replace(
        part,
        triangles=part.triangles[kept],
        triangle_face=part.triangle_face[kept],
        origin=origin if part.origin is None else part.origin[origin],
        surface_parameters=replace(on, corner=on.corner[kept]) if on is not None else None,
    )


def equal_rows(points: Floats) -> tuple[npt.NDArray[np.intp], Ints]:
    """Index of the first occurrence of each distinct row, ascending; and for every row which of them it equals."""
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
