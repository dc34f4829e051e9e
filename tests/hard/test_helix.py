"""A rod wound to a spiral: from each side its turns cover one another, and its outline crosses itself in the image.

The outline of such a tube has cusps, where it ends in the middle of the surface; drawn from the mesh they come as
zigzags that switch between visible and hidden from one facet to the next.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import of_kind, wrong_by_rays
from support.measures import length, placed
from support.meshes import grid

RADIUS, ROD, PITCH, TURNS = 15.0, 2.0, 12.0, 3


def helix(around=32, along=80):
    """A tube about a helix, open at both ends."""
    t = np.linspace(0, 2 * np.pi * TURNS, along * TURNS + 1)[:, None]
    v = np.arange(around)[None, :] * (2 * np.pi / around)
    slope = PITCH / (2 * np.pi)
    size = np.hypot(RADIUS, slope)
    out = np.stack([np.cos(t), np.sin(t), 0 * t], axis=-1)
    up = np.stack([slope * np.sin(t), -slope * np.cos(t), RADIUS + 0 * t], axis=-1) / size
    middle = np.stack([RADIUS * np.cos(t), RADIUS * np.sin(t), slope * t], axis=-1)
    return grid(middle + ROD * (np.cos(v)[..., None] * out + np.sin(v)[..., None] * up), around=True)


@pytest.mark.slow
@pytest.mark.parametrize("view", ["front", "iso", (1, -1, 0.2), "top"])
def test_rays_agree(picture, view):
    points, triangles = helix()
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    judged, wrong = wrong_by_rays(drawing, points, triangles)
    assert judged >= 15
    assert wrong <= judged // 200
    if view == "iso":
        picture(drawing, twice=1.0)


def test_from_above_it_is_two_circles_and_the_upper_end(picture):
    drawing = hlr.draw(helix(), "top", hidden=False, scale=1.0, smooth=False)
    # However it climbs, the tube reaches from R - r to R + r: its outlines are circles, each turn over the one below.
    radii = np.hypot(*np.concatenate([placed(drawing, x) for x in of_kind(drawing, "outline")]).T)
    assert np.minimum(abs(radii - RADIUS - ROD), abs(radii - RADIUS + ROD)) == pytest.approx(0, abs=0.05)
    (end,) = of_kind(drawing, "boundary")
    slope = PITCH / (2 * np.pi * RADIUS)
    # The upper end is a circle tilted by the slope of the helix, seen nearly on edge; turned up, so seen all round.
    assert np.ptp(end.points, axis=0) == pytest.approx([2 * ROD, 2 * ROD * np.sin(np.arctan(slope))], abs=0.02)
    picture(drawing, "top", twice=30.0)


def test_from_above_each_circle_is_there_once():
    drawing = hlr.draw(helix(), "top", hidden=False, scale=1.0, smooth=False)
    total = sum(map(length, of_kind(drawing, "outline")))
    assert total == pytest.approx(2 * np.pi * (RADIUS + ROD) + 2 * np.pi * (RADIUS - ROD), rel=0.01)
