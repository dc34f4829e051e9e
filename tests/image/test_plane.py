"""Which bodies one looks into after the near plane or a side of the frame has cut them."""

from __future__ import annotations

import numpy as np
import pytest

from hlr.image.plane import Plane, Window

Z = (0.0, 0.0, 1.0)
WINDOW = Window((5.0, 5.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (2.0, 1.0))
FILLS, BESIDE, ACROSS = (0.0, 0.0, 10.0, 10.0), (8.0, 0.0, 12.0, 10.0), (6.0, 0.0, 12.0, 10.0)


def border(x0, y0, x1, y1):
    """(4, 3) starts and ends of a rectangle in the plane z = 0, once around to the left."""
    corners = np.array([(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)])
    return corners, np.roll(corners, -1, axis=0)


def looked_into(plane, *borders):
    """Whether each border's body is looked into."""
    starts, ends = (np.concatenate([each[k] for each in borders]) for k in (0, 1))
    group = np.repeat(np.arange(len(borders)), 4)
    return plane.looked_into(starts, ends, group, len(borders)).tolist()


@pytest.mark.parametrize("around", [1, -1])
def test_a_body_that_fills_the_window_or_ends_in_it_is_looked_into(around):
    borders = [border(*each)[::around] for each in (FILLS, BESIDE, ACROSS)]
    assert looked_into(Plane(Z, 0.0, window=WINDOW), *borders) == [True, False, True]


def test_a_body_whose_cavity_holds_the_window_is_not_looked_into():
    outer, cavity = border(-9.0, -9.0, 19.0, 19.0), border(*FILLS)[::-1]
    wall = tuple(np.concatenate([a, b]) for a, b in zip(outer, cavity, strict=True))
    assert Plane(Z, 0.0, window=WINDOW).looked_into(*wall, np.zeros(8, int), 1).tolist() == [False]


def test_without_a_window_all_that_is_cut_is_looked_into_and_through_a_side_nothing():
    borders = [border(*each) for each in (FILLS, BESIDE)]
    assert looked_into(Plane(Z, 0.0), *borders) == [True, True]
    assert looked_into(Plane(Z, 0.0, side=True), *borders) == [False, False]
