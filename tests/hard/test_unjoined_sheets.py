"""Faces that only lie beside one another, as IGES and surface models hold them: each border is there once per face.

(plate_mode_samples_creo.stp of BRL-CAD: 22 faces, no shell, no edge in common.) Coincident borders are drawn once, the
sheets hide like a solid does, and no slit opens between two tessellations of one border.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, compound, faultless, kinds, like, ring, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import defects, expect


def apart(shape):
    """Its faces, each with edges and vertices of its own."""
    return compound(*(face.copy() for face in shape.Faces()))


def half_walls():
    """A cylinder's wall in two halves that meet at x = 10 and x = -10."""
    wall = cq.Workplane().circle(10).extrude(20).val()
    halves = [wall.intersect(cq.Solid.makeBox(40, 20, 40, cq.Vector(-20, y, -5))) for y in (-20, 0)]
    curved = [face for half in halves for face in half.Faces() if face.geomType() == "CYLINDER"]
    return compound(*(face.copy() for face in curved))


@pytest.mark.parametrize("view", ["iso", "front", (1, -2, 1.5), (-1, 0.4, -0.5)])
def test_six_squares_are_drawn_like_a_box(view, picture):
    drawing = hlr.draw(apart(cq.Workplane().box(30, 20, 10).val()), view, **AT_SIZE)
    like(drawing, expect(drawing, *box_edges((-15, -10, -5), (15, 10, 5), drawing.view.direction)))
    assert {kind for kind, _ in kinds(drawing)} == {"boundary"}
    if view == "iso":
        picture(drawing)


def test_two_half_walls_meet_in_one_line():
    """Turned so that one of the joints is in front, the other behind."""
    view = turn(turn((0, -1, 0), (0, 0, 1), 90), (0, 1, 0), -30)
    assert view[0] > 0 and view[2] > 0
    drawing = hlr.draw(half_walls(), view, **AT_SIZE)
    seen = [*ring(10, 20), *ring(10, 0, -90, 90), ((10, 0, 0), (10, 0, 20))]
    seen += [((0, y, 0), (0, y, 20)) for y in (10, -10)]
    # The joint behind is seen through the mouth: as far down as the rim in front of it allows.
    depth = 20 * view[2] / abs(view[0])
    cut = 20 - depth
    assert 0 < cut < 20
    seen.append(((-10, 0, cut), (-10, 0, 20)))
    like(drawing, expect(drawing, seen, [*ring(10, 0, 90, 270), ((-10, 0, 0), (-10, 0, cut))]), ends=0.05)


@pytest.mark.slow
def test_by_rays():
    bracket = cq.Workplane().box(40, 30, 6).faces(">Z").workplane().circle(8).extrude(12).edges("|Z").fillet(4).val()
    for drawing in faultless(apart(bracket), bracket, ["iso", "front", (0.36, 0.86, 0.35)]):
        assert drawing.lines


def test_the_defect_is_named():
    assert defects(apart(cq.Workplane().box(30, 20, 10).val())) == ["open: 24 border edges"]
