"""A body in the pocket that it left in another one: the two touch all over the pocket, and nowhere do they cross.

Both are drawn from their own triangles, so the facets of the pocket and those of the body go through one another. Three
of these crossings looked deep. A corner on the other body's face crosses it at a point, in which there is no direction
to measure a depth in. Where a wall ends in the pocket, the pocket itself was taken for more of the wall if it goes on
at less than 40 degrees. And two planar faces that only just meet go far beyond one another's plane. Bodies are those of
fuzzing, cut by random planes; OpenCASCADE finds no common volume.
"""

from __future__ import annotations

import math
import random

import cadquery as cq
import numpy as np
import pytest
from hard.brep import compound

import hlr
from support.at_size import ALL_LINES


def body(draw):
    """A simple body of random size."""
    size = draw.uniform
    return [
        lambda: cq.Workplane().box(size(8, 20), size(8, 20), size(8, 20)),
        lambda: cq.Workplane().circle(size(4, 10)).extrude(size(5, 20)),
        lambda: cq.Workplane(cq.Solid.makeCone(size(4, 9), size(1, 4), size(6, 15))),
        lambda: cq.Workplane().sphere(size(5, 10)),
        lambda: cq.Workplane(cq.Solid.makeTorus(size(6, 10), size(1.5, 4))),
        lambda: cq.Workplane().box(size(8, 20), size(8, 20), size(8, 20)).edges().fillet(size(0.5, 2.5)),
        lambda: cq.Workplane().ellipse(size(4, 9), size(3, 7)).extrude(size(4, 14)),
    ][draw.randrange(7)]().val()


def placed(shape, draw, aligned):
    """Its centre at the origin, turned about an axis."""
    shape = shape.moved(cq.Location(cq.Vector(0, 0, 0) - shape.Center()))
    if aligned:
        return shape.rotate((0, 0, 0), draw.choice([(1, 0, 0), (0, 1, 0), (0, 0, 1)]), draw.choice([0, 90, 45, 17.3]))
    return shape.rotate((0, 0, 0), tuple(draw.uniform(-1, 1) for _ in range(3)), draw.uniform(0, 360))


def half(shape, point, normal):
    """What lies below a plane."""
    return shape.intersect(cq.Workplane(cq.Plane(origin=point, normal=normal)).rect(200, 200).extrude(-100).val())


def pair(seed, aside=(0.0, 0.0, 0.0)):
    """A body with a pocket, and the one that left it, moved aside; both perhaps cut."""
    draw = random.Random(seed)
    aligned = draw.random() < 0.6
    one, other = placed(body(draw), draw, aligned), placed(body(draw), draw, aligned)
    along = [draw.uniform(-6, 6) * (0 if aligned and draw.random() < 0.5 else 1) for _ in range(3)]
    other = other.moved(cq.Location(cq.Vector(*along)))
    pocket = one.cut(other)
    free = draw.random() < 0.5
    normal = tuple(draw.uniform(-1, 1) for _ in range(3)) if free else draw.choice([(1, 0, 0), (0, 1, 0), (0, 0, 1)])
    point = tuple(draw.uniform(-3, 3) for _ in range(3))
    cut = draw.randrange(4)
    if cut in (1, 3):
        pocket = half(pocket, point, normal)
    if cut in (2, 3):
        other = half(other, point, normal if draw.random() < 0.7 else tuple(-x for x in normal))
    return pocket, other.moved(cq.Location(cq.Vector(*aside)))


def crossings(pocket, other, accuracy):
    parts = [*pocket.Solids(), *other.Solids()]
    drawing = hlr.draw(compound(*parts), "iso", scale=1.0, accuracy=accuracy, **ALL_LINES)
    return [line for line in drawing.lines if line.kind == "intersection"]


SEEDS = (2, 5, 26, 31, 257)


@pytest.mark.parametrize("seed", SEEDS)
def test_they_touch(seed):
    pocket, other = pair(seed)
    assert pocket.Solids() and other.Solids()
    assert pocket.distance(other) == pytest.approx(0.0, abs=1e-6)
    assert pocket.intersect(other).Volume() == pytest.approx(0.0, abs=1e-7)
    assert not crossings(pocket, other, 0.05)


@pytest.mark.parametrize("seed", SEEDS)
def test_moved_into_one_another_they_cross(seed):
    pocket, _ = pair(seed)
    deepest = 0.0
    for turn in np.linspace(0.0, math.tau, 6, endpoint=False):
        _, other = pair(seed, (math.cos(turn), math.sin(turn), 0.3))
        common = pocket.intersect(other).Volume()
        deepest = max(deepest, common)
        assert common < 1.0 or crossings(pocket, other, 0.05)
    assert deepest > 1.0
