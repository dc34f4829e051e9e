"""The box of a part is around all of it, and close, though few curves and surfaces are looked at more than roughly."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

from hlr.source import open_source

WAVE = [(0, 0), (4, 6), (9, -5), (15, 2), (20, 0)]
SHAPES = {
    # An edge turns between its ends, beyond all corners.
    "spline outline": lambda: cq.Workplane().spline(WAVE).lineTo(20, -1).lineTo(0, -1).close().extrude(2),
    # Only a face bulges beyond its edges.
    "bulging loft": lambda: (
        cq.Workplane().rect(8, 8).workplane(offset=5).rect(14, 11).workplane(offset=5).rect(8, 8).loft()
    ),
    "twisted": lambda: cq.Workplane().rect(10, 3).twistExtrude(20, 100),
    "pipe along a spline": lambda: (
        cq.Workplane("YZ").circle(1).sweep(cq.Workplane("XY").spline([(0, 0), (8, 5), (16, -5), (24, 0)]))
    ),
    "turned spline": lambda: cq.Workplane().moveTo(1, 0).spline([(6, 4), (2, 9), (5, 14)], includeCurrent=True)
    .lineTo(0, 14).lineTo(0, 0).close().revolve(250, (0, 0, 0), (0, 1, 0)),
    "half a torus": lambda: cq.Workplane(cq.Solid.makeTorus(10, 3)).intersect(cq.Workplane().box(30, 13, 30)),
    "dome": lambda: cq.Workplane().box(10, 10, 10).intersect(cq.Workplane().sphere(6.3)),
    "rounded box": lambda: cq.Workplane().box(10, 8, 6).edges().fillet(1.5),
    "straight and spline": lambda: cq.Workplane().box(40, 40, 1).union(
        cq.Workplane().spline(WAVE).lineTo(20, -1).lineTo(0, -1).close().extrude(2)
    ),
}  # fmt: skip
TURNS = {"as built": (0, 0, 0), "turned": (25, 40, 70)}


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("name", SHAPES)
def test_it_is_around_the_part_and_close(name, turn):
    shape = SHAPES[name]()
    for axis, degrees in zip(((1, 0, 0), (0, 1, 0), (0, 0, 1)), TURNS[turn], strict=True):
        shape = shape.rotate((0, 0, 0), axis, degrees)
    source = open_source(shape)
    low, high = source.bounds()
    size = float(np.linalg.norm(high - low))
    # Points of the mesh lie on the faces themselves.
    points = np.concatenate([part.points for part in source.mesh(size / 50_000, 0.1).parts])
    assert (low <= points.min(axis=0) + 1e-6 * size).all() and (high >= points.max(axis=0) - 1e-6 * size).all()
    slack = np.concatenate([points.min(axis=0) - low, high - points.max(axis=0)])
    assert (slack <= (2e-5 if name in BY_EDGES else 0.16) * size).all(), slack / size


BY_EDGES = ("spline outline", "rounded box", "straight and spline")
"""They reach farthest on their edges. Other faces are taken by their poles, or over their whole range of (u, v)."""
