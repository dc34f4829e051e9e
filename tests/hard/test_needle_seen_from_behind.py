"""A needle that is folded back under the face beside it: the crease along it is seen all the same.

A roof of two faces, whose ridge is short and was written with four digits. An exporter put a corner of the one face
beside the ridge, a little below the other face, and filled the gap with a needle. The viewer would see its back, under
the other face: so that face hid the crease, by half a thousandth of a millimetre.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import ALL_LINES

RIDGE = 0.255


def roof(beside, below):
    """(points, triangles): `beside` and `below`, how far the corner lies from the ridge, model units."""
    a, b, corner = (0, 0, 0), (RIDGE, 0, 0), (0.1, -beside, -below)
    front, back = (0.1, -60.1234, -20.4321), (0.1, 60.4321, -20.1234)
    points = np.array([a, b, corner, front, back])
    return points, np.array([[0, 3, 1], [0, 1, 2], [0, 2, 4], [2, 1, 4], [0, 4, 3], [1, 3, 4]])


def ridge(drawing, visible):
    """Length of the lines near the ridge."""
    near = [line for line in drawing.lines if line.visible == visible and np.abs(line.points3[:, 1]).max() < 0.01]
    return sum(float(np.hypot(*np.diff(line.points, axis=0).T).sum()) for line in near)


@pytest.mark.parametrize("view", [(0, 0, 1), (0, -0.2, 1), (0, 0.2, 1)])
@pytest.mark.parametrize(("beside", "below"), [(0.0004, 0.0005), (0.0002, 0.0006), (0.0006, 0.0004), (0.0001, 0.0001)])
def test_the_ridge_is_seen(view, beside, below):
    drawing = hlr.draw(roof(beside, below), view, scale=1.0, accuracy=0.01, **ALL_LINES)
    assert ridge(drawing, visible=True) == pytest.approx(RIDGE, rel=0.02)
    assert ridge(drawing, visible=False) == 0.0


def test_a_step_that_the_coordinates_support_is_no_needle():
    points, triangles = roof(0.02, 0.03)
    drawing = hlr.draw((points, triangles), (0, -0.2, 1), scale=1.0, accuracy=0.001, **ALL_LINES)
    ends = np.concatenate([line.points3[[0, -1]] for line in drawing.lines])
    assert np.isclose(ends, points[2], atol=1e-9).all(axis=1).any()
