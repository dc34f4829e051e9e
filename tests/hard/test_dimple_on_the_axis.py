"""A dimple on the axis of a turned part, seen over its lip: the outline begins and ends beside the pole.

The surface rises above the accuracy between the pole and the next nodes of the mesh. The nodes alone took it for a
wrinkle, so the lip came and went with the scale.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

import hlr

VIEW = (-1.0, -0.6, 0.4)
ARC = ((4.0, 10.0), (1.8, 9.75), (0.0, math.sqrt(84.0)))


def half_width() -> float:
    """Of the lip: where slope times cosine is the tangent of the view's height, how far from the middle it reaches."""
    (ax, ay), (bx, by), (cx, cy) = ARC
    rows = np.array([[bx - ax, by - ay], [cx - bx, cy - by]])
    middles = np.array([[(ax + bx) / 2, (ay + by) / 2], [(bx + cx) / 2, (by + cy) / 2]])
    x0, y0 = np.linalg.solve(rows, (rows * middles).sum(axis=1))
    r = np.linspace(1e-4, 2.0, 200_001)
    slope = (x0 - r) / np.sqrt((ax - x0) ** 2 + (ay - y0) ** 2 - (r - x0) ** 2)
    cosine = VIEW[2] / math.hypot(VIEW[0], VIEW[1]) / np.abs(slope)
    on = cosine <= 1.0
    return float((r[on] * np.sqrt(1.0 - cosine[on] ** 2)).max())


@pytest.mark.parametrize("scale", [4.0, 4.65, 4.9, 5.0, 5.1, 5.35, 6.0, 10.0])
def test_the_lip_is_one_line_at_any_scale(scale):
    profile = cq.Workplane("XZ").moveTo(0, -math.sqrt(84)).threePointArc((14, 0), ARC[0])
    part = profile.threePointArc(ARC[1], ARC[2]).close().revolve(360, (0, 0, 0), (0, 1, 0))
    drawing = hlr.draw(part, VIEW, scale=scale)
    lips = [line for line in drawing.visible if line.kind == "outline" and (line.points3[:, 2] > 9.0).all()]
    (lip,) = lips
    across = lip.points3[:, :2] @ np.array([-VIEW[1], VIEW[0]]) / math.hypot(VIEW[0], VIEW[1])
    assert sorted(across[[0, -1]]) == pytest.approx([-half_width(), half_width()], abs=0.05 / scale)
    assert not drawing.notes
