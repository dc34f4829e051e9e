"""A foot that is sunk into a round or leaning wall by little more than the accuracy: some line is seen around it.

Seen at a slant, the edge of the foot lies behind the wall by more than a contact, and is hidden. The line in which the
two meet was left out up to a depth two and a half times as great: in between, nothing was drawn. So was a dome that
stands out of a plate by that little, and the line in which the two meet was taken from the meshes. Seen in a kitchen
pot, the strap of whose handle enters the wall by 0.07 mm on paper: 16 mm of it were missing from above.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr import _kernel
from support.at_size import AT_SIZE
from support.meshes import as_parts, box, moved, rotation

ACCURACY = 0.05
DEPTHS = [0.2, 0.6, 1.2, 1.6, 2.0, 2.4, 2.8, 4.0, 10.0]
"""Accuracies."""
WALL = 60.0


def strap_on_a_drum(depth):
    """A drum along z, and a strap that ends on it: the end is sunk by this everywhere."""
    drum = cq.Workplane().cylinder(160, WALL)
    strap = cq.Workplane().box(120, 30, 20).translate((110, 0, 20)).cut(cq.Workplane().cylinder(400, WALL - depth))
    return cq.Assembly().add(drum, name="drum").add(strap, name="strap")


def foot_of_the_strap():
    """Its near side and its top, where they meet the drum."""
    height, across = np.linspace(10.0, 30.0, 200), np.linspace(-15.0, 15.0, 200)
    side = np.stack([np.full(200, np.sqrt(WALL**2 - 15.0**2)), np.full(200, -15.0), height], axis=1)
    top = np.stack([np.sqrt(WALL**2 - across**2), across, np.full(200, 30.0)], axis=1)
    return np.concatenate([side, top])


def farthest(drawing, points):
    """How far the farthest of these points is from what is drawn visible, millimetres on paper."""
    ends = [np.concatenate([x.points[:-1], x.points[1:]], axis=1) for x in drawing.lines if x.visible]
    seen = points @ np.stack([drawing.view.right, drawing.view.up], axis=1) * drawing.scale - np.array(drawing.origin)
    segments = np.concatenate(ends)
    none, zero = np.zeros(len(seen), np.int32), np.zeros(len(segments), np.int32)
    return _kernel.nearest(np.ascontiguousarray(seen), none, np.ascontiguousarray(segments), zero, 100.0)[0].max()


@pytest.mark.parametrize("view", ["front", "iso", (1, -2, 0.3), (2, -1, 1.2)])
@pytest.mark.parametrize("depths", DEPTHS)
def test_a_line_is_seen_around_the_foot_of_a_strap(depths, view):
    drawing = hlr.draw(strap_on_a_drum(depths * ACCURACY), view, accuracy=ACCURACY, **AT_SIZE)
    # The front view shows no more of the top than its silhouette.
    foot = foot_of_the_strap()[: 200 if view == "front" else None]
    assert farthest(drawing, foot) < 3.0 * ACCURACY


@pytest.mark.parametrize("depths", DEPTHS)
def test_a_line_is_seen_around_the_foot_of_a_mesh(depths):
    """A post on a plate that leans by 65 degrees, as meshes, from above."""
    turn = rotation((0, 1, 0), np.radians(65.0))
    plate, post = box((-60, -60, -10), (60, 60, 0)), box((-20, -15, -depths * ACCURACY), (20, 15, 60))
    drawing = hlr.draw(
        as_parts(*(moved(x, lambda p: p @ turn.T) for x in (plate, post))), "top", accuracy=ACCURACY, **AT_SIZE
    )
    t = np.linspace(-1.0, 1.0, 200)[:, None]
    # From above, the post hides one of these two sides of its foot.
    upper = np.array([[-20.0, 0.0, 0.0]]) + t * np.array([[0.0, 15.0, 0.0]])
    lower = np.array([[20.0, 0.0, 0.0]]) + t * np.array([[0.0, 15.0, 0.0]])
    distances = [farthest(drawing, side @ turn.T) for side in (upper, lower)]
    assert min(distances) < 3.0 * ACCURACY


@pytest.mark.parametrize("depths", [1.3, 1.6, 2.4, 4.0])
def test_a_low_dome_meets_its_plate_in_a_circle(depths):
    radius, rise = 300.0, depths * ACCURACY
    plate = cq.Workplane().box(200, 200, 20).translate((0, 0, -10))
    ball = cq.Workplane().sphere(radius).translate((0, 0, rise - radius))
    cap = ball.intersect(cq.Workplane().box(150, 150, 30))
    model = cq.Assembly().add(plate, name="plate").add(cap, name="cap")
    drawing = hlr.draw(model, "top", accuracy=ACCURACY, **AT_SIZE)
    (line,) = [x for x in drawing.lines if x.kind == "intersection" and np.abs(x.points3[:, 2]).max() < 1e-6]
    wide = np.sqrt(2.0 * radius * rise - rise**2)
    assert line.visible
    assert np.abs(np.hypot(*line.points3[:, :2].T) - wide).max() < 0.1 * ACCURACY


def test_less_than_the_accuracy_is_a_contact():
    drawing = hlr.draw(strap_on_a_drum(0.6 * ACCURACY), "iso", accuracy=ACCURACY, **AT_SIZE)
    assert not [x for x in drawing.lines if x.kind == "intersection"]
