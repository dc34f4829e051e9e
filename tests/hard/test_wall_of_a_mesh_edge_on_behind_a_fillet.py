"""A post on a flange as a mesh, filleted at its root and rounded at its end, seen from the flange.

The side of the post is seen exactly edge-on, and what lies before and behind it is turned away. Of a closed body that
is not counted, so no border of the side was a contour, and the circle of the post was missing among the hidden lines.
From the end the rounding is turned toward the viewer, and the circle is there. Seen on a part of the NIST that has
triangles alone: 440 mm of it.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.meshes import grid

FLANGE, THICK, POST, HIGH, ROOT, END = 20.0, 5.0, 8.0, 20.0, 2.0, 1.0
SIDES, STEPS = 72, 12
ACCURACY = 0.02


def post():
    """Rings from the bottom to the top, and a disc at either end."""
    turn = np.linspace(0.0, np.pi / 2, STEPS + 1)
    root = np.stack([POST + ROOT * (1 - np.sin(turn)), THICK + ROOT * (1 - np.cos(turn))], axis=1)
    end = np.stack([POST - END * (1 - np.cos(turn)), THICK + HIGH - END * (1 - np.sin(turn))], axis=1)
    radii, heights = np.concatenate([[(FLANGE, 0.0), (FLANGE, THICK)], root, end]).T
    angles = np.arange(SIDES) * 2.0 * np.pi / SIDES
    rings = np.stack([np.outer(radii, np.cos(angles)), np.outer(radii, np.sin(angles))], axis=-1)
    points, triangles = grid(np.dstack([rings, np.repeat(heights[:, None], SIDES, axis=1)]), around=True)
    low, high, last = len(points), len(points) + 1, len(points) - SIDES
    discs = [[(low, (i + 1) % SIDES, i), (high, last + i, last + (i + 1) % SIDES)] for i in range(SIDES)]
    ends = [(0.0, 0.0, 0.0), (0.0, 0.0, THICK + HIGH)]
    return np.concatenate([points, ends]), np.concatenate([triangles[:, ::-1], np.reshape(discs, (-1, 3))])


def radii(drawing, visible):
    """The least and the largest distance from the axis of each line of this visibility."""
    lines = [np.hypot(*line.points3[:, :2].T) for line in drawing.lines if line.visible == visible]
    return sorted((far.min(), far.max()) for far in lines)


def near(radius):
    """A circle that is not exactly in its corners: a contour is smoothed within the accuracy."""
    return pytest.approx((radius, radius), abs=ACCURACY)


def test_the_circle_of_the_post_is_hidden_behind_the_flange(picture):
    drawing = hlr.draw(post(), (0, 0, -1), accuracy=ACCURACY, **AT_SIZE)
    assert radii(drawing, True) == [near(FLANGE)]
    assert radii(drawing, False) == [near(POST)]
    (hidden,) = [line for line in drawing.lines if not line.visible]
    assert np.array_equal(hidden.points[0], hidden.points[-1])
    picture(drawing)


def test_it_is_visible_from_the_end_and_drawn_once():
    drawing = hlr.draw(post(), (0, 0, 1), accuracy=ACCURACY, **AT_SIZE)
    assert radii(drawing, True) == [near(r) for r in (POST, FLANGE)]
    assert radii(drawing, False) == []
