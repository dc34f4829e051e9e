"""Fillets run into their planes tangentially: just there the outline begins when the plane is seen edge-on.

A mesh contour jumps to and fro along the tangent line and leaves stubs and doubled lines; the outline of the solid is
known: straight lines at its sides, quarter circles at its corners.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import arc, kinds, like, turn, walk

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

X, Y, Z, R = 30.0, 20.0, 10.0, 4.0
"""Half sides of the box and the radius of its upright edges, or of all."""


def upright():
    return cq.Workplane().box(2 * X, 2 * Y, 2 * Z).edges("|Z").fillet(R)


def all_round():
    return cq.Workplane().box(2 * X, 2 * Y, 2 * Z).edges().fillet(R)


def outline(x, y, z):
    """A rounded rectangle across the view: x and y half sides, at the height z."""
    lines = [((-x + R, s * y, z), (x - R, s * y, z)) for s in (1, -1)]
    lines += [((s * x, -y + R, z), (s * x, y - R, z)) for s in (1, -1)]
    for cx, cy, start in ((x - R, y - R, 0), (R - x, y - R, 90), (R - x, R - y, 180), (x - R, R - y, 270)):
        lines += arc((cx, cy, z), (R, 0, 0), (0, R, 0), start, start + 90)
    return lines


@pytest.mark.parametrize("off", [0, 1e-9, -1e-6, 1e-4])
def test_edge_on_a_rectangle_and_nothing_else(off):
    """Degrees off the front: each tangent line turns into the contour and out of it."""
    drawing = hlr.draw(upright(), turn((0, -1, 0), (0, 0, 1), off), **AT_SIZE)
    like(drawing, expect(drawing, walk([(-X, 0, -Z), (X, 0, -Z), (X, 0, Z), (-X, 0, Z), (-X, 0, -Z)])))
    assert len([line for line in drawing.lines if line.kind == "outline"]) == 2


def test_all_edges_rounded(picture):
    drawing = hlr.draw(all_round(), "top", **AT_SIZE)
    like(drawing, expect(drawing, outline(X, Y, 0)))
    assert {kind for kind, visible in kinds(drawing) if visible} == {"outline"}
    picture(drawing, twice=0.2)


@pytest.mark.parametrize("degrees", [1, 20, 44])
def test_outlines_are_where_the_normal_is_square_to_the_view(degrees):
    drawing = hlr.draw(upright(), turn((0, -1, 0), (0, 0, 1), degrees), **AT_SIZE)
    right = np.asarray(drawing.view.right)
    corner = np.array([X - R, Y - R, 0]) * np.sign(right)
    reach = corner @ right + R
    paths = [
        ((s * reach * right[0], s * reach * right[1], -Z), (s * reach * right[0], s * reach * right[1], Z))
        for s in (1, -1)
    ]
    ends = [((-reach * right[0], -reach * right[1], z), (reach * right[0], reach * right[1], z)) for z in (-Z, Z)]
    like(drawing, expect(drawing, paths + ends))
