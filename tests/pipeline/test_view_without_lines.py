"""A parallel view in which no line is drawn: the note says why, and speaks of no eye."""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr

FAR = 1e6
TWO_SPECKS = cq.Compound.makeCompound([cq.Solid.makeBox(1, 1, 1, cq.Vector(x, 0, 0)) for x in (0, FAR)])
ROD = cq.Edge.makeLine(cq.Vector(0, 0, 0), cq.Vector(10, 0, 0))


@pytest.mark.parametrize(("shape", "view", "scale"), [(TWO_SPECKS, "front", "1:5000"), (ROD, "left", "1:1")])
def test_the_note_names_accuracy_and_scale(shape, view, scale):
    drawing = hlr.draw(shape, view)
    assert not drawing.lines
    (note,) = drawing.notes
    assert note.code == "nothing-in-view"
    assert f"smaller than the accuracy, 0.05 mm, at {scale}." in note.text and "eye" not in note.text


def test_a_larger_scale_draws_what_was_too_small():
    assert hlr.draw(TWO_SPECKS, "front", scale=0.2).lines
