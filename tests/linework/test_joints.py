"""What of a face lies under a part that rests on it."""

import numpy as np
import pytest

from hlr.linework.hatching import sides_of
from hlr.linework.joints import covered, is_covered, joint_borders


def square(x0, y0, x1, y1):
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], float)


FACE = [square(0, 0, 10, 10)]


@pytest.mark.parametrize(
    ("cover", "found"),
    [
        (square(2, 2, 4, 4), True),
        (square(-5, -5, 20, 20), True),
        (square(10, 0, 20, 10), False),
        (square(30, 0, 40, 10), False),
        (square(0, 0, 10, 10), True),
    ],
)
def test_a_face_is_covered_where_something_lies_on_it_and_not_beside_it(cover, found):
    assert is_covered(FACE, sides_of([cover])) == found
    assert not is_covered(FACE, np.zeros((0, 2, 2)))


def test_strokes_go_on_under_covers_that_overlap():
    strokes = np.array([[(0.0, 5.0), (10.0, 5.0)]])
    found = covered(strokes, sides_of([square(2, 2, 6, 6), square(4, 4, 8, 8)]))
    assert found.tolist() == [[[2.0, 5.0], [8.0, 5.0]]]


@pytest.mark.parametrize(
    ("cover", "lines"),
    [
        (square(2, 2, 4, 4), [[(2, 2), (4, 2), (4, 4), (2, 4), (2, 2)]]),
        (square(0, 0, 10, 10), []),
        (square(-5, 2, 5, 20), [[(0, 2), (5, 2), (5, 10)]]),
        (square(0, 0, 5, 10), [[(5, 0), (5, 10)]]),
        (square(5, -3, 20, 10), [[(5, 10), (5, 0)]]),
        (square(-3, 0, 20, 10), []),
    ],
)
def test_the_border_of_a_cover_is_drawn_inside_the_face_alone(cover, lines):
    found = joint_borders(FACE, [cover], 0.01)
    assert [line.tolist() for line in found] == [[list(map(float, point)) for point in line] for line in lines]
