"""Ten thousand faces that meet at one vertex: whatever is looked up per vertex is looked up ten thousand times.

Every generator of the cone starts where all the others do: at the apex every decision is a tie.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import Ink, agrees, expect, on_paper, pieces
from support.measures import length

COUNT = 10_000
RADIUS, HEIGHT = 20.0, 30.0


def cone(radii):
    """Closed, apex first, the centre of the base last."""
    n = len(radii)
    t = np.arange(n) * (2 * np.pi / n)
    rim = np.stack([radii * np.cos(t), radii * np.sin(t), np.zeros(n)], axis=1)
    i = np.arange(n)
    after = (i + 1) % n
    sides = np.stack([0 * i, i + 1, after + 1], axis=1)
    base = np.stack([0 * i + n + 1, after + 1, i + 1], axis=1)
    return np.concatenate([[(0, 0, HEIGHT)], rim, [(0, 0, 0)]]), np.concatenate([sides, base])


@pytest.mark.slow
def test_from_the_side_a_cone_is_a_triangle(picture):
    points, triangles = cone(np.full(COUNT, RADIUS))
    drawing = hlr.draw((points, triangles), "front", **AT_SIZE)
    corners = [(-RADIUS, 0, 0), (RADIUS, 0, 0), (0, 0, HEIGHT)]
    agrees(drawing, expect(drawing, [(corners[i], corners[i - 1]) for i in range(3)]))
    picture(drawing)


@pytest.mark.parametrize("view", ["iso", (1, 0.1, 0.5)])
def test_obliquely_two_generators_touch_the_base(picture, view):
    points, triangles = cone(np.full(COUNT, RADIUS))
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    d = np.asarray(drawing.view.direction)
    # The normal at the angle t is (H cos t, H sin t, R): square to the view where cos(t - s) = -R dz / (H |dxy|).
    middle = np.arctan2(d[1], d[0])
    half = np.arccos(-RADIUS * d[2] / (HEIGHT * np.hypot(d[0], d[1])))

    def rim(start, end):
        t = np.linspace(start, end, 400)
        return on_paper(drawing, np.stack([RADIUS * np.cos(t), RADIUS * np.sin(t), 0 * t], axis=1))

    sides = [(points[0], RADIUS * np.array([np.cos(t), np.sin(t), 0])) for t in (middle - half, middle + half)]
    seen = np.concatenate([expect(drawing, sides).visible, pieces([rim(middle - half, middle + half)])])
    agrees(drawing, Ink(seen, pieces([rim(middle + half, middle - half + 2 * np.pi)])))
    if view == "iso":
        picture(drawing, "iso")


def test_from_above_and_from_below_it_is_a_circle():
    for view in ("top", "bottom"):
        drawing = hlr.draw(cone(np.full(COUNT, RADIUS)), view, **AT_SIZE)
        t = np.linspace(0, 2 * np.pi, 721)
        circle = np.stack([RADIUS * np.cos(t), RADIUS * np.sin(t), 0 * t], axis=1)
        agrees(drawing, Ink(pieces([on_paper(drawing, circle)]), np.zeros((0, 2, 2))))


def test_a_pleated_cone_shows_all_its_ridges_from_above():
    n = 200
    points, triangles = cone(np.where(np.arange(n) % 2, RADIUS, RADIUS / 2))
    drawing = hlr.draw((points, triangles), "top", accuracy=0.01, **AT_SIZE)
    rim = points[1:-1]
    wanted = [(points[0], p) for p in rim] + list(zip(rim, np.roll(rim, -1, axis=0), strict=True))
    assert sum(map(length, drawing.lines)) > n * RADIUS / 2
    assert len(wanted) == 2 * n
    agrees(drawing, expect(drawing, wanted), step=2.0)
