"""Borders within a part of a mesh that run along one another, joined: its faces were meshed one by one.

CAD programs mesh face by face, each border as finely as its own face asks. Where two faces meet, the corners of one
then differ from those of the other by the modelling tolerance, or lie within the other's edges; so a smooth surface
would show its borders as lines, in fragments.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats
from hlr.source.model import PartMesh

GAP = 5e-5
"""Of a part's extent, at most: exporters state no tolerance. 0.01 mm of a part of 200 mm, by which CAD programs let the
ends of edges miss one another. Of a mesh made face by face the gaps end well below, and up to twice that no new are
found; what lies farther apart is a gap of the model's own."""

UNSEEN = 0.4
"""In deflections, at most: a fifth of the accuracy. Of a mesh nothing else is used up by tessellating it."""


def stitched(parts: list[PartMesh], borders: list[int], deflection: float) -> tuple[list[PartMesh], int]:
    """The parts, those with `borders` (p,) stitched; and how many pieces of borders were joined.

    No corner moves by more than GAP and UNSEEN allow. A triangle that gets corners of its neighbours is cut.
    """
    out, seams = [], 0
    for part, count in zip(parts, borders, strict=True):
        joined, found = _stitched(part, min(GAP * _extent(part), UNSEEN * deflection)) if count else (part, 0)
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


def weights(corners: Floats, triangles: Floats) -> Floats:
    """(m, 3, 3) of corners (m, 3, 3) their shares of the corners of `triangles` (m, 3, 3), on which they nearly lie."""
    a = triangles[:, None, 0]
    u, v, w = triangles[:, None, 1] - a, triangles[:, None, 2] - a, corners - a
    uu, uv, vv = (u * u).sum(-1), (u * v).sum(-1), (v * v).sum(-1)
    wu, wv = (w * u).sum(-1), (w * v).sum(-1)
    area = uu * vv - uv * uv
    flat = area <= 0.0
    area = np.where(flat, 1.0, area)
    second = np.where(flat, 0.0, (vv * wu - uv * wv) / area)
    third = np.where(flat, 0.0, (uu * wv - uv * wu) / area)
    shares: npt.NDArray[np.float64] = np.stack([1.0 - second - third, second, third], axis=-1).clip(0.0, 1.0)
    return np.asarray(shares / shares.sum(axis=-1, keepdims=True))
