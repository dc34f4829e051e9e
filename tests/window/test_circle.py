"""A round window: what lines of every kind keep of themselves, against points sampled along them."""

import numpy as np
import pytest

from hlr.drawing.curve import Arc, Bezier
from hlr.drawing.drawing import DrawnView
from hlr.drawing.line import Line
from hlr.window.frame import Circle
from hlr.window.lines import cut_lines

FLAT = DrawnView("top", "orthographic", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
MIDDLE, RADIUS = (3.0, -2.0), 5.0
WINDOW = Circle(FLAT, 1.0, MIDDLE, RADIUS)


def line(points, curve=None):
    points = np.array(points, float)
    return Line("sharp", True, 0, None, None, points, np.column_stack([points, np.zeros(len(points))]), curve=curve)


def arc(centre, axes, angles):
    curve = Arc(np.array(centre, float), np.array(axes, float), np.array(angles, float))
    return line(curve.at(np.linspace(*angles, 60)), curve)


def chain(degree, points):
    curve = Bezier(degree, np.array(points, float))
    return line(curve.at(np.linspace(0.0, (len(points) - 1) // degree, 60)), curve)


def fine(each, count=200001):
    """Many points along a line."""
    match each.curve:
        case Arc():
            return each.curve.at(np.linspace(*each.curve.angles, count))
        case Bezier():
            return each.curve.at(np.linspace(0.0, (len(each.curve.points) - 1) // each.curve.degree, count))
    ends = np.arange(len(each.points), dtype=float)
    at = np.linspace(0.0, ends[-1], count)
    return np.stack([np.interp(at, ends, each.points[:, axis]) for axis in (0, 1)], axis=1)


def length(points, kept=None):
    steps = np.hypot(*np.diff(points, axis=0).T)
    return float(steps.sum() if kept is None else steps[kept[:-1] & kept[1:]].sum())


rng = np.random.default_rng(7)
LINES = {
    "polyline": line([(-9, -9), (0, 0), (12, -3), (2, -8), (3, 9)]),
    "chord of one long side": line([(-100, -1), (100, -1)]),
    "circle": arc((6, 1), [(4, 0), (0, 4)], (0.3, 0.3 + 2 * np.pi)),
    "backward arc": arc((6, 1), [(4, 0), (0, 4)], (4.0, -1.0)),
    "ellipse": arc((3, -2), [(7, 1), (-0.3, 2.1)], (0.0, 2 * np.pi)),
    "ellipse, four times through": arc((3, -2), [(6, 0), (0, 4)], (0.1, 0.1 + 2 * np.pi)),
    "quadratic": chain(2, [(-3, -9), (4, 12), (9, -7), (14, -26), (0, -2)]),
    "cubic": chain(3, [(-4, -9), (20, 12), (-16, 8), (9, -9), (12, -12), (1, -20), (2, 3)]),
    **{f"random {i}": chain(3, rng.uniform(-8, 12, (7, 2))) for i in range(6)},
}


@pytest.mark.parametrize("name", LINES)
def test_what_is_kept_is_what_lies_inside(name):
    whole = LINES[name]
    pieces, cuts = cut_lines([whole], WINDOW)
    places = fine(whole)
    inside = np.hypot(*(places - MIDDLE).T) <= RADIUS
    assert cuts == 1 and bool(pieces) == inside.any()
    assert sum(length(fine(piece)) for piece in pieces) == pytest.approx(length(places, inside), abs=0.01)
    for piece in pieces:
        assert np.hypot(*(fine(piece) - MIDDLE).T).max() <= RADIUS + 1e-9
        # Ends lie on the circle, or are those of the line.
        for end in piece.points[[0, -1]]:
            own = np.abs(whole.points[[0, -1]] - end).max(axis=1).min()
            assert abs(np.hypot(*(end - MIDDLE)) - RADIUS) < 1e-9 or own == 0.0
        assert type(piece.curve) is type(whole.curve)
        assert np.allclose(piece.points3[:, :2], piece.points)


def test_lines_inside_stay_the_same_and_those_outside_go():
    inside, outside = line([(1, -2), (5, -3)]), line([(8.1, -7), (8.2, 7)])
    assert cut_lines([inside, outside], WINDOW) == ((inside,), 1)


def test_a_circle_around_the_window_goes_and_the_window_itself_stays():
    around, same = (arc(MIDDLE, [(r, 0), (0, r)], (0.0, 2 * np.pi)) for r in (6.0, RADIUS))
    pieces, _ = cut_lines([around, same], WINDOW)
    assert len(pieces) == 1 and length(fine(pieces[0])) == pytest.approx(2 * np.pi * RADIUS)


def test_a_line_that_touches_the_window_leaves_nothing():
    pieces, _ = cut_lines([line([(-20, 3), (20, 3)]), arc((10, -2), [(2, 0), (0, 2)], (0.0, 2 * np.pi))], WINDOW)
    assert sum(length(piece.points) for piece in pieces) < 0.01
