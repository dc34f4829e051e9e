"""Clean triangle meshes: equal corners joined, impossible triangles left out, needles removed by edge flips."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.source.precision import coordinate_precision

NEEDLE_HEIGHT = 64.0
"""Times the precision of the coordinates: the normal of a higher triangle is off by less than four degrees."""


@dataclass(frozen=True, slots=True)
class FlippedTriangles:
    """The triangles (k,) that edge flips changed, numbered among those that were kept.

    like (k,): whose face each has now; stood (k, 3): where its corners stood, three times a triangle plus 0..2
    """

    triangle: npt.NDArray[np.uint32]
    like: npt.NDArray[np.uint32]
    stood: npt.NDArray[np.uint32]


@dataclass(frozen=True, slots=True)
class CleanMesh:
    """points (n, 3), each used and each once; triangles (m, 3) without repeated corners; what was left out.

    kept: of the triangles that were given (m,) which each of these was, None if all of them are there; turned: which of
    these have other corners now; precision: how far coordinates may be off.
    """

    points: Floats
    triangles: Ints
    not_finite: int
    out_of_range: int
    degenerate: int
    kept: npt.NDArray[np.uint32] | None
    turned: FlippedTriangles | None
    precision: float

    def of_triangles(self, rows: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Rows for the triangles that were given, as rows for those that are here."""
        rows = self._of_kept(rows)
        if self.turned is not None:
            rows = rows.copy()
            rows[self.turned.triangle] = rows[self.turned.like]
        return rows

    def of_corners(self, table: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """(m, 3) for the corners of the triangles that were given, as (m, 3) for those that are here."""
        table = self._of_kept(table)
        if self.turned is not None:
            table = table.copy()
            table[self.turned.triangle] = table.reshape(-1)[self.turned.stood]
        return table

    def _of_kept(self, rows: npt.NDArray[Any]) -> npt.NDArray[Any]:
        return rows if self.kept is None else rows[self.kept]


def clean_mesh(points: npt.NDArray[np.floating], triangles: npt.NDArray[np.integer]) -> CleanMesh:
    """Join corners with exactly equal coordinates, drop triangles that have none, NaN or repeated corners, and turn the
    longest sides of needles: triangles that are no higher than coordinates are exact.

    Kept points are in order of first use by number, so the result depends on the input alone.
    """
    points = np.ascontiguousarray(points, dtype=np.float64).reshape(-1, 3)
    faces = np.asarray(triangles).reshape(-1, 3)
    if faces.dtype != np.int32:  # what does not fit 32 bits is out of range there, too
        faces = np.where((faces >= 0) & (faces < len(points)), faces, -1)
    found, corners, kept, left_out = _kernel.clean_mesh(points, np.ascontiguousarray(faces, dtype=np.int32))
    not_finite, out_of_range, degenerate = left_out
    exact = coordinate_precision(found)
    turned = None
    if (needles := _kernel.without_needles(found, corners, NEEDLE_HEIGHT * exact)) is not None:
        turned = FlippedTriangles(needles[0], needles[2], needles[3])
        corners[turned.triangle] = needles[1]
    return CleanMesh(found, corners, not_finite, out_of_range, degenerate, kept, turned, exact)
