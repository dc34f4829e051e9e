"""What OpenCASCADE may do wrong where it cuts a shape is noticed, and the cut tried again, or refused."""

import cadquery as cq
import numpy as np
import pytest

from hlr.errors import SourceError
from hlr.source.cad import half_space
from hlr.source.cad.cut_check import CutCheck, has_surfaces, is_closed
from hlr.source.cad.parts import Leaf
from hlr.source.stepped import Stepped
from support.brep_shapes import bare_triangles

ORIGIN, UP = np.zeros(3), np.array([0.0, 0.0, 1.0])
PLANE = Stepped(UP, np.array([1.0, 0.0, 0.0]), np.zeros(1), np.zeros(0))


def block(z=0.0, height=4.0):
    return cq.Workplane().box(4, 4, height).translate((0, 0, z)).val().wrapped


def lidless(z=0.0, height=4.0):
    return cq.Workplane(obj=cq.Shape.cast(block(z, height))).faces("not >Z").vals()


def lidless_shell():
    return cq.Shell.makeShell(lidless(-1, 2)).wrapped


def doubled():
    from hlr.source.cad.shapes import make_compound

    return make_compound([block(-1, 2) for _ in range(3)])


def test_a_shape_is_closed_where_each_of_its_edges_has_two_faces():
    assert is_closed(block())
    assert is_closed(cq.Workplane().sphere(3).val().wrapped)
    assert is_closed(cq.Workplane().circle(2).extrude(5).val().wrapped)
    assert not is_closed(cq.Shell.makeShell(lidless()).wrapped)
    assert not is_closed(cq.Workplane().lineTo(3, 0).wire().val().wrapped)


def test_what_a_cut_must_do():
    check = CutCheck(block(), PLANE, 7.0)
    assert check.is_cut(block(-1, 2), False) and check.is_sound(block(-1, 2))
    assert not check.is_cut(block(), True)  # all of it is left
    assert not check.is_cut(None, False)  # it is lost
    assert not check.is_cut(block(0.5, 3), False)  # some before the plane is left
    assert not check.is_cut(block(-0.5, 1), False)  # some behind it is lost
    assert not check.is_sound(lidless_shell())
    # What was open may be open, and what does not reach the plane may stay, or go.
    assert CutCheck(cq.Shell.makeShell(lidless()).wrapped, PLANE, 7.0).is_sound(cq.Shell.makeShell(lidless()).wrapped)
    assert CutCheck(block(-3), PLANE, 7.0).is_cut(block(-3), True)
    assert CutCheck(block(3), PLANE, 7.0).is_cut(None, False)
    assert not CutCheck(cq.Workplane().sphere(3).val().wrapped, PLANE, 7.0).is_cut(None, False)


def test_vertices_may_lie_off_the_plane_by_some_tolerances_but_not_far():
    from OCP.ShapeFix import ShapeFix_ShapeTolerance

    loose = block()
    ShapeFix_ShapeTolerance().SetTolerance(loose, 0.01)
    assert CutCheck(loose, PLANE, 7.0).is_cut(block(-0.98, 2.04), False)
    assert not CutCheck(block(), PLANE, 7.0).is_cut(block(-0.98, 2.04), False)
    ShapeFix_ShapeTolerance().SetTolerance(loose, 0.5)
    assert not CutCheck(loose, PLANE, 7.0).is_cut(loose, False)


@pytest.mark.parametrize("wrong", ["whole", "lost", "failed", "open"])
def test_a_shape_that_is_not_cut_as_it_should_is_cut_again_more_loosely(monkeypatch, wrong):
    tried, without = [], half_space._without
    opened = lidless_shell()

    def fails_at_first(shape, tool, near):
        tried.append(near)
        if len(tried) < 3:
            return {"whole": shape, "lost": None, "failed": half_space._FAILED, "open": opened}[wrong]
        return without(shape, tool, near)

    monkeypatch.setattr(half_space, "_without", fails_at_first)
    (cut,) = half_space.cut_away([Leaf(block(), "block")], ORIGIN, UP)
    assert cq.Shape.cast(cut.shape).Volume() == pytest.approx(32.0)
    assert tried == pytest.approx([0.0, 1e-8 * np.sqrt(48), 1e-7 * np.sqrt(48)], rel=1e-3)


def test_a_shape_that_a_block_does_not_cut_is_cut_by_half_of_space(monkeypatch):
    tried, without = [], half_space._without

    def fails_with_blocks(shape, tool, near):
        tried.append(tool)
        return half_space._FAILED if len(tried) < 5 else without(shape, tool, near)

    monkeypatch.setattr(half_space, "_without", fails_with_blocks)
    (cut,) = half_space.cut_away([Leaf(block(), "block")], ORIGIN, UP)
    assert cq.Shape.cast(cut.shape).Volume() == pytest.approx(32.0)
    assert len(tried) == 5


@pytest.mark.parametrize("left", [lambda: block(-1, 2).Reversed(), lidless_shell, lambda: None, doubled])
def test_what_half_of_space_leaves_is_taken_as_a_smaller_body_alone(monkeypatch, left):
    tried = []
    monkeypatch.setattr(
        half_space, "_without", lambda *_: half_space._FAILED if tried.append(1) or len(tried) < 5 else left()
    )
    with pytest.raises(SourceError, match="its shape is not sound"):
        half_space.cut_away([Leaf(block(), "block")], ORIGIN, UP)


def test_a_shape_that_cannot_be_cut_is_refused_and_one_that_is_left_open_is_taken(monkeypatch):
    monkeypatch.setattr(half_space, "_without", lambda shape, tool, near: shape)
    with pytest.raises(
        SourceError, match='"block" cannot be cut by the plane of a section, because its shape is not sound'
    ):
        half_space.cut_away([Leaf(block(), "block")], ORIGIN, UP)
    opened = lidless_shell()
    monkeypatch.setattr(half_space, "_without", lambda shape, tool, near: opened)
    (cut,) = half_space.cut_away([Leaf(block(), "block")], ORIGIN, UP)
    assert cut.shape.IsSame(opened)


def test_a_shape_that_an_oblique_plane_misses_stays_the_same_though_its_box_is_crossed():
    bar = cq.Workplane().box(40, 4, 4).translate((0, 3, 0)).rotate((0, 0, 0), (0, 0, 1), 45).val().wrapped
    normal = np.array([1.0, -1.0, 0.0])
    (kept,) = half_space.cut_away([Leaf(bar, "bar")], np.zeros(3), normal)
    assert kept.shape.IsSame(bar)
    assert half_space.cut_away([Leaf(bar, "bar")], np.zeros(3), -normal) == []


def test_faces_that_are_triangles_without_surfaces_are_refused():
    solid = cq.Workplane().box(1, 2, 3).val().wrapped
    assert has_surfaces(solid)
    with pytest.raises(SourceError, match=r'"bare" cannot be cut .* because its faces are triangles without surfaces'):
        half_space.cut_away([Leaf(bare_triangles(solid), "bare")], ORIGIN, UP)
