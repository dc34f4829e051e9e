"""Intersection lines follow the true surfaces, not their meshes: arcs are arcs, and what ends at one ends on it.

A mesh is off its surface by the chord error, and two meshes cross as far beside the true line as that over the sine of
the angle between the surfaces. The accuracy is coarse here, so that a line of the meshes is seen to be one.
"""

from __future__ import annotations

import math
import re

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.drawing.curve import Arc, Bezier
from support.at_size import AT_SIZE

COARSE = 0.3
OBLIQUE = (0.5, -0.7, 0.4)


def pin_in_a_plate():
    plate = cq.Workplane().box(40, 40, 4).val()
    pin = cq.Workplane().circle(8).extrude(20).val()
    return [plate, pin]


def bar_through_a_cylinder():
    """A bar along x with edges at y = +-3, z = 7 and 13, through an upright cylinder of radius 8."""
    cylinder = cq.Workplane().circle(8).extrude(20).val()
    bar = cq.Workplane().box(30, 6, 6).translate((0, 0, 10)).val()
    return [cylinder, bar]


def pipes(radius, other):
    """Along z and along x."""
    one = cq.Workplane().circle(radius).extrude(40).translate((0, 0, -20)).val()
    return [one, cq.Workplane("YZ").circle(other).extrude(40).translate((-20, 0, 0)).val()]


def dome_in_a_plate_at_a_small_angle():
    """The top of a ball is 0.8 above the plate, so both meet at an angle of 7 degrees."""
    plate = cq.Workplane().box(60, 60, 10).translate((0, 0, -5)).val()
    dome = cq.Workplane().sphere(100).translate((0, 0, -99.2)).intersect(cq.Workplane().box(50, 50, 16))
    return [plate, dome.val()]


def intersections(drawing, visible=None):
    return [line for line in drawing.lines if line.kind == "intersection" and visible in (None, line.visible)]


def drawn(bodies, view=OBLIQUE, accuracy=COARSE, **options):
    return hlr.draw(bodies, view, accuracy=accuracy, **(AT_SIZE | {"hidden": True} | options))


def test_a_pin_in_a_plate_meets_it_in_one_circle():
    found = intersections(drawn(pin_in_a_plate()))
    assert len(found) == 2 and all(isinstance(line.curve, Arc) for line in found)
    for line in found:
        assert np.allclose(np.hypot(*line.points3.T[:2]), 8, atol=1e-9)
    turns = [abs(line.curve.angles[1] - line.curve.angles[0]) for line in found]
    assert sum(turns) == pytest.approx(2 * math.pi)


def test_the_circle_of_a_dome_is_where_it_is_at_a_small_angle_too():
    found = intersections(drawn(dome_in_a_plate_at_a_small_angle()))
    assert found and all(isinstance(line.curve, Arc) for line in found)
    radius = math.sqrt(100**2 - 99.2**2)
    for line in found:
        assert np.allclose(np.hypot(*line.points3.T[:2]), radius, atol=1e-6)


@pytest.mark.parametrize("perspective", [None, hlr.Perspective(fov=40.0)])
def test_edges_end_where_the_true_line_begins(perspective):
    drawing = drawn(bar_through_a_cylinder(), perspective=perspective)
    corner = math.sqrt(8**2 - 3**2)
    corners = np.array([(sign * corner, y, z) for sign in (1, -1) for y in (3, -3) for z in (7, 13)])
    edges = [line for line in drawing.lines if line.part == 1 and line.kind == "sharp"]
    for lines, least in ((intersections(drawing), 7), (edges, 2)):
        ends = np.concatenate([line.points3[[0, -1]] for line in lines])
        away = np.linalg.norm(corners[:, None] - ends[None], axis=2)
        # No end is beside a corner: it is there, or it is far away, where an outline hides the corner.
        assert not ((away > 1e-6) & (away < 0.075)).any()
        assert np.count_nonzero(away.min(axis=1) < 1e-6) >= least


def test_pipes_meet_in_smooth_curves_on_both():
    found = intersections(drawn(pipes(8, 5)))
    assert found and all(isinstance(line.curve, Bezier) for line in found)
    for line in found:
        points = line.points3
        assert np.abs(np.hypot(points[:, 0], points[:, 1]) - 8).max() < 1e-4
        assert np.abs(np.hypot(points[:, 1], points[:, 2]) - 5).max() < 1e-4


def test_picture(picture):
    tee = [*pipes(8, 5), cq.Workplane().box(40, 40, 4).translate((0, 0, -12)).val()]
    picture(hlr.draw(tee, OBLIQUE, accuracy=0.05, **AT_SIZE))


def test_pipes_of_one_radius_meet_in_two_ellipses_that_cross():
    drawing = drawn(pipes(8, 8), "iso")
    found = intersections(drawing)
    for line in found:
        x, y, z = line.points3.T
        assert np.abs(np.abs(x) - np.abs(z)).max() < COARSE and np.abs(np.hypot(x, y) - 8).max() < COARSE
    # One of them is seen edge-on.
    text = drawing.to_svg()
    straight = [line for line in found if line.curve is None and line.visible]
    assert len(straight) == 1
    assert re.search(r'<path d="M[-.\d ]+l[-.\d ]+" data-other="1"/>', text)


def test_a_true_curve_is_cut_near_the_eye_as_elsewhere():
    bodies = pin_in_a_plate()
    near = drawn(bodies, "front", perspective=hlr.Perspective((12.0, -9.0, 7.0), (0.0, 4.0, 2.0), 80.0))
    found = intersections(near)
    assert found and all(line.curve is not None for line in found)
    for line in found:
        assert np.abs(np.hypot(*line.points3.T[:2]) - 8).max() < 1e-6


def test_lines_of_planar_faces_stay_as_they_are():
    boxes = [cq.Workplane().box(20, 20, 20).val(), cq.Workplane().box(30, 7, 5).rotate((0, 0, 0), (1, 2, 3), 20).val()]
    found = intersections(drawn(boxes))
    assert found and all(line.curve is None for line in found)


def test_meshes_have_no_true_surfaces():
    trimesh = pytest.importorskip("trimesh")
    ball, pin = trimesh.creation.icosphere(2, 10), trimesh.creation.cylinder(4, 40)
    found = intersections(drawn(trimesh.util.concatenate([ball, pin])))
    assert found and all(line.curve is None for line in found)
