"""A spring: a circle swept along a helix. One long face that covers itself from every side, its outline without end.

The outline of such a face has cusps at which it turns back behind the wire; the ray referee knows each place.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import faultless, once

import hlr
from support.at_size import AT_SIZE

RADIUS, PITCH, TURNS, WIRE = 8.0, 6.0, 1.5, 1.2


def spring():
    path = cq.Wire.makeHelix(PITCH, PITCH * TURNS, RADIUS)
    return cq.Workplane("XZ", origin=(RADIUS, 0, 0)).circle(WIRE).sweep(cq.Workplane(obj=path), isFrenet=True).val()


VIEWS = ["front", "iso", "top", (0.36, 0.86, 0.35)]


@pytest.mark.slow
def test_by_rays():
    for drawing in faultless(spring(), spring(), VIEWS, 2000):
        assert {line.kind for line in drawing.lines} == {"sharp", "outline"}


def test_its_outline_is_there_once():
    once(hlr.draw(spring(), "front", **AT_SIZE))


@pytest.mark.slow
def test_it_is_as_wide_and_high_as_helix_and_wire_say(picture):
    drawing = hlr.draw(spring(), "front", **AT_SIZE)
    x0, y0, x1, y1 = drawing.bounds
    near = 2 * drawing.accuracy.used
    assert x1 - x0 == pytest.approx(2 * (RADIUS + WIRE), abs=near)
    # The wire's section is square to the helix only on the way: its ends lie in the plane of the axis.
    assert y1 - y0 == pytest.approx(PITCH * TURNS + 2 * WIRE, abs=0.05)
    picture(drawing, twice=15.0, step=1.0)


def test_no_line_leaves_the_wire():
    """Each point of each line lies on the surface: one wire's radius from the helix."""
    drawing = hlr.draw(spring(), "iso", **AT_SIZE)
    t = np.linspace(-0.2, TURNS + 0.2, 20000)
    helix = np.stack([RADIUS * np.cos(2 * np.pi * t), RADIUS * np.sin(2 * np.pi * t), PITCH * t], axis=1)
    from scipy.spatial import cKDTree

    points = np.concatenate([line.points3 for line in drawing.lines])
    away, _ = cKDTree(helix).query(points)
    assert away.max() < WIRE + 2 * drawing.accuracy.used
    assert away.min() > 0.9 * WIRE
