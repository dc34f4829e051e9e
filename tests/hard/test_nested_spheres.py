"""Spheres in spheres, seen through a hole in the outermost: outlines that are hidden by surfaces without any edge.

No crossing of lines tells that the inner ones are hidden, for their outlines cross nothing: only the count at the start
does (Appel's first point; a method that starts at "visible" draws them all).
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import Ink, agrees, pieces
from support.meshes import as_parts, circle, merged, sphere

N, M = 96, 48
HOLE = np.radians(50)
"""Latitude of the rim."""


def radius_seen(radius):
    """From above the outline is the equator, a ring of corners of the mesh."""
    return pieces([circle(radius, N)])


NOTHING = np.zeros((0, 2, 2))


@pytest.mark.slow
@pytest.mark.parametrize("how", [merged, as_parts])
def test_through_the_hole_the_first_is_seen_and_hides_the_second(picture, how):
    model = how(sphere(20, N, M, HOLE), sphere(10, N, M), sphere(5, N, M))
    drawing = hlr.draw(model, "top", **AT_SIZE)
    seen = [radius_seen(r) for r in (20, 20 * np.cos(HOLE), 10)]
    agrees(drawing, Ink(np.concatenate(seen), radius_seen(5)))
    picture(drawing)


@pytest.mark.slow
@pytest.mark.parametrize("how", [merged, as_parts])
def test_from_below_nothing_is_seen_of_it(how):
    model = how(sphere(20, N, M, HOLE), sphere(10, N, M), sphere(5, N, M))
    drawing = hlr.draw(model, "bottom", **AT_SIZE)
    agrees(drawing, Ink(radius_seen(20), np.concatenate([radius_seen(r) for r in (20 * np.cos(HOLE), 10, 5)])))


@pytest.mark.slow
@pytest.mark.parametrize("how", [merged, as_parts])
def test_closed_spheres_hide_all_that_they_hold(how):
    drawing = hlr.draw(how(*(sphere(r, N, M) for r in (20, 15, 10, 5))), "top", **AT_SIZE)
    agrees(drawing, Ink(radius_seen(20), np.concatenate([radius_seen(r) for r in (15, 10, 5)])))
    drawing = hlr.draw(how(*(sphere(r, N, M) for r in (20, 15, 10, 5))), "top", hidden=False, scale=1.0, smooth=False)
    agrees(drawing, Ink(radius_seen(20), NOTHING))


def test_an_eye_between_the_shells_sees_only_the_inner_one():
    model = merged(sphere(20, N, M), sphere(5, 2 * N, 2 * M))
    drawing = hlr.draw(
        model,
        perspective=hlr.Perspective(eye=(0, 0, 15), target=(0, 0, 0), fov=80),
        hidden=False,
        scale=1.0,
        smooth=False,
    )
    # The tangents from 15 touch the sphere at an angle whose sine is 5 / 15; the image plane is 15 away.
    angle = np.arcsin(5 / 15)
    outline = [p for line in drawing.lines if line.kind == "outline" for p in line.points + drawing.origin]
    radii = np.hypot(*np.array(outline).T)
    assert radii == pytest.approx(15 * np.tan(angle), abs=0.08)
