"""The corner of a blend where a spline surface shrinks to a point, seen along the wall that the blend leaves.

The blend is tangent to the wall but for a ten-thousandth of a millimetre, so its outline runs close to their common
border, on one side of it or the other, into that corner. There one side of the face has no length: over a hair's
breadth its normal turns from that of one neighbour to that of the other. A triangle at such a pole is crossed by the
outline once where it enters and twice at the pole.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hlr

SHAPE = Path(__file__).parents[1] / "data" / "brep" / "corner_of_a_blend.brep"
"""Four faces of a printed part."""
BLEND = 1
CORNER = (3.0, 3.0)
"""Millimetres of the model, from the lower left corner of the drawing."""


@pytest.mark.parametrize("scale", [0.5, 2.0, 8.0])
def test_the_outline_ends_in_the_corner(scale):
    drawing = hlr.draw(SHAPE, "back", scale=scale, accuracy=0.05, smooth=False)
    outline = [line for line in drawing.visible if line.kind == "outline" and line.face == BLEND]
    points = np.concatenate([line.points for line in outline])
    ends = np.concatenate([line.points[[0, -1]] for line in outline])
    corner = np.multiply(CORNER, scale)
    assert np.linalg.norm(ends - corner, axis=1).min() < 0.05
    assert (points.max(axis=0) < corner + 0.05).all(), "nothing of it runs on beyond the corner"
