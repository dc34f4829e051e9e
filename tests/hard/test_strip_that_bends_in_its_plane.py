"""The flat top of a thread: a strip that bends within its own plane.

In (u, v) it is a straight rectangle, and no chord leaves the plane by much, so a triangle may be as long as the strip.
In space such a triangle cuts across the bend: it covers what lies beside the strip, and the strip's own edges.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr


def side(widths: np.ndarray, pitch: float) -> cq.Edge:
    """Around the z axis through 90 degrees, from the radius 17. One polynomial: no knot divides the strip."""
    turn = np.linspace(0.0, np.pi / 2, 8)
    x, y, z = (17 + widths) * np.cos(turn), (17 + widths) * np.sin(turn), pitch * turn / (2 * np.pi)
    return cq.Edge.makeBezier([cq.Vector(*p) for p in np.stack([x, y, z], axis=1)])


@pytest.mark.parametrize("pitch", [0.0, 3.0])
@pytest.mark.parametrize("scale", [1.0, 5.0, 20.0])
@pytest.mark.parametrize(("width", "end"), [(0.2, 0.018), (0.2, 0.2), (0.02, 0.02), (1.0, 0.05), (3.0, 0.05)])
def test_a_strip_hides_nothing_beside_it(width, end, scale, pitch):
    inner, outer = side(np.zeros(8), pitch), side(np.linspace(width, end, 8), pitch)
    # Between the inner side and the chord from its first to its middle point, and below both.
    first, quarter, middle = (inner.positionAt(share) for share in (0, 0.25, 0.5))
    place = quarter * 0.5 + (first + middle) * 0.25 - cq.Vector(0, 0, 3)
    model = [cq.Face.makeRuledSurface(inner, outer), cq.Workplane().box(0.2, 0.2, 0.2).translate(place.toTuple()).val()]
    drawing = hlr.draw(cq.Compound.makeCompound(model), "top", scale=scale, hidden=True, details=True)
    assert len(drawing.visible) == 8
    assert not [line for line in drawing.lines if not line.visible]
