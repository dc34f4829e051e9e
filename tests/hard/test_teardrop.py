"""A ball that runs smoothly into a cone with an apex: its outline goes up one side, to the apex, and down the other.

Both sides and the part of the ball between them are one curve, which begins and ends in the apex. It is no closed one:
at the apex each side has the normal of its own ruling.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

import hlr

RADIUS, HEIGHT = 10.0, 30.0


def teardrop(size):
    """The middle of the ball is at the origin, the apex above it."""
    r, h, sine = size * RADIUS, size * HEIGHT, RADIUS / HEIGHT
    tangent = (r * math.sqrt(1.0 - sine * sine), r * sine)
    half = cq.Workplane("XZ").moveTo(0, -r).threePointArc((r, 0), tangent).lineTo(0, h).close()
    return half.revolve(360, (0, 0, 0), (0, 1, 0))


@pytest.mark.parametrize("size", [0.03, 1.0, 1000.0])
@pytest.mark.parametrize("view", ["front", "iso", "iso-ne", (0.62, -0.41, 0.67), (1, -2, 1), (0.3, -0.8, 0.5)])
def test_both_sides_reach_the_apex(size, view):
    drawing = hlr.draw(teardrop(size), view, hidden=True)
    outlines = [line for line in drawing.lines if line.kind == "outline"]
    assert all(line.visible for line in outlines)
    apex = np.array([0.0, 0.0, size * HEIGHT])
    sides = [
        line.points3 for line in outlines if np.linalg.norm(line.points3[[0, -1]] - apex, axis=1).min() < 0.01 * size
    ]
    lengths = [float(np.linalg.norm(side[-1] - side[0])) for side in sides]
    slant = size * math.sqrt(HEIGHT**2 - RADIUS**2)
    assert lengths == pytest.approx([slant, slant], rel=1e-3)
