"""Bodies that pass through each other at a small angle: the line in which they meet, and edges that go through.

Each triangle by itself reaches hardly beyond the other surface, and a line that goes through it stays within the
contact tolerance for a long way. So whether that is a contact is decided by how far both surfaces come apart before
they cross again or end; and a line that an intersection line meets is hidden from there on.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.met import intersections

RADIUS = 200.0
FRONT = (0.0, -1.0, 0.0)


def dome_through_a_plate(depth):
    """A cap of a sphere, whose top is this much above the top of a plate."""
    plate = cq.Workplane().box(60, 60, 10).translate((0, 0, -5)).val()
    ball = cq.Workplane().sphere(RADIUS).translate((0, 0, depth - RADIUS))
    cap = ball.intersect(cq.Workplane().box(50, 50, 16)).val()
    return [plate, cap]


def cylinders_into_each_other(depth):
    """Two upright cylinders of radius 10, side by side along x."""
    one, other = (cq.Workplane().cylinder(30, 10).translate((x, 0, 0)).val() for x in (0, 20 - depth))
    return [one, other]


def half_cone_through_a_wall():
    """Half a cone that leans by 1.9 degrees; its straight edge at x = 0 goes through the wall at a height of 15."""
    cone = cq.Workplane(cq.Solid.makeCone(10, 9, 30)).intersect(cq.Workplane().box(20, 40, 80).translate((10, 0, 0)))
    wall = cq.Workplane().box(40, 4, 40).translate((0, -7.5, 20)).val()
    return [cone.val(), wall]


def met(bodies, accuracy):
    """The segments (n, 2, 3) of all intersection lines, seen or not."""
    found = [np.zeros((0, 2, 3))]
    with intersections(found):
        hlr.draw(bodies, "iso", accuracy=accuracy, **AT_SIZE)
    return np.concatenate(found)


@pytest.mark.parametrize("accuracy", [0.02, 0.05])
@pytest.mark.parametrize("depths", [4.0, 6.0, 20.0])
def test_a_dome_meets_the_plate_in_a_circle(depths, accuracy):
    depth = depths * accuracy
    segments = met(dome_through_a_plate(depth), accuracy)
    radius = math.sqrt(2 * RADIUS * depth - depth**2)
    # Aside by the chord error over the sine of the angle.
    assert np.abs(np.hypot(*segments.reshape(-1, 3).T[:2]) - radius).max() < accuracy * RADIUS / radius
    length = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).sum()
    assert length == pytest.approx(2 * math.pi * radius, rel=0.1)


@pytest.mark.parametrize("accuracy", [0.02, 0.05])
@pytest.mark.parametrize("depths", [4.0, 6.0, 20.0])
def test_parallel_cylinders_meet_in_two_lines(depths, accuracy):
    depth = depths * accuracy
    segments = met(cylinders_into_each_other(depth), accuracy)
    aside = math.sqrt(100 - (10 - depth / 2) ** 2)
    # The ends of the cylinders meet, too, in the planes of the ends.
    upright = segments[np.ptp(segments[:, :, 2], axis=1) > 0]
    assert np.abs(np.abs(upright[:, :, 1]) - aside).max() < accuracy * 10 / aside
    for side in (-1, 1):
        assert np.ptp(upright[np.sign(upright[:, 0, 1]) == side], axis=1)[:, 2].sum() == pytest.approx(30)


def test_picture(picture):
    drawing = hlr.draw(dome_through_a_plate(0.3), "iso", accuracy=0.05, **{**AT_SIZE, "hidden": False})
    picture(drawing)


@pytest.mark.parametrize("build", [dome_through_a_plate, cylinders_into_each_other])
def test_what_is_a_contact_has_no_line(build):
    assert not len(met(build(0.04), 0.05))


@pytest.mark.parametrize("accuracy", [0.1, 0.05, 0.02, 0.01])
def test_an_edge_ends_where_it_goes_through(accuracy):
    drawing = hlr.draw(half_cone_through_a_wall(), FRONT, accuracy=accuracy, **AT_SIZE)
    straight = [x for x in drawing.lines if x.part == 0 and x.edge is not None and np.abs(x.points3[:, 0]).max() < 1e-6]
    front = [x for x in straight if x.points3[:, 1].max() < 0]
    seen = [x.points3[:, 2] for x in front if x.visible and np.ptp(x.points3[:, 2]) > 1]
    assert seen and max(z.max() for z in seen) == pytest.approx(15.0, abs=accuracy)
    assert any(not x.visible and x.points3[:, 2].max() > 29.9 for x in front)
