"""Stitching: borders of a mesh part that run along one another are joined.

CAD programs mesh face by face. Where two faces meet, the vertices of one then differ from those of the other by the
modelling tolerance, or lie within the other's edges (T-junctions). Without stitching, a smooth surface would show these
borders as fragments of lines.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hlr import _kernel
from hlr.request.accuracy import STITCH
from hlr.source.mesh.mending import MAX_GAP_SHARE
from hlr.source.model import PartMesh


def stitch_borders(parts: list[PartMesh], borders: list[int], deflection: float) -> tuple[list[PartMesh], int]:
    """The parts, stitched where `borders` (p,) is not 0; and the number of border pieces that were joined.

    No vertex moves by more than MAX_GAP_SHARE and STITCH allow. Vertices of a neighbour on its border split a triangle.
    """
    out, seams = [], 0
    for part, count in zip(parts, borders, strict=True):
        joined, found = _stitched(part, min(MAX_GAP_SHARE * _extent(part), STITCH * deflection)) if count else (part, 0)
        out.append(joined)
        seams += found
    return out, seams


def _stitched(part: PartMesh, reach: float) -> tuple[PartMesh, int]:
    triangles, origin, seams = _kernel.stitched(part.points, part.triangles, reach)
    if not seams:
        return part, 0
    used = np.zeros(len(part.points), bool)
    used[triangles] = True
    number = np.cumsum(used, dtype=np.int32) - 1
    whence = origin if part.origin is None else part.origin[origin]
    return replace(
        part,
        points=np.ascontiguousarray(part.points[used]),
        triangles=np.ascontiguousarray(number[triangles]),
        triangle_face=part.triangle_face[origin],
        origin=np.asarray(whence, np.int32),
    ), seams


def _extent(part: PartMesh) -> float:
    return float(np.ptp(part.points, axis=0).max())
