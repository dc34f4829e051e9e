"""A bent tube dives into a block: its outline ends on the intersection line, which is visible from just there on.

The line is tangential to the outline where they meet, so a facet that turns over a little too soon or too late leaves a
long gap, or a line behind the outline, though each line is within the accuracy.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.drawing.saving import render
from support.referee import exchange
from support.referee.broken import broken

RADIUS, TUBE = 25.0, 3.0


def bodies(height: float) -> list[cq.Shape]:
    tube = cq.Workplane("XY").center(0, RADIUS).circle(TUBE).revolve(180, (-1, -RADIUS), (1, -RADIUS))
    block = cq.Workplane("XY").rect(TUBE, RADIUS).extrude(height)
    return [tube.val(), block.val()]


@pytest.mark.parametrize("view", ("iso", "iso-ne", (1.0, -2.0, 1.5)))
@pytest.mark.parametrize("accuracy", (0.2, 0.05, 0.02, 0.01, 0.005))
def test_the_intersection_line_begins_where_the_outline_ends(accuracy, view):
    drawing = hlr.draw(bodies(RADIUS + TUBE), view, accuracy=accuracy, hidden=True, scale=5.0)
    outlines = [end for line in drawing.visible if line.kind == "outline" for end in line.points[[0, -1]]]
    begins = [end for line in drawing.visible if line.kind == "intersection" for end in line.points[[0, -1]]]
    apart = np.linalg.norm(np.array(outlines)[:, None] - np.array(begins), axis=2)
    assert apart.min() < 4.0 * accuracy
    assert broken(exchange.parse(render(drawing, "json"))) == []


def test_it_looks_as_it_should(picture):
    picture(hlr.draw(bodies(RADIUS), "iso", hidden=True, scale=2.0))
