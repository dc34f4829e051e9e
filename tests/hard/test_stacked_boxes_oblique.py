"""Boxes stacked face to face, all turned obliquely: the contact is equal only up to rounding.

The picture does not depend on how model and viewer are turned together. A depth buffer, and exact arithmetic upon
rounded corners, both let the covered part of the contact show through or hide the rim upon it.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, compound, kinds, like, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

LOWER = ((-20, -15, -10), (20, 15, 0))
UPPER = ((-6, -5, 0), (8, 7, 4))
TWIN = ((-20, -15, 0), (20, 15, 10))
TURNS = [((0, 0, 1), 0), ((1, 2, 3), 41), ((3, -1, 2), 123), ((1, 1, 0), 77.7), ((-2, 5, 1), 250)]


def box(low, high):
    return cq.Solid.makeBox(*(b - a for a, b in zip(low, high, strict=True)), cq.Vector(*low))


def drawn(model, axis, angle, view, up=(0, 0, 1)):
    turned = model.rotate((0, 0, 0), axis, angle)
    return hlr.draw(turned, turn(view, axis, angle), up=turn(up, axis, angle), **AT_SIZE)


@pytest.mark.parametrize(("axis", "angle"), TURNS)
def test_a_smaller_one_upon_a_larger_one(axis, angle, picture):
    view = (1, -2, 3)
    drawing = drawn(compound(box(*LOWER), box(*UPPER)), axis, angle, view)
    seen, unseen = box_edges(*LOWER, view)
    more, hidden = box_edges(*UPPER, view)
    flat = drawn(compound(box(*LOWER), box(*UPPER)), *TURNS[0], view)
    like(drawing, expect(flat, seen + more, unseen + hidden))
    if angle == 41:
        picture(drawing)


@pytest.mark.parametrize(("axis", "angle"), TURNS)
def test_two_equal_ones(axis, angle):
    """The common rim is there once; nothing else tells that there are two."""
    view = (1, -2, 3)
    flat, drawing = (drawn(compound(box(*LOWER), box(*TWIN)), *t, view) for t in (TURNS[0], (axis, angle)))
    seen, unseen = box_edges(*LOWER, view)
    more, hidden = box_edges(*TWIN, view)
    rear = [e for e in seen if all(p[2] == 0 for p in e) and (e[0][1] == e[1][1] == 15 or e[0][0] == e[1][0] == -20)]
    assert len(rear) == 2
    like(drawing, expect(flat, [e for e in seen if e not in rear] + more, unseen + hidden + rear))
    assert kinds(drawing) == {("sharp", True), ("sharp", False)}
