"""A sphere has no edge that is drawn: its outline is a contour of the mesh, which zigzags and folds over itself.

Edge-based algorithms draw the seam, a polygon of the mesh's own edges, or small loops where the contour turns back.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import arc, kinds, like

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

RADIUS = 10.0
CENTRE = (3.0, -4.0, 5.0)
VIEWS = ["front", "top", "iso", (3, 1, -2), (-0.79, 0.55, 0.27), (0.2, 0.5, 0.9)]


def great_circle(drawing):
    u, v = (RADIUS * np.asarray(axis) for axis in (drawing.view.right, drawing.view.up))
    return expect(drawing, arc(CENTRE, u, v))


@pytest.mark.slow
@pytest.mark.parametrize("view", VIEWS)
def test_only_a_great_circle(picture, view):
    drawing = hlr.draw(cq.Workplane().sphere(RADIUS).translate(CENTRE), view, **AT_SIZE)
    like(drawing, great_circle(drawing))
    assert kinds(drawing) == {("outline", True)}
    if view == "iso":
        picture(drawing)


def test_its_own_seam_along_the_outline():
    """The seam of a whole sphere is half of its outline from the front: drawn once."""
    drawing = hlr.draw(cq.Workplane().sphere(RADIUS).translate(CENTRE), "front", seam=True, **AT_SIZE)
    like(drawing, great_circle(drawing))
