"""A triangle that cuts a cube in two: its sides go in and out through faces where no edge is.

Appel's counting along edges (1967) sees only changes at contours; a piercing point in the middle of two faces is none.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, of_kind
from support.meshes import BOX_EDGES, as_parts, box, face, merged

CUBE = box((-10, -10, -10), (10, 10, 10))
BLADE = face((-25, -15, 2), (25, -15, 2), (0, 25, 2))
SIDES = [(8, 9), (9, 10), (10, 8)]


@pytest.mark.parametrize("model", [merged, as_parts])
@pytest.mark.parametrize("view", ["iso", "iso-nw", (2, 1, -1), "front", "top"])
def test_the_blade_goes_in_and_out(picture, model, view):
    drawing = hlr.draw(model(CUBE, BLADE), view, **AT_SIZE)
    agrees(drawing, by_oracle(drawing, *merged(CUBE, BLADE), [*BOX_EDGES, *SIDES]), without=("intersection",))
    if view == "iso":
        picture(drawing)


def test_the_ends_are_exact():
    # A side of the blade enters at (10, 9); the two upright edges nearest to the viewer go down through the blade.
    drawing = hlr.draw(merged(CUBE, BLADE), (1, -1, 0.25), **AT_SIZE)
    ends = np.array([p for x in drawing.lines for p in x.points3[[0, -1]] if x.visible])
    for point in ((10, 9, 2), (10, -10, 2), (-10, -10, 2)):
        assert np.abs(ends - point).max(axis=1).min() < 1e-6


def test_lines_of_intersection_if_drawn_lie_where_the_blade_meets_the_faces():
    drawing = hlr.draw(as_parts(CUBE, BLADE), "iso", **AT_SIZE)
    for line in of_kind(drawing, "intersection"):
        assert line.points3[:, 2] == pytest.approx(2.0, abs=1e-6)
        assert np.abs(line.points3[:, :2]).max(axis=1) == pytest.approx(10.0, abs=1e-6)
