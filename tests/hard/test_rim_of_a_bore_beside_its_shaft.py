"""A shaft in a bore of its own size: the rim of the bore is seen up to where the outline of the shaft touches it.

From there on the outline goes on as the rim did. The facets of the shaft hide the rim a long way before that, and each
of the two lines is right within the accuracy, but a gap is seen between them.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.drawing.saving import render
from support.expected import doubled
from support.referee import exchange
from support.referee.broken import broken

RADIUS = 6.0


def bodies(turned: float) -> list[cq.Shape]:
    """turned: degrees between the seams of the shaft and of the bore."""
    plate = cq.Workplane("XY").box(30, 30, 8).faces(">Z").workplane().hole(2 * RADIUS)
    shaft = cq.Workplane("XY").circle(RADIUS).extrude(40).translate((0, 0, -20)).rotate((0, 0, 0), (0, 0, 1), turned)
    return [plate.val(), shaft.val()]


@pytest.mark.parametrize("accuracy", (0.2, 0.05, 0.01, 0.002))
@pytest.mark.parametrize("view", ("iso", (1.0, -2.0, 3.0), (3.0, -1.0, 1.0)))
@pytest.mark.parametrize("turned", (0.0, 3.0, 11.0, 17.0))
def test_the_rim_ends_where_the_outline_begins(turned, view, accuracy):
    drawing = hlr.draw(bodies(turned), view, accuracy=accuracy, hidden=True, scale=5.0)
    assert broken(exchange.parse(render(drawing, "json"))) == []
    assert doubled(drawing) == 0.0
    rims = [line for line in drawing.visible if line.kind == "sharp" and line.curve is not None]
    outlines = [end for line in drawing.visible if line.kind == "outline" for end in line.points[[0, -1]]]
    ends = np.array([end for line in rims for end in line.points[[0, -1]]])
    apart = np.linalg.norm(ends[:, None] - np.array(outlines), axis=2).min(axis=0)
    assert np.sort(apart)[:2].max() < accuracy


def test_it_looks_as_it_should(picture):
    picture(hlr.draw(bodies(11.0), "iso", hidden=True, scale=2.0))
