"""A round post as wide as its block: its foot is two half circles, and each line lies on the edge that it names.

Where the outline of the post touches its foot, the visible end of the foot moves to that place along its circle. It was
moved past the end of its own edge, along the next one, whose own line was drawn there as well.
"""

from __future__ import annotations

import math

import cadquery as cq
import pytest

import hlr
from support.expected import doubled

ANGLES = range(1, 360, 8)


def post_on_a_block():
    block = cq.Workplane().box(16, 26, 10)
    return block.union(cq.Workplane().workplane(offset=5).circle(8).extrude(20)).val()


@pytest.mark.parametrize("height", [0.3, 0.8, 1.6])
def test_no_line_goes_beyond_its_edge(height):
    solid = post_on_a_block()
    edges = solid.Edges()
    assert sum(edge.geomType() == "CIRCLE" for edge in edges) == 3
    arcs = 0
    for degrees in ANGLES:
        angle = math.radians(degrees)
        drawing = hlr.draw(solid, (math.cos(angle), math.sin(angle), height), hidden=True, details=True)
        off = drawing.accuracy.used / drawing.scale
        for line in drawing.lines:
            if line.edge is not None and edges[line.edge].geomType() == "CIRCLE":
                ends = [cq.Vertex.makeVertex(*map(float, line.points3[k])) for k in (0, len(line.points3) // 2, -1)]
                assert max(edges[line.edge].distance(end) for end in ends) <= off, degrees
                arcs += 1
        assert doubled(drawing) <= 0.05, degrees
    assert arcs > 2 * len(ANGLES)


def test_picture(picture):
    picture(hlr.draw(post_on_a_block(), (0.2924, 0.9563, 1.6), hidden=True, scale=1.0))
