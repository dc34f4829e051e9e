"""A shaft in a bore of the same radius: two tessellations of one cylinder, each here above and there below the other.

Without a tolerance for contact the shaft's chords come through the bore and scatter short visible pieces; with one that
is too large the far wall shows. The outside faces alone say what is right: what is inside the block is hidden.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import box_edges, compound, faultless, like, ring, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

RADIUS, LOW, TOP = 6.0, -12.0, 14.0
HALF, DEEP = 15.0, 10.0


def model(turned=0.0):
    """A block with a bore; the shaft's seam lies elsewhere than the bore's, so no chord is shared."""
    block = cq.Workplane().box(2 * HALF, 2 * HALF, 2 * DEEP).faces(">Z").workplane().hole(2 * RADIUS).val()
    shaft = cq.Solid.makeCylinder(RADIUS, TOP - LOW, cq.Vector(0, 0, LOW))
    return compound(block, shaft.rotate((0, 0, 0), (0, 0, 1), turned))


NEAR = 20
"""Degrees from a generator seen edge-on, within which contact tolerance may decide about a rim: a thirtieth of the
radius beside the generator."""


@pytest.mark.slow
@pytest.mark.parametrize("turned", [0, 17.3])
@pytest.mark.parametrize("degrees", [0, 35, 70])
def test_by_hand(turned, degrees, picture):
    view = turn((0, -1, 0), (1, 0, 0), -degrees)
    drawing = hlr.draw(model(turned), view, **AT_SIZE)
    seen, unseen = box_edges((-HALF, -HALF, -DEEP), (HALF, HALF, DEEP), view)
    seen += ring(RADIUS, TOP)
    either = []
    if degrees:
        seen += ring(RADIUS, DEEP, 180 + NEAR, 360 - NEAR)
        unseen += ring(RADIUS, DEEP, NEAR, 180 - NEAR)
        for z in (-DEEP, LOW):
            unseen += ring(RADIUS, z, NEAR, 180 - NEAR) + ring(RADIUS, z, 180 + NEAR, 360 - NEAR)
        for z in (DEEP, -DEEP, LOW):
            either += ring(RADIUS, z, -NEAR, NEAR) + ring(RADIUS, z, 180 - NEAR, 180 + NEAR)
    else:
        seen += ring(RADIUS, LOW) + [((x, 0, LOW), (x, 0, -DEEP)) for x in (RADIUS, -RADIUS)]
    for x in (RADIUS, -RADIUS):
        entry = min(3.0, 1.2 * RADIUS * np.sin(np.radians(NEAR)) * np.tan(np.radians(degrees)))
        seen.append(((x, 0, DEEP + entry), (x, 0, TOP)))
        unseen.append(((x, 0, LOW + entry if degrees else -DEEP), (x, 0, DEEP - entry)))
        either.append(((x, 0, LOW if degrees else -DEEP), (x, 0, TOP)))
    like(drawing, expect(drawing, seen, unseen), either=either)
    if (turned, degrees) == (17.3, 35):
        # The bore's rim ends where it touches the shaft's generator, which goes on below it as a hidden line: close to
        # that place one lies on the other, on both sides.
        picture(drawing, twice=0.25)


def expect_few_changes(turned, view):
    """Each of the four rims changes at most twice, each generator at most at the four planes."""
    (drawing,) = faultless(model(turned), model(turned), [view])
    assert len([line for line in drawing.lines if line.kind != "outline"]) <= 15 + 4 * 4


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", (1, 2, 0.3), (-0.5, 0.4, -1)], ids=str)
@pytest.mark.parametrize("turned", [0, 17.3, 90])
def test_no_rim_breaks_up(turned, view):
    expect_few_changes(turned, view)


@pytest.mark.slow
def test_no_rim_breaks_up_along_the_shaft():
    """Seen at a grazing angle, where the two surfaces differ in depth by more than they are apart."""
    expect_few_changes(17.3, (0.1, -0.1, 1))
