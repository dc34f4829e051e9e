"""Cleaning of triangle meshes: equal vertices are welded, invalid triangles left out, needles removed by edge flips."""

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
    """Triangles that edge flips changed, as indices into the kept ones.

    triangle (k,)    the changed triangle
    like     (k,)    the triangle whose attributes it takes over
    stood    (k, 3)  for each of its corners the same corner before: three times a triangle, plus 0, 1 or 2
    """

    triangle: npt.NDArray[np.uint32]
    like: npt.NDArray[np.uint32]
    stood: npt.NDArray[np.uint32]


@dataclass(frozen=True, slots=True)
class CleanMesh:
    """A mesh without repeated or unused points and without invalid triangles.

    points (n, 3), triangles (m, 3); numbers of triangles left out: not_finite, out_of_range, degenerate
    kept       (m,) index of each triangle in the given mesh; None: all are kept
    turned     triangles that edge flips changed; None: there are none
    precision  largest rounding error of the coordinates
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
        """Attributes of the given triangles, one row each, as rows of the cleaned triangles."""
        rows = self._of_kept(rows)
        if self.turned is not None:
            rows = rows.copy()
            rows[self.turned.triangle] = rows[self.turned.like]
        return rows

    def of_corners(self, table: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Attributes (m, 3) of the corners of the given triangles, as (m, 3) of the cleaned triangles."""
        table = self._of_kept(table)
        if self.turned is not None:
            table = table.copy()
            table[self.turned.triangle] = table.reshape(-1)[self.turned.stood]
        return table

    def _of_kept(self, rows: npt.NDArray[Any]) -> npt.NDArray[Any]:
        return rows if self.kept is None else rows[self.kept]


def clean_mesh(points: npt.NDArray[np.floating], triangles: npt.NDArray[np.integer]) -> CleanMesh:
    """Weld vertices with equal coordinates, drop invalid triangles, and flip the longest edges of needles.

    Invalid: a corner does not exist, is not finite, or is repeated. Needle: no higher than the rounding of coordinates.
    The result depends on the input alone.
    """
    points = np.ascontiguousarray(points, dtype=np.float64).reshape(-1, 3)
    faces = np.asarray(triangles).reshape(-1, 3)
    if faces.dtype != np.int32:  # an index beyond 32 bits is out of range in any case
        faces = np.where((faces >= 0) & (faces < len(points)), faces, -1)
    found, corners, kept, left_out = _kernel.clean_mesh(points, np.ascontiguousarray(faces, dtype=np.int32))
    not_finite, out_of_range, degenerate = left_out
    rounding = coordinate_precision(found)
    turned = None
    if (needles := _kernel.without_needles(found, corners, NEEDLE_HEIGHT * rounding)) is not None:
        turned = FlippedTriangles(needles[0], needles[2], needles[3])
        corners[turned.triangle] = needles[1]
    return CleanMesh(found, corners, not_finite, out_of_range, degenerate, kept, turned, rounding)
