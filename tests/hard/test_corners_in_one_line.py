"""A plate with rows of windows whose sides lie in one line from window to window, but for rounding.

Between three corners in one line a planar face may have a needle of a triangle, which the grid of the image turns over.
Edges beside it were drawn hidden in full view: as edges with all their faces turned away, or as edges behind the
triangle on the needle's other side.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest
from hard.brep import faultless

from hlr.source import open_source

SIDE, STEP = 5.0, 8.0


def plate(degrees: float) -> cq.Shape:
    """Windows like diamonds, in rows along the directions of their own sides."""
    slope = math.radians(degrees)
    ways = np.array([(math.cos(slope), math.sin(slope)), (-math.cos(slope), math.sin(slope))])
    made = cq.Workplane().box(60, 60, 4)
    for i in range(-2, 3):
        for j in range(-2, 3):
            corners = [
                tuple((STEP * np.array((i, j)) + SIDE * np.array(at)) @ ways) for at in ((0, 0), (1, 0), (1, 1), (0, 1))
            ]
            made = made.cut(cq.Workplane().polyline(corners).close().extrude(10, both=True))
    return made.val()


@pytest.mark.parametrize("degrees", [30, 60])
def test_by_rays(degrees):
    shape = plate(degrees)
    drawings = list(faultless(shape, shape, ["top", "iso", "iso-sw", (0.2, 0.3, 1)], 6000))
    assert all(len(drawing.visible) > 100 for drawing in drawings)


@pytest.mark.parametrize("degrees", [30, 45, 60])
def test_there_are_no_needles(degrees):
    (part,) = open_source(plate(degrees)).mesh(0.05, 0.3).parts
    p, q, r = (part.points[part.triangles[:, k]] for k in range(3))
    sides = np.stack([q - p, r - q, p - r])
    height = np.linalg.norm(np.cross(q - p, r - p), axis=1) / np.linalg.norm(sides, axis=2).max(axis=0)
    assert height.min() > 1e-3
