"""A spring at its solid height: one solid, whose turns lie on one another, or within micrometres on paper.

Between two turns there is a line. An outline is moved off its face before visibility is decided: there it was inside
the next turn, and the line had gaps.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

WIRE, RADIUS, TURNS = 2.0, 6.0, 5


def spring(gap, wire=WIRE, radius=RADIUS):
    """Turns whose sections are `gap` apart along the axis."""
    pitch = wire + gap
    path = cq.Wire.makeHelix(pitch, TURNS * pitch, radius)
    start = cq.Workplane("XZ", origin=(radius, 0, 0))
    return start.circle(wire / 2).sweep(cq.Workplane(obj=path), isFrenet=True)


def widest_space(drawing, share, accuracy=0.05):
    """The widest space between lines that are seen, top to bottom, along an upright line at this share of the width.

    A gap in a line that is no longer than twice the accuracy, which no pen shows, is none.
    """
    points = np.concatenate([line.points for line in drawing.visible])
    low, high = points[:, 0].min(), points[:, 0].max()
    x = low + share * (high - low)
    heights = []
    for line in drawing.visible:
        for (xa, ya), (xb, yb) in zip(line.points[:-1], line.points[1:], strict=True):
            if xa != xb and min(xa, xb) - accuracy <= x < max(xa, xb) + accuracy:
                heights.append(ya + (yb - ya) * (x - xa) / (xb - xa))
    return np.diff(sorted(heights)).max()


VIEWS = ["front", (1.0, 0.02, 0.01), (0.3, -1.0, 0.05), (0.3, -1.0, -0.08)]
SHARES = np.linspace(0.2, 0.8, 61)


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("gap", [0.0, 0.0003, 0.001, 0.002])
def test_the_line_between_two_turns_has_no_gap(gap, view):
    drawing = hlr.draw(spring(gap), view, scale=3, accuracy=0.05, details=True)
    # A turn is as high as its wire is thick; where a line is missing, the space is two turns high.
    assert max(widest_space(drawing, share) for share in SHARES) < 1.2 * WIRE * 3


@pytest.mark.parametrize("factor", [0.01, 1.0, 100.0])
def test_of_any_size(factor):
    """From a wire of 20 micrometres to one of 20 cm, each as large on paper."""
    solid = spring(0.0, WIRE * factor, RADIUS * factor)
    drawing = hlr.draw(solid, "front", scale=3 / factor, accuracy=0.05, details=True)
    assert max(widest_space(drawing, share) for share in SHARES) < 1.2 * WIRE * 3


@pytest.mark.parametrize("edge", [-3.0, -1.41, 0.0, 0.77])
def test_beside_a_lid_over_a_part_of_it(edge):
    """What the lid hides from far away is not compared once more; what it leaves free is."""
    lid = cq.Workplane().box(100, 1, 100).translate((edge - 50.0, -20.0, 0.0))
    drawing = hlr.draw([spring(0.0).val(), lid.val()], "front", scale=3, accuracy=0.05, details=True)
    seen = SimpleNamespace(visible=[line for line in drawing.visible if line.part == 0])
    assert min(line.points3[:, 0].min() for line in seen.visible) > edge - 0.05
    assert max(widest_space(seen, share) for share in np.linspace(0.01, 0.6, 60)) < 1.2 * WIRE * 3


def test_in_perspective():
    drawing = hlr.draw(spring(0.0), "front", perspective=hlr.Perspective(), accuracy=0.01, **AT_SIZE)
    spaces = [widest_space(drawing, share) for share in (0.3, 0.4, 0.5, 0.6, 0.7)]
    assert max(spaces) < 1.6 * WIRE


def test_hidden_lines_stay_hidden():
    """What the next turn covers by more than a contact is not seen through it."""
    drawing = hlr.draw(spring(0.0), (0.0, -1.0, 0.6), scale=3, accuracy=0.05, details=True)
    apart = hlr.draw(spring(0.05), (0.0, -1.0, 0.6), scale=3, accuracy=0.05, details=True)

    def seen(drawn):
        return sum(line.length_mm for line in drawn.visible)

    assert math.isclose(seen(drawing), seen(apart), rel_tol=0.02)


@pytest.mark.parametrize("view", [(0.3, -1.0, 0.05), (0.3, -1.0, -0.08), (0.0, -1.0, 0.1), (1.0, 0.02, 0.01)])
@pytest.mark.parametrize(("wire", "radius"), [(2.0, 6.0), (0.5, 3.0)])
def test_the_near_side_hides_the_far_side(wire, radius, view):
    """An outline of the far side, moved off its face, came out beside the turn in front of it: a spur at each turn."""
    drawing = hlr.draw(spring(0.0, wire, radius), view, scale=1, accuracy=0.05, details=True)
    points = np.concatenate([line.points for line in drawing.visible])
    places = np.concatenate([line.points3 for line in drawing.visible])
    nearer_than_axis = places[:, :2] @ drawing.view.direction[:2]
    # Past the turns at the bottom and at the top, whose far side is seen above or below the near one.
    between = (points[:, 1] > 2 * wire) & (points[:, 1] < 3.5 * wire)
    assert between.sum() > 20
    assert nearer_than_axis[between].min() > -wire
