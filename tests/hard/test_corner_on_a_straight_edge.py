"""A vertex in the middle of a straight edge of a face: the triangle that is filled in there has no area.

A shaft touches the edge between a flat end face and its fillet. The two halves of that edge are edges of the fillet,
and the mesher joins their ends. Once rounded, the triangle between the three may fold over and lie in front of the
edge by a step of the grid: that hides nothing.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

import hlr


@pytest.fixture(scope="module")
def part(tmp_path_factory):
    body = cq.Workplane().box(20, 12, 8).translate((14, 0, 0)).edges("|Z").fillet(3).faces(">Z").edges().fillet(1.5)
    slotted = body.cut(cq.Workplane("XZ").center(16, 2).circle(2.5).extrude(20, both=True))
    whole = slotted.union(slotted.mirror("YZ")).union(cq.Workplane("YZ").circle(3).extrude(6, both=True))
    path = tmp_path_factory.mktemp("part") / "part.brep"
    whole.val().exportBrep(str(path))
    return path


@pytest.mark.parametrize("scale", [2.0, 3.0, 4.0, 4.9, 5.0, 5.1, 5.5, 6.0])
def test_the_edge_beside_the_shaft_is_visible_above_it(part, scale):
    """From (-4, 3, z) the sight along (1, -1, 1) meets the shaft of radius 3 where z is at most 3 (sqrt(2) - 1)."""
    drawing = hlr.draw(part, "iso", scale=scale, hidden=True)
    along = [line for line in drawing.lines if (np.abs(line.points3[:, :2] - [-4.0, 3.0]) < 1e-6).all()]
    seen = [sorted(line.points3[[0, -1], 2]) for line in along if line.visible]
    assert len(seen) == 1
    assert seen[0] == pytest.approx([3.0 * (math.sqrt(2.0) - 1.0), 2.5], abs=0.05 / scale)
    assert any(not line.visible for line in along)
