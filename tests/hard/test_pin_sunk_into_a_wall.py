"""A pin, sunk into a wall a little, seen so that the outline of the pin lies where it enters the wall.

On paper the two are less than the accuracy apart, along the line of sight many times as much. Lines are checked in
space: where the pin enters the wall, the line lies on both of them, all the way.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import ALL_LINES

ACCURACY = 0.05
RADIUS, FACETS, LOW, HIGH = 3.26, 24, 13.0, 26.0
CENTRE = np.array([60.99, -4.75])
WALL = 104.4 * np.array(
    [[0.5, 0.1], [0.56843, -0.00047], [0.57845, -0.01105], [0.58458, -0.01567], [0.59718, -0.0222]]
    + [[0.616575, -0.027038], [0.75, -0.05], [0.75, 0.1]]
)
"""Corners of the wall from above, around it; the pin stands below and to the left of it."""


def prism(around, low, high):
    n = len(around)
    points = [[*p, z] for z in (low, high) for p in around.tolist()]
    sides = [[i, (i + 1) % n, n + (i + 1) % n] for i in range(n)] + [[i, n + (i + 1) % n, n + i] for i in range(n)]
    caps = [[0, i + 1, i] for i in range(1, n - 1)] + [[n, n + i, n + i + 1] for i in range(1, n - 1)]
    return trimesh.Trimesh(points, [*sides, *caps], process=False)


def pin(turn):
    angle = np.radians(turn + np.arange(FACETS) * 360 / FACETS)
    return CENTRE + RADIUS * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def off(points, around):
    """(m,) how far points are from the outline of a prism, seen from above, and whether they lie in it."""
    a, d = around, np.roll(around, -1, axis=0) - around
    away = points[:, None, :2] - a
    t = np.clip((away * d).sum(axis=2) / (d * d).sum(axis=1), 0, 1)
    inside = (d[:, 0] * away[:, :, 1] - d[:, 1] * away[:, :, 0] >= 0).all(axis=1)
    return np.linalg.norm(away - t[:, :, None] * d, axis=2).min(axis=1), inside


def along(line):
    """Points along a line in space, also between its corners."""
    p = np.asarray(line.points3)
    share = np.linspace(0, 1, 9)[:, None, None]
    return (p[:-1] + share * (p[1:] - p[:-1])).reshape(-1, 3)


VIEWS = ["left", "right", (-1, 0.02, 0), "iso"]
TURNS = [-8.0, -7.5, -7.1, -4.0, 0.0, 3.0]
"""At -7.5 a facet of the pin lies along the line of sight from the left and from the right."""


@pytest.mark.parametrize("view", VIEWS, ids=str)
@pytest.mark.parametrize("turn", TURNS)
def test_the_line_between_them_lies_on_both_along_the_line_of_sight_too(view, turn):
    model = trimesh.util.concatenate([prism(WALL, LOW, HIGH), prism(pin(turn), 0.0, 60.0)])
    drawing = hlr.draw(model, view, scale=1, accuracy=ACCURACY, **ALL_LINES)
    lines = [line for line in drawing.lines if line.kind == "intersection"]
    assert lines
    for line in lines:
        points = along(line)
        from_pin, _ = off(points, pin(turn))
        from_wall, within = off(points, WALL)
        from_end = np.minimum(np.abs(points[:, 2] - LOW), np.abs(points[:, 2] - HIGH))
        from_wall = np.minimum(from_wall, np.where(within, from_end, np.inf))
        assert max(from_pin.max(), from_wall.max()) < 0.5 * ACCURACY, line
