"""A wall with ripples, seen edge-on over a long way: which of its ridges stands out farthest changes all the time.

The outline runs from one ridge over a valley to the next. The ridges are far apart in depth and not a hair's breadth
apart on paper, so the valleys between them are not hidden: nothing is missing along the border of the part.
"""

from __future__ import annotations

from pathlib import Path

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

NACELLE = Path(__file__).parents[1] / "data" / "nacelle.stp"
WALLS = (4, 5)


@pytest.fixture(scope="module")
def outlines():
    drawing = hlr.draw(NACELLE, "top", hidden=True, scale=0.1)
    return [line for line in drawing.lines if line.kind == "outline"]


def outlines_of(drawing: hlr.Drawing, face: int, visible: bool) -> list[hlr.Line]:
    return [line for line in drawing.lines if line.kind == "outline" and line.face == face and line.visible == visible]


@pytest.mark.parametrize(("view", "scale"), [("top", 0.1), ("bottom", 0.1), ("top", 0.2), ("bottom", 0.2)])
def test_the_border_of_the_part_is_drawn_without_a_gap(view, scale):
    """Where the ridges rise by as much as a fifth of the accuracy, too."""
    drawing = hlr.draw(NACELLE, view, hidden=True, scale=scale)
    for wall in WALLS:
        along = sorted(sorted((line.points[0][0], line.points[-1][0])) for line in outlines_of(drawing, wall, True))
        reached = along[0][0]
        for low, high in along:
            assert low - reached <= 0.05
            reached = max(reached, high)
        assert reached - along[0][0] > 900.0 * scale
        assert not outlines_of(drawing, wall, False), "a valley between two ridges counts as hidden"


def crest(height: float) -> cq.Face:
    """A crest along x with two ridges, 17 mm apart and this much higher than the valley between them.

    The higher one is the one in front, then the one behind, and so on: the outline runs across the valley.
    """
    apart, steep = 5.0, 0.05
    bend = height / (0.75 * apart**4)

    def level(x: float, y: float) -> float:
        ridges = -bend * (y**4 / 12.0 - apart**2 * y**2 / 2.0)
        return ridges + bend * apart**3 * np.sin(2.0 * np.pi * x / 25.0) * y - steep * max(abs(y) - 9.0, 0.0) ** 3

    along, across = np.linspace(0.0, 100.0, 161), np.linspace(-12.0, 12.0, 49)
    return cq.Face.makeSplineApprox([[cq.Vector(x, y, level(x, y)) for y in across] for x in along], tol=1e-7)


def test_a_ridge_of_several_accuracies_hides_the_valley_behind_it():
    """And one below the accuracy does not."""
    low, high = (hlr.draw(crest(height), "front", **AT_SIZE) for height in (0.02, 0.2))
    assert not outlines_of(low, 0, False)
    hidden = outlines_of(high, 0, False)
    assert sum(abs(line.points[-1][0] - line.points[0][0]) for line in hidden) > 40.0


def test_what_lies_behind_is_hidden_as_before(outlines):
    """The far side of the inlet, which bends inward: its outlines are 50 mm long on paper."""
    hidden = [line for line in outlines if not line.visible and line.face in (0, 1)]
    assert sum(float(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum()) for line in hidden) > 200.0


def test_the_nose_is_whole_where_its_surface_turns_over_in_its_last_bit(outlines):
    """The normals of the outer faces at the lip are opposite to those of the inner ones."""
    nose = [line for line in outlines if line.face in (2, 3)]
    assert len(nose) > 4
    assert not [line for line in nose if not line.visible]
