"""Two cylinders of one radius crossing at right angles, as separate parts: a clash whose two curves cross themselves.

The curves of intersection are two ellipses in the planes x = z and x = -z, and the generators of each cylinder end
where they enter the other. Equal radii make the contact tangential at two points, where piercing is ill-conditioned.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import compound, faultless, like

import hlr
from support.at_size import AT_SIZE
from support.expected import expect, of_kind

RADIUS, HALF = 8.0, 25.0


def crossing(other=RADIUS):
    along_x = cq.Workplane("YZ").workplane(offset=-HALF).circle(RADIUS).extrude(2 * HALF).val()
    along_z = cq.Workplane().workplane(offset=-HALF).circle(other).extrude(2 * HALF).val()
    return compound(along_x, along_z)


def test_generators_end_where_they_enter(picture):
    """From the front both outlines are seen, as far as the crossing; within they lie inside the other cylinder."""
    drawing = hlr.draw(crossing(), "front", **AT_SIZE)
    seen, unseen = [], []
    for s in (-RADIUS, RADIUS):
        for end in (-HALF, HALF):
            corner = RADIUS if end > 0 else -RADIUS
            seen += [((corner, 0, s), (end, 0, s)), ((s, 0, corner), (s, 0, end))]
        unseen += [((-RADIUS, 0, s), (RADIUS, 0, s)), ((s, 0, -RADIUS), (s, 0, RADIUS))]
    for end in (-HALF, HALF):
        seen += [((end, 0, -RADIUS), (end, 0, RADIUS)), ((-RADIUS, 0, end), (RADIUS, 0, end))]
    like(drawing, expect(drawing, seen, unseen), without=["intersection"])
    picture(drawing)


@pytest.mark.slow
@pytest.mark.parametrize("other", [RADIUS, 0.6 * RADIUS])
def test_by_rays(other):
    for drawing in faultless(crossing(other), crossing(other), ["front", "iso", (0.3, -1, 0.4)]):
        assert drawing.lines


def test_the_ellipses_are_drawn():
    drawing = hlr.draw(crossing(), "front", **AT_SIZE)
    found = of_kind(drawing, "intersection", visible=True)
    points = np.concatenate([line.points3 for line in found])
    near = 3 * drawing.accuracy.used
    # Where both are tangent to one plane, a place on both is known to the root of the accuracy only.
    tangent = (drawing.accuracy.used * RADIUS) ** 0.5
    # On both cylinders, before them both, and from corner to corner.
    off = np.abs(np.abs(points[:, 0]) - np.abs(points[:, 2]))
    assert off.max() < tangent and off[np.abs(points[:, 0]) > 4 * tangent].max() < near
    assert np.abs(np.hypot(points[:, 1], points[:, 2]) - RADIUS).max() < near
    assert points[:, 1].max() < near
    length = sum(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum() for line in found)
    assert length == pytest.approx(2 * 2 * RADIUS * 2**0.5, rel=0.02)
