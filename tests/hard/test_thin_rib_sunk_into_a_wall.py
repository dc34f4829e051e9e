"""A thin rib stands on a slab, and its back is sunk into a wall by little. The front of its foot is far from the wall.

The foot's front edge lies on the line where the slab's rounding begins, a tangent edge. It is so short that it gives
way to an intersection line beside it. Because the rib is sunk somewhere, it gave way to every other line as well: a
thin line ran through the foot of the rib.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr

ACCURACY = 0.05
THICKNESSES = [0.4, 0.7, 0.9, 1.5]
"""Millimetres: the first three are short."""
FRONT = -16.0
"""The y of the foot's front edge, and of the tangent edge."""


def slab_wall_and_rib(thick: float, depth: float) -> cq.Assembly:
    """The rib lies along y, and enters the wall by this depth."""
    slab = cq.Workplane().box(40, 40, 10).translate((0, 0, -5)).edges("|X and >Z and <Y").fillet(20 + FRONT)
    wall = cq.Workplane().box(40, 4, 30).translate((0, 18, 15))
    rib = cq.Workplane().box(thick, 16 - FRONT + depth, 20).translate((0, (16 + FRONT + depth) / 2, 10))
    return cq.Assembly().add(slab, name="slab").add(wall, name="wall").add(rib, name="rib")


def drawn(thick: float, depth: float) -> hlr.Drawing:
    model = slab_wall_and_rib(thick, depth)
    return hlr.draw(model, "iso", accuracy=ACCURACY, scale=1.0, hidden=True, smooth=True, details=True)


def along_the_front(drawing: hlr.Drawing) -> dict[str, float]:
    """Millimetres of the visible lines of each class on the line of the tangent edge, in the model."""
    found: dict[str, float] = {}
    for line in drawing.visible:
        if np.abs(line.points3[:, 1:] - [FRONT, 0.0]).max() < 1e-6:
            found[line.kind] = found.get(line.kind, 0.0) + float(np.ptp(line.points3[:, 0]))
    return found


@pytest.mark.parametrize("thick", THICKNESSES)
def test_the_edge_of_the_foot_is_drawn_where_no_intersection_line_is(thick: float) -> None:
    sunk, touching = drawn(thick, 1.6 * ACCURACY), drawn(thick, 0.0)
    assert [line.kind for line in sunk.lines].count("intersection")
    assert along_the_front(sunk)["sharp"] == pytest.approx(thick, abs=1e-6)
    assert along_the_front(sunk) == pytest.approx(along_the_front(touching), abs=1e-6)


def test_picture(picture) -> None:
    picture(drawn(0.7, 1.6 * ACCURACY))
