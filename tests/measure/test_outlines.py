"""The error of an outline beside the place where two of its branches meet.

Of a disc with rounded rims, seen from the side, each rounding is edge-on along the quarter of a circle at either end,
and along the circle in which it meets the flat: a straight line in the image, tangent to both quarters. There N . V
vanishes with its derivatives.
"""

from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.lab.measure.outlines import outline_errors
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.written import Written, in_model, written
from hlr.source import open_source
from support.at_size import AT_SIZE

RADIUS, HEIGHT, ROUNDING = 40.0, 50.0, 12.5


def off_the_outline(points):
    """(n,) the distance of points (n, 2), from the middle of the disc, to a rectangle with rounded corners."""
    beyond = np.abs(points) - (RADIUS - ROUNDING, HEIGHT / 2 - ROUNDING)
    return np.abs(np.hypot(*np.maximum(beyond, 0.0).T) + np.minimum(beyond.max(axis=1), 0.0) - ROUNDING)


@pytest.fixture(scope="module")
def disc():
    return open_source(cq.Workplane().circle(RADIUS).extrude(HEIGHT).edges("%CIRCLE").fillet(ROUNDING))


def measured_and_true(disc, view, shift):
    drawing = hlr.draw(disc, view, **AT_SIZE)
    form = written(drawing)
    form = Written(form.points + (0.0, shift), form.line)
    off, names = outline_errors(disc, drawing, form, Paper.of(drawing), 10**6)
    judged = np.array([line.kind == "outline" and line.face is not None for line in drawing.lines])[form.line]
    true = off_the_outline(form.points[judged] + np.array(drawing.origin) - (0.0, HEIGHT / 2))
    assert len(off) == len(names) == len(true) > 100
    return off, true


@pytest.mark.parametrize("view", ["front", "right", (1.0, 0.3, 0.0)])
def test_where_branches_meet_the_error_is_the_distance_to_the_outline(disc, view):
    off, true = measured_and_true(disc, view, 0.0)
    assert true.max() < 0.02
    assert off == pytest.approx(true, abs=1e-3)
    # Never less than the distance.
    assert (off > true - 1e-6).all()


@pytest.mark.parametrize("shift", [0.06, 0.2])
def test_an_outline_beside_it_is_off_by_as_much(disc, shift):
    off, true = measured_and_true(disc, "front", shift)
    assert off.max() == pytest.approx(true.max(), abs=1e-3) == pytest.approx(shift, abs=0.012)


def test_where_the_surface_is_nearly_edge_on_over_a_long_way_the_search_goes_on():
    """A wall whose slope is least 4 mm behind its outline, but not 0: from there, Newton's method has nowhere to go."""
    growth = np.polynomial.Polynomial([4.0, -1.0]) * np.polynomial.Polynomial([0.16, 0.0, 1.0]) * 1e-3
    height = growth.integ()
    across = np.linspace(-3.0, 6.0, 91)
    profile = [(10.0 + float(height(z)), float(z)) for z in across]
    body = cq.Workplane("YZ").moveTo(0.0, -3.0).lineTo(*profile[0]).spline(profile[1:], includeCurrent=True)
    model = open_source(body.lineTo(0.0, 6.0).close().extrude(20.0))
    drawing = hlr.draw(model, "top", accuracy=0.05, **AT_SIZE)
    outlines = [line for line in drawing.lines if line.kind == "outline"]
    assert len(outlines) == 1
    assert outlines[0].points3[:, 1:] == pytest.approx(np.array([[10.0 + height(4.0), 4.0]] * 2), abs=1e-3)
    # The same ink, said to lie where the slope is least.
    farther = replace(outlines[0], points3=outlines[0].points3 - (0.0, 0.0, 4.0))
    beside = replace(drawing, lines=tuple(farther if x is outlines[0] else x for x in drawing.lines))
    for of in (drawing, beside):
        off, _ = outline_errors(model, of, written(of), Paper.of(of), 10**6)
        assert len(off) > 3 and off.max() < 1e-3


@pytest.mark.parametrize("eye", [None, (20.0, 6.0, 75.0)])
def test_of_a_long_line_toward_the_eye_the_point_behind_each_point_on_paper_is_measured(eye):
    """The middle of a line on paper is not its middle in space: in perspective, here, they are 10 mm apart."""
    rod = open_source(cq.Workplane().circle(5).extrude(60))
    camera = None if eye is None else hlr.Perspective(eye=eye, target=(0.0, 0.0, 30.0))
    drawing = hlr.draw(rod, (20, 6, 45), accuracy=0.005, perspective=camera, **AT_SIZE)
    form, paper = written(drawing), Paper.of(drawing)
    points, line = form.middles(0.5)
    straight = np.array([len(each.points) == 2 for each in drawing.lines])[line]
    assert straight.sum() > 50
    behind = paper(in_model(drawing, points[straight], line[straight]))
    assert behind == pytest.approx(points[straight], abs=1e-3)
    off, _ = outline_errors(rod, drawing, form, paper, 10**6)
    assert len(off) and off.max() < 0.005
