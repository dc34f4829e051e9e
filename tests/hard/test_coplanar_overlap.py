"""Faces that overlap in one plane: none is in front, so none hides another's lines, whichever way rounding falls.

Z-fighting in a depth buffer; in object space the sign of a depth that is zero but for rounding. Turned obliquely the
corners are no longer exactly coplanar.
"""

from __future__ import annotations

import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, expect
from support.meshes import as_parts, face, merged, moved, ring, rotation

ONE = [(0, 0, 0), (20, 0, 0), (20, 10, 0), (0, 10, 0)]
OTHER = [(10, 5, 0), (30, 5, 0), (30, 15, 0), (10, 15, 0)]
THIRD = [(5, 2, 0), (25, 2, 0), (25, 12, 0)]
BELOW = [(12, 6, -5), (18, 6, -5), (18, 9, -5), (12, 9, -5)]
TURNS = [rotation((1, 2, 3), a) for a in (0.0, 0.3, 1.1, 2.5)]


def model(how, turn, *faces):
    return how(*(moved(face(*corners), lambda p: p @ turn.T) for corners in faces))


def turned(turn, corners):
    return ring([turn @ c for c in corners])


def seen(how, turn, order, toward):
    faces = [ONE, OTHER, THIRD][::order]
    drawing = hlr.draw(model(how, turn, *faces), tuple(turn @ toward), **AT_SIZE)
    agrees(drawing, expect(drawing, [s for f in faces for s in turned(turn, f)]))


@pytest.mark.slow
@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("order", [1, -1])
def test_all_sides_are_seen_obliquely(how, turn, order):
    for toward in ((0.4, -0.3, 1), (0.001, 0.002, 1), (0.1, 0.1, -1)):
        seen(how, turn, order, toward)


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("order", [1, -1])
def test_all_sides_are_seen_face_on(how, order):
    for toward in ((0, 0, 1), (0, 0, -1)):
        seen(how, TURNS[0], order, toward)


def test_all_sides_are_seen_face_on_when_turned():
    for how in (merged, as_parts):
        for turn in TURNS[1:]:
            for toward in ((0, 0, 1), (0, 0, -1)):
                seen(how, turn, 1, toward)


@pytest.mark.parametrize("turn", TURNS)
def test_what_lies_below_is_hidden(picture, turn):
    faces = [ONE, OTHER, THIRD]
    toward, up = tuple(turn @ (0, 0, 1)), tuple(turn @ (0, 1, 0))
    drawing = hlr.draw(model(merged, turn, *faces, BELOW), toward, up=up, **AT_SIZE)
    agrees(drawing, expect(drawing, [s for f in faces for s in turned(turn, f)], turned(turn, BELOW)))
    picture(drawing)


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("turn", TURNS)
def test_a_face_upon_part_of_itself(how, turn):
    # Two sides of the smaller one run along sides of the larger one: there once.
    small = [(0, 0, 0), (8, 0, 0), (8, 5, 0), (0, 5, 0)]
    drawing = hlr.draw(model(how, turn, ONE, small), tuple(turn @ (0.2, 0.1, 1)), **AT_SIZE)
    agrees(drawing, expect(drawing, [*turned(turn, ONE), *turned(turn, small)]))
