"""Faces whose outlines cross or lie upon one another: CadQuery leaves them where holes of one cut touch or overlap."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.gp import gp_Pln
from OCP.TopoDS import TopoDS

import hlr


def square(x: float, y: float, side: float = 4.0) -> cq.Wire:
    return cq.Wire.makePolygon([(x + a * side, y + b * side, 0) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))])


def circle(x: float, y: float, radius: float) -> cq.Wire:
    return cq.Wire.makeCircle(radius, cq.Vector(x, y, 0), cq.Vector(0, 0, 1))


def plate(outline: cq.Wire, holes: list[cq.Wire]) -> cq.Face:
    """A face in z = 0, whatever its holes do."""
    maker = BRepBuilderAPI_MakeFace(gp_Pln(), outline.wrapped, True)
    for hole in holes:
        maker.Add(TopoDS.Wire(hole.wrapped.Reversed()))
    return cq.Face(maker.Face())


TAIL = [(0, 0, 0), (20, 0, 0), (20, 10, 0), (30, 10, 0), (0, 10, 0), (0, 0, 0)]
SHIFTED = [square(4, 4), square(8, 6)]
OVER = [square(4, 4), square(6, 6)]
RINGS = [circle(6, 6, 3), circle(9, 6, 3)]
TWICE = [circle(6, 6, 3), circle(6, 6, 3)]
# The face, places that it covers, and places that it does not.
CASES = {
    "holes with part of a side in common": (plate(square(0, 0, 16), SHIFTED), [(10, 4.5), (14, 14)], [(6, 6), (10, 8)]),
    "holes that overlap": (plate(square(0, 0, 16), OVER), [(2, 2), (9, 4.8)], [(5, 5), (7, 7), (9, 9)]),
    "round holes that overlap": (plate(square(0, 0, 16), RINGS), [(1, 1), (14, 6)], [(5, 6), (7.5, 6), (10, 6)]),
    "the same hole twice": (plate(square(0, 0, 16), TWICE), [(1, 1), (14, 6)], [(6, 6), (5, 7)]),
    "a tail to and fro": (plate(cq.Wire.makePolygon(TAIL), []), [(2, 2), (18, 8)], [(25, 9), (25, 11)]),
}


@pytest.mark.parametrize("name", CASES)
def test_what_it_encloses_hides_and_its_holes_do_not(name):
    face, covered, free = CASES[name]
    boxes = [cq.Workplane().box(0.5, 0.5, 0.5).translate((x, y, -3)).val() for x, y in covered + free]
    drawing = hlr.draw(cq.Compound.makeCompound([face, *boxes]), "top", hidden=True, details=True)
    (note,) = [note for note in drawing.notes if note.code != "defects"]
    assert note.code == "loops-crossed" and "1 of" in note.text and "(face 0)" in note.text
    assert (drawing.counters["rescued_faces"], drawing.counters["lost_faces"]) == (1, 0)
    lines = [line for line in drawing.lines if abs(line.points3[0][2]) > 1]
    assert len(lines) == 4 * len(boxes)
    for line in lines:
        middle = np.mean(line.points3, axis=0)[:2]
        near = min(covered + free, key=lambda place: float(np.hypot(*(middle - place))))
        assert line.visible == (near in free), near


@pytest.mark.parametrize("apart", [10, 8])
def test_slots_of_one_cut_that_touch_or_overlap_leave_the_face_around_them(apart):
    blank = cq.Workplane().box(60, 40, 8).faces(">Z").workplane()
    slots = blank.pushPoints([(0, -apart), (0, 0), (0, apart)]).slot2D(50, 10).cutBlind(-4)
    drawing = hlr.draw(slots, "iso", hidden=True)
    (note,) = [note for note in drawing.notes if note.code == "loops-crossed"]
    assert note.is_warning and "faces has outlines or holes that cross or touch" in note.text
    # The lower edges at the back meet in a corner behind the face.
    corner = [(k, line) for line in drawing.lines for k in (0, -1) if np.allclose(line.points3[k], (-30, 20, -4))]
    assert len(corner) == 3 and not any(line.visible for _, line in corner)


def test_edges_upon_one_another_are_not_divided_again_and_again():
    drawing = hlr.draw(plate(circle(0, 0, 10), [circle(0, 0, 5), circle(0, 0, 5)]), "top")
    assert drawing.counters["triangles"] < 10_000
