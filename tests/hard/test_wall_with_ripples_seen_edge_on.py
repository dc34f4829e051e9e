"""A wall with ripples, seen edge-on over a long way: which of its ridges stands out farthest changes all the time.

The outline runs from one ridge over a valley to the next. The ridges are far apart in depth and not a hair's breadth
apart on paper, so the valleys between them are not hidden: nothing is missing along the border of the part.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hlr

NACELLE = Path(__file__).parents[1] / "data" / "nacelle.stp"
WALLS = (4, 5)


@pytest.fixture(scope="module")
def outlines():
    drawing = hlr.draw(NACELLE, "top", hidden=True, scale=0.1)
    return [line for line in drawing.lines if line.kind == "outline"]


@pytest.mark.parametrize("wall", WALLS)
def test_the_border_of_the_part_is_drawn_without_a_gap(outlines, wall):
    along = [sorted((line.points[0][0], line.points[-1][0])) for line in outlines if line.face == wall and line.visible]
    along.sort()
    reached = along[0][0]
    for low, high in along:
        assert low - reached <= 0.05
        reached = max(reached, high)
    assert reached - along[0][0] > 90.0


def test_no_valley_between_ridges_counts_as_hidden(outlines):
    assert not [line for line in outlines if line.face in WALLS and not line.visible]


def test_what_lies_behind_is_hidden_as_before(outlines):
    """The far side of the inlet, which bends inward: its outlines are 50 mm long on paper."""
    hidden = [line for line in outlines if not line.visible and line.face in (0, 1)]
    assert sum(float(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum()) for line in hidden) > 200.0


def test_the_nose_is_whole_where_its_surface_turns_over_in_its_last_bit(outlines):
    """The normals of the outer faces at the lip are opposite to those of the inner ones."""
    nose = [line for line in outlines if line.face in (2, 3)]
    assert len(nose) > 4
    assert not [line for line in nose if not line.visible]
