"""The same thing several times: in the same place, or exactly behind itself, so that all images coincide.

Nothing hides what lies in the same place; where images coincide each line is there once, and visible if any is.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, differences, ink
from support.meshes import BOX_EDGES, as_parts, box, merged, moved, rotation

CUBE = box((-10, -10, -10), (10, 10, 10))


def cube_alone(drawing):
    return by_oracle(drawing, *CUBE, BOX_EDGES)


@pytest.mark.slow
@pytest.mark.parametrize("count", [2, 3, 50])
@pytest.mark.parametrize("view", ["iso", "front", (2, -1, 0.5)])
def test_copies_in_one_place_are_drawn_once(picture, count, view):
    drawing = hlr.draw(as_parts(*[CUBE] * count), view, **AT_SIZE)
    agrees(drawing, cube_alone(drawing))
    if (count, view) == (3, "iso"):
        picture(drawing)


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("view", [(1, -1, 1), (0, -1, 0), (3, -4, 0), (2, -1, 0.5)])
def test_twins_exactly_behind_one_another(how, view):
    d = np.array(view, float)
    twins = [moved(CUBE, lambda p, k=k: p - 30 * k * d) for k in range(4)]
    drawing = hlr.draw(how(*twins), view, **AT_SIZE)
    agrees(drawing, cube_alone(drawing))


@pytest.mark.parametrize("angle", [0.3, 1.0])
def test_turned_copies_are_equal_but_for_rounding(angle):
    # Turned there and back again: the corners differ in their last bits.
    there, back = rotation((1, 2, 3), angle), rotation((1, 2, 3), -angle)
    other = moved(CUBE, lambda p: p @ there.T @ back.T)
    drawing = hlr.draw(as_parts(CUBE, other), "iso", **AT_SIZE)
    agrees(drawing, cube_alone(drawing))


@pytest.mark.slow
def test_order_and_orientation_of_what_is_given_do_not_matter():
    points, triangles = merged(*(box(c - s, c + s) for c, s in zip(*random_boxes(12), strict=True)))
    plain = hlr.draw((points, triangles), "iso", **AT_SIZE)
    rng = np.random.default_rng(5)
    for _ in range(6):
        number = rng.permutation(len(points))
        place = np.argsort(number)
        shuffled = place[triangles][rng.permutation(len(triangles))]
        shuffled = np.array([np.roll(t, rng.integers(3)) for t in shuffled])
        other = hlr.draw((points[number], shuffled), "iso", **AT_SIZE)
        assert not differences(ink(plain), ink(other), plain.accuracy.used, step=0.3)
        assert not differences(ink(other), ink(plain), plain.accuracy.used, step=0.3)


def random_boxes(count):
    """Centres and half sizes on a lattice of 3: many faces, edges and corners coincide."""
    rng = np.random.default_rng(3)
    return rng.integers(-5, 6, (count, 3)) * 3.0, rng.integers(1, 4, (count, 3)) * 1.5


@pytest.mark.parametrize("view", ["iso", "front", (2, -1, 0.5)])
def test_boxes_on_a_lattice(picture, view):
    boxes = [box(c - s, c + s) for c, s in zip(*random_boxes(12), strict=True)]
    points, triangles = merged(*boxes)
    drawing = hlr.draw(as_parts(*boxes), view, **AT_SIZE)
    edges = [(i + 8 * k, j + 8 * k) for k in range(len(boxes)) for i, j in BOX_EDGES]
    agrees(drawing, by_oracle(drawing, points, triangles, edges), step=0.3, without=("intersection",))
    if view == "iso":
        picture(drawing, "lattice")
