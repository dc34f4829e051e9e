"""Write the surfaces of a solid otherwise, or turn it before it is meshed: the drawing shows the same.

MAY MOVE   planes, cylinders and cones as B-splines, of a higher degree and with more knots, are meshed otherwise: ink
           may move by the accuracy, and what rounding decides may differ: stretches up to `ink.LONGEST`.

Many corners of the parts lie in one line, as those of notches along an edge do.
"""

from __future__ import annotations

from collections.abc import Callable

import cadquery as cq
import numpy as np
import pytest
from properties.assemblies import rotation
from properties.ink import expect_same_ink

import hlr
from support.at_size import ALL_LINES
from support.free_form import with_more_knots

Pick = Callable[[float, float], float]
VIEW = (0.5, -1.0, 0.8)


def plate(pick: Pick) -> cq.Workplane:
    found = cq.Workplane().box(240, 60, 10)
    for k in range(4):
        found = found.cut(cq.Workplane().box(pick(9, 36), 6, 5).translate((60 * k - 90 + pick(-9, 9), 30, 5)))
    return found.cut(cq.Workplane().pushPoints([(pick(-30, 30), pick(-9, 9)) for _ in range(2)]).circle(3).extrude(9))


def half_shaft(pick: Pick) -> cq.Workplane:
    found = cq.Workplane().circle(20).extrude(80).cut(cq.Workplane().box(50, 25, 200).translate((0, pick(-18, -8), 0)))
    for k in range(3):
        found = found.cut(cq.Workplane().box(8, 12, pick(3, 12)).translate((pick(-20, 20), pick(-3, 3), 12 + 22 * k)))
    return found


def half_cone(pick: Pick) -> cq.Workplane:
    found = cq.Workplane(cq.Solid.makeCone(25, pick(3, 15), 80)).cut(
        cq.Workplane().box(80, 40, 200).translate((0, -20, 0))
    )
    for k in range(3):
        found = found.cut(cq.Workplane().box(6, 60, pick(3, 10)).translate((pick(-15, 15), 0, 12 + 22 * k)))
    return found


def ruled(pick: Pick) -> cq.Workplane:
    found = cq.Workplane().rect(40, 30).workplane(offset=30).rect(pick(10, 30), pick(10, 38)).loft(ruled=True)
    for k in range(3):
        found = found.cut(cq.Workplane().box(6, 6, pick(4, 12)).translate((pick(-20, 20), pick(-15, 15), 8 + 9 * k)))
    return found


KINDS = (plate, half_shaft, half_cone, ruled)


def part(number: int) -> cq.Shape:
    """The first that OpenCASCADE has cut well."""
    for seed in range(number, 400, 8):
        rng = np.random.default_rng(seed)
        shape = KINDS[number % 4](rng.uniform).val()
        if isinstance(shape, cq.Shape) and shape.isValid():
            return shape
    raise AssertionError("none is valid")


def draw(shape: cq.Shape, turn: np.ndarray) -> hlr.Drawing:
    """From the same side, however the shape is turned, at 2:1."""
    direction, up = turn @ VIEW, turn @ (0.0, 0.0, 1.0)
    return hlr.draw(shape, tuple(direction), up=tuple(up), scale=2.0, accuracy=0.02, **ALL_LINES)


@pytest.mark.parametrize("number", range(8))
@pytest.mark.parametrize("degree", [1, 3])
def test_a_part_of_b_splines_turned_with_the_camera(number: int, degree: int) -> None:
    before, turn = part(number), rotation((1, 2, 3), 10 + 41 * number)
    free = with_more_knots(before.rotate((0, 0, 0), (1, 2, 3), 10 + 41 * number), degree)
    expect_same_ink(draw(before, np.eye(3)), draw(free, turn))
