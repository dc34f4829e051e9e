"""Borders within a part of a mesh that run along one another, joined: its faces were meshed one by one.

CAD programs mesh face by face, each border as finely as its own face asks. Where two faces meet, the corners of one
then differ from those of the other by the modelling tolerance, or lie within the other's edges; so a smooth surface
would show its borders as lines, in fragments.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hlr import _kernel
from hlr.request.accuracy import STITCH
from hlr.source.model import PartMesh

MAX_GAP_SHARE = 5e-5
"""Of a part's extent, at most: exporters state no tolerance. 0.01 mm of a part of 200 mm, by which CAD programs let the
ends of edges miss one another. Of a mesh made face by face the gaps end well below, and up to twice that no new are
found; what lies farther apart is a gap of the model's own."""


def stitch_borders(parts: list[PartMesh], borders: list[int], deflection: float) -> tuple[list[PartMesh], int]:
    """The parts, those with `borders` (p,) stitched; and how many pieces of borders were joined.

    No corner moves by more than MAX_GAP_SHARE and STITCH allow. A triangle that gets corners of its neighbours is cut.
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
