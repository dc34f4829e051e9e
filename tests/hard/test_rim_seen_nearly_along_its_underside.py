"""The rim of a vase, seen nearly along its underside: less than a facet of the underside faces the viewer.

Seen in an example of build123d: the two outlines of this strip ended where it became narrower than a facet and began
anew behind, and between them a line was missing.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.measures import distances
from support.true_curves import on_paper

cq = pytest.importorskip("cadquery")
from OCP.ShapeUpgrade import ShapeUpgrade_ShapeDivideAngle  # noqa: E402

RADIUS, HEIGHT = 20.0, 5.0
NECK = 30.0
"""The angle between the axis and the underside where the rim begins, degrees."""


def rim(size):
    """A disc whose outer border begins at an angle to the axis, goes farther out and returns to its middle plane."""
    r, h, turn = size * RADIUS, size * HEIGHT, np.deg2rad(NECK)
    half = (
        cq.Workplane("XZ")
        .lineTo(r, 0)
        .spline(
            [(r + h / 2, h / 2), (r, h)],
            tangents=[(np.sin(turn), np.cos(turn)), (-1, 0)],
            includeCurrent=True,
        )
        .lineTo(0, h)
        .close()
    )
    return half.revolve(360, (0, 0, 0), (0, 1, 0))


def slopes(shape):
    """(n, 2) points (radius, height) of the rim's profile, and how far it goes out for each millimetre upward."""
    (edge,) = (edge for edge in shape.edges().vals() if edge.geomType() == "BSPLINE")
    share = np.linspace(0.0, 0.999, 20_000)
    at = np.array([edge.positionAt(float(t)).toTuple() for t in share])
    tangents = np.array([edge.tangentAt(float(t)).toTuple() for t in share])
    return at[:, ::2], tangents[:, 0] / tangents[:, 2]


def in_quarters(shape):
    """The same with four faces around, as other programs write it."""
    divide = ShapeUpgrade_ShapeDivideAngle(np.pi / 2, shape.val().wrapped)
    assert divide.Perform()
    return cq.Workplane(cq.Shape.cast(divide.Result()))


def lower_line_of_the_rim(shape, toward):
    """(n, 3) points at which the rim above its underside is seen edge-on, before the underside and 60 degrees aside."""
    profile, slope = slopes(shape)
    tilt = np.hypot(*toward[:2]) / toward[2]
    points = []
    for turn in np.deg2rad(np.arange(-60.0, 60.1, 0.25)):
        last = np.flatnonzero(slope > tilt * np.cos(turn)).max()
        radius, height = profile[last]
        angle = np.arctan2(toward[1], toward[0]) + turn
        points.append([radius * np.cos(angle), radius * np.sin(angle), height])
    return np.array(points)


def largest_gap(shape, drawn, beyond, azimuth):
    """How far the lower line of the rim is from the outlines of `drawn`, at most, in accuracies."""
    steepest = np.arctan(slopes(shape)[1].max())
    elevation = np.pi / 2 - steepest + np.deg2rad(beyond)
    level = float(np.cos(elevation))
    angle = np.deg2rad(azimuth)
    toward = (level * float(np.cos(angle)), level * float(np.sin(angle)), float(np.sin(elevation)))
    drawing = hlr.draw(drawn, toward)
    outlines = [line for line in drawing.lines if line.kind == "outline" and line.visible]
    pieces = np.concatenate([np.stack([line.points[:-1], line.points[1:]], axis=1) for line in outlines])
    off = distances(on_paper(drawing, lower_line_of_the_rim(shape, toward)), pieces)
    return off.max() / drawing.accuracy.used


@pytest.mark.parametrize("size", [0.025, 1.0, 2000.0])
@pytest.mark.parametrize("beyond", [0.02, 0.1, 0.5, 1.0, 3.0])
def test_the_lower_line_of_the_rim_has_no_gap(size, beyond):
    shape = rim(size)
    assert largest_gap(shape, shape, beyond, -90.0) < 1.0


@pytest.mark.parametrize("size", [1.0, 2000.0])
@pytest.mark.parametrize("beyond", [0.02, 0.1])
@pytest.mark.parametrize("azimuth", [0.0, 3.0, 91.0])
def test_nor_where_the_seam_or_another_face_is_before_the_viewer(size, beyond, azimuth):
    shape = rim(size)
    assert largest_gap(shape, shape, beyond, azimuth) < 1.0
    assert largest_gap(shape, in_quarters(shape), beyond, azimuth) < 1.0
