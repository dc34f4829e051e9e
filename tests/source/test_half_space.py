"""Shapes cut by a plane: volumes, parts that the plane does not reach, several solids, shells and wires."""

import cadquery as cq
import numpy as np
import pytest

from hlr.source.cad.half_space import cut_away
from hlr.source.cad.parts import Leaf


def volume(leaf):
    return cq.Shape.cast(leaf.shape).Volume()


def test_what_lies_beyond_the_plane_goes():
    ball = Leaf(cq.Workplane().sphere(10).val().wrapped, "ball", (1.0, 0.0, 0.0), opacity=0.5)
    (cut,) = cut_away([ball], np.array([0.0, 0.0, 4.0]), np.array([0.0, 0.0, 2.0]))
    assert volume(cut) == pytest.approx(np.pi * (14**2 * (30 - 14)) / 3, rel=1e-6)
    assert (cut.name, cut.color, cut.opacity) == ("ball", (1.0, 0.0, 0.0), 0.5)
    assert volume(ball) == pytest.approx(4000 / 3 * np.pi, rel=1e-6)


def test_an_oblique_plane_through_the_middle_halves_and_both_halves_make_the_whole():
    block = Leaf(cq.Workplane().box(30, 20, 10).translate((5, -7, 3)).val().wrapped, "block")
    normal = np.array([0.3, -0.7, 0.2])
    for sense in (1.0, -1.0):
        (half,) = cut_away([block], np.array([5.0, -7.0, 3.0]), sense * normal)
        assert volume(half) == pytest.approx(3000.0)


def test_leaves_that_the_plane_does_not_reach_stay_the_same_or_go():
    low, high = (Leaf(cq.Workplane().box(4, 4, 4).translate((0, 0, z)).val().wrapped, str(z)) for z in (-2, 2))
    (kept,) = cut_away([low, high], np.zeros(3), np.array([0.0, 0.0, 1.0]))
    assert kept.name == "-2" and kept.shape.IsSame(low.shape)


def test_solids_of_a_compound_that_touch_are_cut_each_by_itself():
    boxes = [cq.Workplane().box(4, 4, 4).translate((4 * i, 0, 0)).val() for i in range(3)]
    leaf = Leaf(cq.Compound.makeCompound(boxes).wrapped, "row")
    (cut,) = cut_away([leaf], np.array([3.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    assert volume(cut) == pytest.approx(16 * 5.0)
    assert len(cq.Shape.cast(cut.shape).Solids()) == 2


def test_shells_and_wires_stay_open():
    sheet = cq.Workplane().rect(10, 10).extrude(5).faces("<Z").val()
    wire = cq.Workplane().moveTo(-5, 0).lineTo(5, 0).wire().val()
    leaves = [Leaf(sheet.wrapped, "sheet"), Leaf(wire.wrapped, "wire")]
    cut_sheet, cut_wire = cut_away(leaves, np.array([2.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    assert cq.Shape.cast(cut_sheet.shape).Area() == pytest.approx(70.0)
    assert sum(edge.Length() for edge in cq.Shape.cast(cut_wire.shape).Edges()) == pytest.approx(7.0)


def test_a_plane_that_comes_no_deeper_than_rounding_cuts_nothing():
    leaf = Leaf(cq.Workplane().box(4, 4, 4).val().wrapped, "block")
    (kept,) = cut_away([leaf], np.array([0.0, 0.0, 2.0 - 1e-12]), np.array([0.0, 0.0, 1.0]))
    assert kept.shape.IsSame(leaf.shape)
    assert cut_away([leaf], np.array([0.0, 0.0, -2.0 + 1e-12]), np.array([0.0, 0.0, 1.0])) == []
