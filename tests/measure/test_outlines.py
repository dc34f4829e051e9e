"""The error of an outline beside the place where two of its branches meet.

Of a disc with rounded rims, seen from the side, each rounding is edge-on along the quarter of a circle at either end, and
along the circle in which it meets the flat: a straight line in the image, tangent to both quarters. There N . V vanishes
with its derivatives.
"""

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.lab.measure.outlines import outline_errors
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.written import Written, written
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
    assert off.max() == pytest.approx(true.max(), abs=1e-3) == pytest.approx(shift, abs=0.01)
