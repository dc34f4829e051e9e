"""A pin pressed into a body without a hole, cut on one side of a step: its border there lies on an edge that the step
has made in the body. The two are one line of the drawing, which stays where the pin ends, though the body goes on.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.sections import assembled

STEP = 22.0


def bodies(pin: float = STEP) -> dict[str, cq.Workplane]:
    return {"body": cq.Workplane().box(60, 40, 20), "pin": cq.Workplane().cylinder(12, 3).translate((pin, 0, 0))}


def at_step(drawing: hlr.Drawing, step: float) -> list[tuple[float, float]]:
    """From where to where visible lines reach on the step, upward on paper."""
    on = [each for each in drawing.visible if each.kind != "hatch" and np.ptp(each.points3[:, 0]) < 1e-6]
    ends = [np.sort(each.points3[[0, -1], 2]) for each in on if abs(each.points3[0, 0] - step) < 1e-6]
    return sorted((round(float(low), 3) + 0.0, round(float(high), 3) + 0.0) for low, high in ends)


@pytest.mark.parametrize("meshed", [False, True])
@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize("section", [(0.0, (STEP, 8.0)), (8.0, (STEP, 0.0))])
def test_the_pin_keeps_its_border(section, order, meshed):
    shapes = dict([*bodies().items()][::order])
    assert at_step(hlr.draw(assembled(shapes, meshed), "front", section=section, **AT_SIZE), STEP) == [(-6.0, 6.0)]


@pytest.mark.parametrize("meshed", [False, True])
def test_a_pin_that_goes_on_has_none(meshed):
    """Both planes cut the pin."""
    thing = assembled(bodies(), meshed)
    assert not at_step(hlr.draw(thing, "front", section=(0.0, (STEP, 1.0)), **AT_SIZE), STEP)


def test_a_pin_beside_the_step_has_none():
    thing = assembled(bodies(STEP - 5.0), False)
    assert not at_step(hlr.draw(thing, "front", section=(0.0, (STEP, 8.0)), **AT_SIZE), STEP)


def test_picture(picture):
    picture(hlr.draw(assembled(bodies(), False), "front", section=(0.0, (STEP, 8.0)), **AT_SIZE))
