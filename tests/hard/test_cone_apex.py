"""A cone whose apex points at the viewer, and away: generators that vanish, and one that is edge-on.

Within half its angle from the axis a cone has no outline, beyond it two, whose places follow from the angle alone.
At the half angle itself the apex falls upon the rim. The apex is an edge without length; meshes are coarsest there.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import kinds, like, ring, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

RADIUS, HEIGHT = 10.0, 20.0
HALF = float(np.degrees(np.arctan(RADIUS / HEIGHT)))
APEX = (0, 0, HEIGHT)


def cone():
    return cq.Solid.makeCone(RADIUS, 0, HEIGHT)


def tilted(degrees):
    return turn((0, 0, 1), (0, 1, 0), degrees)


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0, 1e-7, 5, 20, HALF - 1, HALF, 180, 180 - 20])
def test_within_its_angle_only_the_rim(degrees, picture):
    drawing = hlr.draw(cone(), tilted(degrees), **AT_SIZE)
    like(drawing, expect(drawing, ring(RADIUS)))
    assert {visible for _, visible in kinds(drawing)} == {True}
    if degrees == 20:
        picture(drawing)


@pytest.mark.parametrize("degrees", [HALF + 3, 45, 60, 80])
def test_beyond_it_two_generators_and_the_near_part_of_the_rim(degrees, picture):
    drawing = hlr.draw(cone(), tilted(degrees), **AT_SIZE)
    # The normal (h cos a, h sin a, r) is square to the direction (sin t, 0, cos t).
    where = float(np.degrees(np.arccos(-RADIUS / (HEIGHT * np.tan(np.radians(degrees))))))
    ends = [(RADIUS * np.cos(a), RADIUS * np.sin(a), 0) for a in np.radians([where, -where])]
    seen = [*ring(RADIUS, 0, -where, where), *((end, APEX) for end in ends)]
    like(drawing, expect(drawing, seen, ring(RADIUS, 0, where, 360 - where)))
    assert kinds(drawing) == {("sharp", True), ("sharp", False), ("outline", True)}
    if degrees == 60:
        picture(drawing, "side")


@pytest.mark.parametrize("nurbs", [False, True])
def test_half_a_cone_alone_has_no_outline_from_above(nurbs):
    """The face looks up everywhere. (Seen on the cones of plate_mode_samples_creo.stp of BRL-CAD.)"""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

    solid = cq.Solid.makeCone(10, 0, 30, angleDegrees=180)
    (face,) = [face for face in solid.Faces() if face.geomType() == "CONE"]
    if nurbs:
        face = cq.Shape.cast(BRepBuilderAPI_NurbsConvert(face.wrapped, True).Shape())
    drawing = hlr.draw(face, "top", accuracy=10 / 3000, **AT_SIZE)
    assert {kind for kind, _ in kinds(drawing)} == {"boundary"}
