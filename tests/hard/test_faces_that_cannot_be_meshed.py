"""A solid of which one face has a wire that runs back over itself: OpenCASCADE makes no triangles for it.

(Button and sensor of SparkFun's KiCad libraries, which are CC-BY-4.0: planar faces bounded by a line and its own copy,
surfaces of revolution whose wires do not close.) The rest is drawn, the note says how many faces are not there, and the
face's edges are drawn as its neighbours know them.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, like

import hlr
from hlr.drawing.notes import Note
from support.at_size import AT_SIZE
from support.brep_shapes import plate_with_sliver, sliver
from support.expected import expect

NOTE = Note("not-meshed", 'Part "part": 1 of 7 faces could not be meshed (face 6).')


def box():
    return cq.Workplane().box(30, 20, 10).val()


@pytest.mark.parametrize("view", ["iso", "front", (0.3, -1, -0.4)])
def test_the_rest_is_drawn_as_if_it_were_not_there(view, picture):
    drawing = hlr.draw(plate_with_sliver(), view, **AT_SIZE)
    assert NOTE in drawing.notes
    like(drawing, expect(drawing, *box_edges((-15, -10, -5), (15, 10, 5), drawing.view.direction)))
    if view == "iso":
        picture(drawing)


def test_the_report_says_so():
    assert NOTE in hlr.info(plate_with_sliver()).notes


def test_strict_refuses_it():
    with pytest.raises(hlr.StrictError, match="1 of 7 faces could not be meshed"):
        hlr.draw(plate_with_sliver(), strict=True, **AT_SIZE)


def test_nothing_but_such_a_face_is_refused():
    with pytest.raises(hlr.SourceError, match="none of its faces could be meshed"):
        hlr.draw(cq.Shape.cast(sliver()), **AT_SIZE)
