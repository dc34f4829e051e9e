"""The edge of a cam seen from the side turns back at each of its dents, not at its two ends alone.

A closed edge was begun at the first turn, which may be the tip of a dent: the way from there to the end was drawn as
one line, and the rest beside it as another, with a gap of some hundredths of a millimetre between them.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

HEIGHT = 8.0


def cam(turned: float) -> cq.Workplane:
    """Three noses, the edges being one spline each."""
    angles = np.linspace(0, 2 * math.pi, 48, endpoint=False)
    points = [((10 + 4 * math.cos(3 * a)) * math.cos(a), (10 + 4 * math.cos(3 * a)) * math.sin(a)) for a in angles]
    body = cq.Workplane().spline(points, periodic=True).close().extrude(HEIGHT)
    return body.rotate((0, 0, 0), (0, 0, 1), turned)


def top_edge(drawing: hlr.Drawing) -> list[list[float]]:
    """The extent of each of its lines along x."""
    tops = [line.points3[:, 0] for line in drawing.lines if np.allclose(line.points3[:, 2], HEIGHT)]
    return sorted([float(x.min()), float(x.max())] for x in tops)


@pytest.mark.parametrize("turned", [90, 271])
def test_the_edge_is_one_line(turned, picture):
    drawing = hlr.draw(cam(turned), "front", **AT_SIZE)
    edge = np.concatenate([line.points3 for line in hlr.draw(cam(turned), "top", **AT_SIZE).visible])
    assert top_edge(drawing) == [pytest.approx([edge[:, 0].min(), edge[:, 0].max()], abs=0.01)]
    # At the tip of a dent it turns back between two corners of its polyline.
    picture(drawing, f"{turned}", twice=2.0 * drawing.accuracy.used)
