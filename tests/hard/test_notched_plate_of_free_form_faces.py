"""A notched plate, turned anyhow, whose flat faces are written as B-spline surfaces.

The long side of a face has many corners in one line, but for rounding. The mesh of a plane has no needles between them;
that of a flat B-spline surface had, and those that rounding turned over hid the edges beside them.
"""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
from support.at_size import AT_SIZE
from support.free_form import as_free_form, lengths

NOTCHES = [(19.3, 33.81), (71.127, 90.009), (131.4, 180.52), (201.33, 222.222)]

TURNS = [((1, 2, 3), 0.0), ((1, 2, 3), 37.0), ((1, 2, 3), 81.7), ((3, -1, 2), 12.3)]


def plate() -> cq.Workplane:
    found = cq.Workplane().box(240, 60, 10, centered=False)
    for start, end in NOTCHES:
        found = found.cut(cq.Workplane().box(end - start, 6, 5, centered=False).translate((start, 54, 5)))
    return found.cut(cq.Workplane().pushPoints([(30, 25), (100, 25), (170, 25)]).circle(3).extrude(30))


@pytest.mark.parametrize(("axis", "angle"), TURNS)
def test_lines_are_those_of_planes(axis: tuple[int, int, int], angle: float) -> None:
    turned = plate().val().rotate((0, 0, 0), axis, angle)
    for view in ("iso", (1, 1, 1), (-1, 1, 0.7), (-0.3, 1, -0.8)):
        flat, free = (lengths(hlr.draw(shape, view, **AT_SIZE)) for shape in (turned, as_free_form(turned)))
        assert free == pytest.approx(flat, abs=0.2), view
