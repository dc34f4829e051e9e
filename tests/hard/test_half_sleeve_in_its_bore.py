"""Half a sleeve in its bore, as where an assembly was cut in two: the parts touch, and no line may say that they cross.

A planar face ends at a round rim in chords, which cut into the bore by up to the deflection. The planes in which the
sleeve was cut end at the wall of the bore, and so pass through these chords: over a tenth of a millimetre, but by
themselves they go far beyond one another. That made intersection lines of a contact, wherever the chords of the two
walls happened to run. OpenCASCADE finds no common volume.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import compound

import hlr
from support.at_size import ALL_LINES, AT_SIZE

ACCURACIES = [0.5, 0.1, 0.05, 0.01]
RADIUS, WALL, LOW, TOP = 8.0, 1.0, -37.5, -15.0


def pipe(outer, inner, low, high):
    return cq.Workplane().circle(outer).circle(inner).extrude(high - low).translate((0, 0, low))


def half(whole, y=-0.1):
    """What lies at y or below."""
    return whole.intersect(cq.Workplane().box(100, 100, 100).translate((0, y - 50, 0)))


def sleeve(turned, radius=RADIUS):
    """A ring and, in its bore, half a flanged sleeve that sticks out of it at both ends."""
    inside = pipe(radius, RADIUS - WALL, LOW - 0.5, TOP + 0.1).union(pipe(radius + 1, RADIUS - WALL, LOW - 0.5, LOW))
    return pipe(RADIUS + 2, RADIUS, LOW, TOP).rotate((0, 0, 0), (0, 0, 1), turned).val(), half(inside).val()


def slotted_head(turned, radius=4.0):
    """The half of a plate with a counterbore, and in it a slotted screw that sticks out."""
    plate = cq.Workplane().box(20, 20, 10).translate((0, 0, 15)).cut(pipe(4.0, 2.0, 17, 20))
    head = cq.Workplane().circle(radius).extrude(4).cut(cq.Workplane().box(1, 30, 3.8).translate((0, 0, 4)))
    head = head.rotate((0, 0, 0), (0, 0, 1), turned).translate((0, 0, 17))
    return half(plate.cut(cq.Workplane().circle(4.0).extrude(3).translate((0, 0, 17)))).val(), head.val()


MODELS = {"sleeve": sleeve, "slotted head": slotted_head}


def crossings(parts, accuracy):
    drawing = hlr.draw(compound(*parts), "iso", scale=1.0, accuracy=accuracy, **ALL_LINES)
    return [line for line in drawing.lines if line.kind == "intersection"]


def common_volume(parts):
    return parts[0].intersect(parts[1]).Volume()


@pytest.mark.parametrize("accuracy", ACCURACIES)
@pytest.mark.parametrize("turned", [0.0, 11.0, 45.0, 90.0, 133.7])
@pytest.mark.parametrize("model", MODELS)
def test_parts_that_touch_do_not_cross(model, turned, accuracy):
    parts = MODELS[model](turned)
    assert common_volume(parts) == pytest.approx(0.0, abs=1e-9)
    assert not crossings(parts, accuracy)


def test_picture(picture):
    picture(hlr.draw(compound(*sleeve(11.0)), "iso", **AT_SIZE))


@pytest.mark.parametrize("accuracy", ACCURACIES)
@pytest.mark.parametrize("model", MODELS)
def test_parts_that_are_too_large_for_their_bore_cross(model, accuracy):
    """By a little more than curved surfaces may and still count as touching."""
    parts = MODELS[model](11.0)
    wider = MODELS[model](11.0, (RADIUS if model == "sleeve" else 4.0) + 3.5 * accuracy)
    assert common_volume((parts[0], wider[1])) > 0.1
    assert crossings((parts[0], wider[1]), accuracy)


@pytest.mark.parametrize("thick", [0.005, 0.02, 0.06])
@pytest.mark.parametrize("round_ends", [False, True])
def test_a_thin_blade_through_a_plate_crosses_it(round_ends, thick):
    """Thinner than a chord error, but its borders are straight; or round, and farther apart than that."""
    blade = cq.Workplane().slot2D(6.0, 2.0) if round_ends else cq.Workplane().rect(6.0, thick)
    blade = blade.extrude(thick if round_ends else 4.0).translate((0, 0, 0 if round_ends else -2))
    if round_ends:
        blade = blade.rotate((0, 0, 0), (1, 0, 0), 90)
    plate = cq.Workplane().box(10, 10, 1)
    drawn = crossings((plate.val(), blade.val()), 0.05)
    length = sum(float(np.linalg.norm(np.diff(line.points3, axis=0), axis=1).sum()) for line in drawn)
    wide = 6.0 if not round_ends else 4.0 + 2 * np.sqrt(0.75)  # at half the height of its ends
    assert length >= 2 * wide - 0.05
