"""A bent tube whose axis runs along the line of sight in two places.

There a whole ring of the tube is seen edge-on, and two branches of the outline cross like an X: the ring, and the line
along the tube. On paper one leaves the other as a tangent, and for a while both are one line. Of the two borders of the
tube nothing may be missing there.
"""

from __future__ import annotations

from itertools import pairwise

import cadquery as cq
import numpy as np
import pytest

import hlr

PATHS = {
    "two turns": [(0, 0), (10, 15), (25, 10), (40, 30)],
    "steep turns": [(0, 0), (5, 20), (20, 10), (30, 40)],
}
RADIUS_MM = 3.0
# Nearer to its ends on paper the border of the tube bends away: a disc is seen at an angle there.
END_MM = 1.0


def tube(path: list[tuple[float, float]], size: float) -> cq.Workplane:
    line = cq.Workplane("XY").spline([(x * size, y * size) for x, y in path])
    return cq.Workplane("XZ").circle(RADIUS_MM * size).sweep(line)


def finely(points: np.ndarray) -> np.ndarray:
    """More points on the same polyline."""
    shares = np.linspace(0.0, 1.0, 50, endpoint=False)[:, None]
    return np.vstack([a + shares * (b - a) for a, b in pairwise(points)] + [points[-1:]])


# At the last size, one of two outlines that touch drew back over a stretch of the other that was left out beside it.
@pytest.mark.parametrize("size", [0.01, 1.0, 2000.0, 3571.4335028260216])
@pytest.mark.parametrize("view", ["right", "left"])
@pytest.mark.parametrize("path", PATHS)
def test_both_borders_are_whole(path, view, size):
    scale = 5.0 / size
    drawing = hlr.draw(tube(PATHS[path], size), view, hidden=False, scale=scale)
    length_mm = PATHS[path][-1][1] * size * scale
    width_mm = 2.0 * RADIUS_MM * size * scale
    points = np.vstack([line.points for line in drawing.lines])
    low = points.min(axis=0)
    for border_mm in (low[1], low[1] + width_mm):
        spans = []
        for line in drawing.lines:
            points = finely(line.points)
            on = np.abs(points[:, 1] - border_mm) < 0.06
            for k in np.flatnonzero(on[:-1] & on[1:]):
                spans.append(sorted(points[k : k + 2, 0] - low[0]))
        reached_mm = END_MM
        for start, end in sorted(spans):
            assert start - reached_mm < 0.05, f"a gap from {reached_mm} to {start} mm"
            reached_mm = max(reached_mm, end)
        assert reached_mm > length_mm - END_MM
