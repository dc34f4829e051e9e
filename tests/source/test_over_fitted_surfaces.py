"""Surfaces that a program fitted to points or to a border: they overshoot, and turn within a fraction of a face.

Two faces whose chord error once could not be proved, so that OpenCASCADE meshed them. Of the first, only triangles
beside two chords of its border were too coarse, and all chords of the border were divided. The other is a ripple that
was fitted to a net of points; beside its border it runs out into spikes fifty times as long, in which the points of a
mesh come to lie one after another.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from hlr.source import open_source
from hlr.source.cad.occt_collections import new_collection

cq = pytest.importorskip("cadquery")

ANGLE = 0.5
"""Radians."""


def filled():
    """A face between two arcs and a line, filled by OpenCASCADE."""
    a, b, c = (cq.Vector(*p) for p in ((0, 0, 0), (20, 0, 0), (20, 20, 0)))
    arcs = [((a, b), (10, 0, 6)), ((b, c), (24, 10, -5))]
    border = [cq.Edge.makeThreePointArc(start, cq.Vector(*by), end) for (start, end), by in arcs]
    return cq.Face.makeNSidedSurface([*border, cq.Edge.makeLine(c, a)], [])


def ripple(count=24, wide=20.0, high=8.0, long=2.5):
    """sin(r) / r fitted to a net of points."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.GeomAPI import GeomAPI_PointsToBSplineSurface
    from OCP.gp import gp_Pnt

    net = new_collection("point_net", 1, count, 1, count)
    places = np.linspace(-wide, wide, count)
    for i, x in enumerate(places, 1):
        for j, y in enumerate(places, 1):
            net.SetValue(i, j, gp_Pnt(x, y, high * np.sinc(math.hypot(x, y) / long / math.pi)))
    return cq.Face(BRepBuilderAPI_MakeFace(GeomAPI_PointsToBSplineSurface(net).Surface(), 1e-6).Face())


@pytest.mark.parametrize(("make", "deflection", "chords"), [(filled, 0.0025, 260), (ripple, 1.25, 1000)])
def test_they_are_meshed_with_few_chords(make, deflection, chords):
    meshed = open_source(make()).mesh(deflection, ANGLE)
    assert (meshed.rescued, meshed.lost) == (0, 0)
    (part,) = meshed.parts
    sides = np.sort(part.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, times = np.unique(sides, axis=0, return_counts=True)
    assert 50 < np.count_nonzero(times == 1) < chords
