"""Lines and the smooth curves that the kernel made of contours: put together, each keeps its own numbers."""

from __future__ import annotations

import numpy as np

from hlr.curve import Bezier
from hlr.linework.contours import with_contours
from hlr.linework.exact import CUBIC, POLYLINE, polylines

CURVE = np.array([[10.0, 0.0], [12.0, 5.0], [17.0, -4.0], [20.0, 1.0]])


def two_lines():
    flat = np.array([[0.0, 0.0], [1.0, 1.0], [10.5, 0.0], [20.0, 1.5]])
    return polylines(np.array([0, 2, 4], np.int32), flat, np.column_stack([flat, np.zeros(4)]))


def test_one_contour_among_lines_becomes_a_curve_between_the_ends_of_its_line():
    found = {
        "curve_offsets": np.array([0, 0, 4]),
        "curve": CURVE,
        "curve_bounds": np.array([[[0.0, 0.0]] * 2, [CURVE.min(axis=0), CURVE.max(axis=0)]]),
    }
    lines = two_lines()
    drawn = with_contours(lines, found)
    assert drawn.form.tolist() == [POLYLINE, CUBIC]
    curves = drawn.curves(np.zeros(2))
    assert list(curves) == [1]
    assert isinstance(curves[1], Bezier) and curves[1].degree == 3
    assert curves[1].points.tolist() == [[10.5, 0.0], [12.0, 5.0], [17.0, -4.0], [20.0, 1.5]]
    # The line without a curve is as it was; the other's bounds hold its curve as well.
    assert drawn.bounds[0].tolist() == lines.bounds[0].tolist()
    assert (drawn.bounds[1, 0] <= CURVE.min(axis=0)).all() and (drawn.bounds[1, 1] >= CURVE.max(axis=0)).all()
    assert lines.form.tolist() == [POLYLINE, POLYLINE], "the lines given stay as they are"


def test_without_contours_the_lines_are_as_they_were():
    lines = two_lines()
    nothing = {"curve_offsets": np.zeros(3, int), "curve": np.zeros((0, 2)), "curve_bounds": np.zeros((2, 2, 2))}
    assert with_contours(lines, nothing) is lines
