"""A hole that cuts into a countersink: the border of the cone is seen at a large angle, and a chord of it was hidden.

Where the cone is narrow, a triangle beside its border may fold over: its face is turned toward the viewer, it is not,
for the chord cuts off the bend. It was known that such a triangle must not hide the chord beside it. It also reached in
front of the next chord of the border, and hid a tenth of a millimetre of it.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

HOLE, RADIUS = (-0.047601998903720855, 2.6736850029459713), 2.525527235338341
SINK, TOP = (2.428972002126571, 4.416250701086598), 3.1365915693414372


def plate():
    sunk = cq.Workplane().box(40, 40, TOP, centered=(True, True, False)).faces(">Z").workplane(origin=(0, 0, TOP))
    sunk = sunk.center(*SINK).cskHole(2, 4, 82)
    return sunk.cut(cq.Workplane().center(*HOLE).circle(RADIUS).extrude(60, both=True))


def of_cone_and_hole(shape):
    """The numbers of the edges at which the wall of the hole cuts the cone, with the ends of each."""
    edges = shape.val().Edges()

    def cut(point):
        return abs(np.hypot(point.x - HOLE[0], point.y - HOLE[1]) - RADIUS) < 1e-6

    inside = [i for i, e in enumerate(edges) if all(cut(e.positionAt(t)) for t in (0.0, 0.3, 0.5, 1.0))]
    low = {i: np.ptp([edges[i].positionAt(t).z for t in np.linspace(0.0, 1.0, 9)]) for i in inside}
    return [i for i in inside if 0.1 < low[i] < TOP - 0.1]


@pytest.mark.parametrize("direction", [(1, 0, 1), (1, 0.2, 1), (0.8, -0.1, 1)])
@pytest.mark.parametrize("accuracy", [0.05, 0.02, 0.0125, 0.01, 0.007, 0.003])
def test_the_cut_through_the_cone_is_seen_in_one_piece(direction, accuracy, picture):
    shape = plate()
    drawing = hlr.draw(shape, direction, accuracy=accuracy, **AT_SIZE)
    # On the side of the viewer's right hand nothing lies in front of it, and it never runs along the sight.
    far = [
        i for i in of_cone_and_hole(shape) if any(x.edge == i and x.points3[:, 1].max() > 4.7 for x in drawing.lines)
    ]
    assert far
    for edge in far:
        lines = [line for line in drawing.lines if line.edge == edge and line.points3[:, 1].min() > 3.9]
        assert [line.visible for line in lines] == [True], [(x.visible, x.points[[0, -1]].tolist()) for x in lines]
    if (direction, accuracy) == ((1, 0, 1), 0.05):
        picture(drawing)
