"""A round body seen from the side: its rim runs out, back over all of itself, and to its start again.

Where the seam lies in front or behind, the rim begins and ends in the middle of its image. It was drawn in two pieces
then, with a gap of some hundredths of a millimetre between them. Contours of such a DXF are not closed.
"""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
from support.at_size import AT_SIZE

RADIUS, HEIGHT = 10.0, 30.0
NEAR = 1e-6
"""A rim ends where its circle turns back, not at the last corner of the mesh before that place."""


def rims(drawing):
    """The extent of each line of an edge along x, and its height."""
    lines = [line.points3 for line in drawing.lines if line.edge is not None]
    return sorted((round(float(p[0, 2]), 6), float(p[:, 0].min()), float(p[:, 0].max())) for p in lines)


CASES = [(turned, view) for turned in (0, 10, 90, 180, 200, 270) for view in ("front", "back")]


@pytest.mark.parametrize(("turned", "view"), [*CASES, (45, "front"), (135, "front")])
def test_each_rim_is_one_line_wherever_its_seam_lies(turned, view, picture):
    body = cq.Workplane().circle(RADIUS).extrude(HEIGHT).rotate((0, 0, 0), (0, 0, 1), turned)
    drawing = hlr.draw(body, view, **AT_SIZE)
    ends = [pytest.approx(x, abs=NEAR) for x in (-RADIUS, RADIUS)]
    assert rims(drawing) == [(z, *ends) for z in (0.0, HEIGHT)]
    assert len(drawing.visible) == 4 and not drawing.hidden
    picture(drawing)


def test_the_outside_of_a_stepped_shaft_is_closed():
    body = cq.Workplane("YZ").circle(8).extrude(10).faces(">X").workplane().circle(12).extrude(20)
    for view in ("front", "back", "top", "bottom"):
        drawing = hlr.draw(body, view, **{**AT_SIZE, "hidden": False})
        assert len(drawing.visible) == 3 + 4, view
