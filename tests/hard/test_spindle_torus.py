"""A torus whose tube is thicker than its ring: a valid solid by every check of topology, that passes through itself.

The inner part of its one face is a lemon inside the body, hidden from everywhere; where the two meet, on the axis,
there is no edge. A program that trusts a valid solid not to pass through itself shows the lemon.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import Rays, arc, kinds, like, ring

import hlr
from support.at_size import AT_SIZE
from support.expected import expect, of_kind

MAJOR, MINOR = 3.0, 5.0
DIMPLE = (MINOR**2 - MAJOR**2) ** 0.5
"""Height on the axis at which the surface meets itself."""


def spindle():
    return cq.Solid.makeTorus(MAJOR, MINOR)


def test_along_its_axis_one_circle_and_the_lemon_hidden(picture):
    drawing = hlr.draw(spindle(), "top", **AT_SIZE)
    like(drawing, expect(drawing, ring(MAJOR + MINOR), ring(MINOR - MAJOR)))
    picture(drawing)


def test_from_the_side_the_lemon_is_hidden():
    """Seen in its plane: a stadium, its two inner half circles hidden, which run on to the dimples on the axis."""
    drawing = hlr.draw(spindle(), "front", **AT_SIZE)
    seen, unseen = [((-MAJOR, 0, s * MINOR), (MAJOR, 0, s * MINOR)) for s in (1, -1)], []
    for s in (1, -1):
        seen += arc((s * MAJOR, 0, 0), (s * MINOR, 0, 0), (0, 0, MINOR), -90, 90)
        unseen += arc((s * MAJOR, 0, 0), (s * MINOR, 0, 0), (0, 0, MINOR), 90, 270)
    # The tips of the lemon, and of the dimples, are where the mesh has its poles: its outline ends a little before.
    like(drawing, expect(drawing, seen, unseen), ends=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", (0.3, -1, 0.2), (0.1, 0.2, -1)])
def test_by_rays(view):
    """What is missing is not asked: the referee's mesh has sharp edges about its poles, which the solid has not."""
    rays = Rays(spindle())
    drawing = hlr.draw(spindle(), view, accuracy=rays.accuracy, **AT_SIZE)
    assert rays.wrong(drawing) == 0
    assert kinds(drawing) >= {("outline", True), ("outline", False)}
    for line in of_kind(drawing, "outline", True):
        across = np.hypot(line.points3[:, 0], line.points3[:, 1])
        inside = (across < MINOR - MAJOR + 0.01) & (np.abs(line.points3[:, 2]) < DIMPLE - 0.05)
        assert not inside.any(), "the lemon shows"
