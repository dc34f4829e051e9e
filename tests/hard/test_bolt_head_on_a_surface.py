"""The head of a bolt rests on a plate: two coplanar faces, one upon the other, and a rim that lies in both planes.

The rim of the head's lower face is seen in front and hidden behind; the hole under it is hidden altogether. Rounding
must neither hide the front half nor let the hole through the head.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, compound, faultless, like, ring, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

HEAD, HEIGHT, SHANK, HOLE = 8.0, 5.0, 4.0, 4.5
HALF, THICK = 25.0, 6.0
VIEW = turn((0, -1, 0), (1, 0, 0), -40)


def model(tilt=0.0):
    plate = cq.Workplane().box(2 * HALF, 2 * HALF, THICK).translate((0, 0, -THICK / 2)).faces(">Z").workplane()
    bolt = cq.Workplane().circle(HEAD).extrude(HEIGHT).union(cq.Workplane().circle(SHANK).extrude(-THICK))
    both = compound(plate.hole(2 * HOLE).val(), bolt.val())
    return both.rotate((0, 0, 0), (1, 2, 3), tilt)


@pytest.mark.slow
@pytest.mark.parametrize("tilt", [0, 33])
def test_the_front_half_of_the_rim_is_seen_and_the_hole_is_not(tilt, picture):
    """Turned in space the planes are equal only up to rounding; the picture is the same."""
    view, up = (turn(v, (1, 2, 3), tilt) for v in (VIEW, (0, 0, 1)))
    drawing = hlr.draw(model(tilt), view, up=up, **AT_SIZE)
    flat = hlr.draw(model(), VIEW, **AT_SIZE)
    seen, unseen = box_edges((-HALF, -HALF, -THICK), (HALF, HALF, 0), VIEW)
    seen += ring(HEAD, HEIGHT) + ring(HEAD, 0, 180, 360)
    seen += [((x, 0, 0), (x, 0, HEIGHT)) for x in (HEAD, -HEAD)]
    unseen += ring(HEAD, 0, 0, 180)
    for radius in (SHANK, HOLE):
        unseen += ring(radius, 0) + ring(radius, -THICK)
        unseen += [((x, 0, -THICK), (x, 0, 0)) for x in (radius, -radius)]
    like(drawing, expect(flat, seen, unseen))
    if not tilt:
        picture(drawing, twice=1.0)


@pytest.mark.slow
def test_by_rays():
    for drawing in faultless(model(), model(), ["iso", (1, 3, 0.1), (0.3, 0.2, -1)]):
        assert drawing.lines
