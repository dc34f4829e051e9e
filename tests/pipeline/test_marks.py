"""The letters of details on FreeCAD's pages stand where they can be read."""

import numpy as np
import pytest

from hlr.pipeline.page.marks import TURNS, free_place

AT = 10.0 * np.array([[np.cos(turn), np.sin(turn)] for turn in np.radians(TURNS)])


def crosses(place, off=0.0):
    """A line beside a place."""
    return place + np.array([[-3.0, off], [3.0, off]])


@pytest.mark.parametrize(
    ("lines", "found"),
    [
        ([], 0),
        ([crosses(AT[2])], 0),
        ([crosses(AT[0])], 1),
        ([crosses(AT[0]), crosses(AT[1], 2.0)], 2),
        # One point is no line.
        ([AT[:1]], 0),
        # Lines through all places: the farthest one is beside the fifth.
        ([crosses(place, 1.5 if number == 4 else 0.5) for number, place in enumerate(AT)], 4),
    ],
)
def test_the_first_place_without_lines_is_taken(lines, found):
    assert free_place(np.zeros(2), 10.0, lines) == pytest.approx(AT[found])
