"""A bowl by `shell()`: its inner face lies at a distance from a surface that touches the axis, where a surface of
revolution has a pole, and often goes on beyond it. The kernel meshes it, and draws its outline."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.measures import distances, length

WALL = 1.5
SIZES = (0.02, 1.0, 2000.0)
"""A bowl of less than a millimetre, of 40 mm, and of 80 m."""


def bowl(meridian: str, size: float) -> cq.Shape:
    """Height 20, radius 20, wall WALL, open at the top, all times `size`; its meridian begins on the axis."""
    start = cq.Workplane("XZ").moveTo(0, 0)
    if meridian == "arc":  # at an angle to the axis: the inner face has a tip
        curve = start.threePointArc((14, 6), (20, 20))
    else:
        curve = start.spline([(12, 3), (20, 20)], tangents=[(1, 0), (0.2, 1)], includeCurrent=True)
    whole = curve.lineTo(0, 20).close().revolve(360, (0, 0, 0), (0, 1, 0))
    return whole.faces(">Z").shell(-WALL).val().scale(size)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("meridian", ["arc", "spline"])
def test_the_inner_outline_runs_at_the_wall_thickness_from_the_outer_one(meridian, size):
    shape = bowl(meridian, size)
    kinds = {face.geomType() for face in shape.Faces()}
    assert "OFFSET" in kinds, kinds
    drawing = hlr.draw(shape, view="front", hidden=True, scale=1.0 / size)
    assert not drawing.notes
    outer, inner = (_outlines(drawing, visible) for visible in (True, False))
    assert sum(map(length, outer)) > sum(map(length, inner)) > 50.0
    points = np.concatenate([line.points for line in inner])
    pieces = np.concatenate([np.stack([line.points[:-1], line.points[1:]], axis=1) for line in outer])
    # Near the rim the nearest place of the outer outline may be beyond its end.
    below = points[points[:, 1] < pieces[..., 1].max() - 3.0]
    assert len(below) > 5
    off = distances(below, pieces)
    assert np.allclose(off, WALL, atol=0.06), (off.min(), off.max())


def _outlines(drawing: hlr.Drawing, visible: bool) -> list[hlr.Line]:
    return [line for line in drawing.lines if line.visible == visible and line.kind == "outline"]


def test_seen_from_above_and_below():
    shape = bowl("spline", 1.0)
    rims = [edge.Length() for edge in shape.faces(">Z").Edges()]
    assert len(rims) == 2
    for view, visible in (("top", rims), ("bottom", [max(rims)])):
        drawing = hlr.draw(shape, view=view, hidden=False, scale=1.0)
        assert not drawing.notes
        assert np.allclose(sorted(length(line) for line in drawing.lines), sorted(visible), rtol=1e-3)
