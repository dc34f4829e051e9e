"""A loft from a rectangle to a circle, whose side turns over along a straight edge that is one chord.

At both ends the side is seen at a large angle, in front at the one, from behind at the other. In between it is seen
edge-on, and the edge is a contour of the body. Asked at the ends alone, it counted as an edge like any other. It was
then compared with the triangles of its own faces, and at some accuracies all of it was hidden.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

DIRECTION = (-1.3251259727511573, -0.8773221042622072, -0.5798432945906113)
TURNS_OVER = 0.7168
"""The share of the edge from where the body hides it: there N . V of the side is zero, by OpenCASCADE."""


def loft():
    rectangle = cq.Workplane().rect(19.234858991172565, 13.486228053437086)
    return rectangle.workplane(offset=18.088664084720364).circle(3.3721632423944987).loft(combine=True)


def seen_of(drawing, edge):
    """The stretches of a straight edge that are drawn visible, as shares of its length from its lower end."""
    ends = sorted((edge.startPoint().toTuple(), edge.endPoint().toTuple()), key=lambda p: p[2])
    a, b = (np.array([drawing.view.right, drawing.view.up]) @ np.array(end) - drawing.origin for end in ends)
    way = (b - a) / ((b - a) @ (b - a))
    found = []
    for line in drawing.lines:
        first, last = line.points[0] - a, line.points[-1] - a
        off = max(abs(way[0] * p[1] - way[1] * p[0]) for p in (first, last))
        if line.visible and line.edge is not None and off < 1e-4:
            found.append(tuple(sorted((float(first @ way), float(last @ way)))))
    return found


@pytest.mark.parametrize("accuracy", [0.2, 0.1, 0.05, 0.03, 0.02, 0.015, 0.01, 0.008, 0.005])
def test_the_edge_is_seen_until_the_side_turns_over(accuracy, picture):
    solid = loft().val()
    drawing = hlr.draw(solid, DIRECTION, accuracy=accuracy, **AT_SIZE)
    rising = [edge for edge in solid.Edges() if abs(edge.startPoint().z - edge.endPoint().z) > 1.0]
    partly = [seen for edge in rising if (seen := seen_of(drawing, edge)) and seen[0][1] < 0.9]
    assert len(partly) == 1 and len(partly[0]) == 1, partly
    assert partly[0][0] == pytest.approx((0.0, TURNS_OVER), abs=0.002 + 2.0 * accuracy / 14.0)
    if accuracy == 0.05:
        picture(drawing)
