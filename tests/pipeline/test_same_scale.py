"""Views of one scale: the smallest of those that each would have for itself."""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr

VIEWS = ["front", "top", "right", "iso"]


def bar():
    """120 x 30 x 20, with a bore: views of very different sizes."""
    return cq.Workplane().box(120, 30, 20).faces(">X").hole(10)


def ball():
    """A ball on a rod: the page turns, and outlines of curved faces tell the size."""
    return cq.Workplane().sphere(20).union(cq.Workplane("YZ").cylinder(190, 8))


def alike(one, other):
    """Whether two drawings are the same but for the mesh: views drawn together share the finest."""
    assert (one.scale, one.page, one.area.width) == (other.scale, other.page, pytest.approx(other.area.width, abs=0.02))
    assert [(line.kind, line.visible) for line in one.lines] == [(line.kind, line.visible) for line in other.lines]


@pytest.mark.parametrize("model", [bar, ball])
@pytest.mark.parametrize("asked", [{}, {"page": "A3"}, {"page": (150, 90)}, {"fit": (100, 70)}, {"fit": "A5"}])
def test_the_smallest_scale_is_that_of_all_views(model, asked):
    alone = hlr.draw_views(model(), VIEWS, hlr.Options(**asked))
    together = hlr.draw_views(model(), VIEWS, hlr.Options(same_scale=True, **asked))
    assert len({drawing.scale for drawing in alone}) > 1
    assert {drawing.scale for drawing in together} == {min(drawing.scale for drawing in alone)}
    assert [drawing.page.name for drawing in together if drawing.page] == [d.page.name for d in alone if d.page]
    smallest = [drawing.scale for drawing in alone].index(together[0].scale)
    alike(together[smallest], alone[smallest])


@pytest.mark.parametrize("asked", [{}, {"page": "A3"}, {"fit": "A5"}, {"fit": (100, 70)}])
def test_what_was_asked_for_gives_the_same_drawing_again(asked):
    drawings = hlr.draw_views(bar(), VIEWS, hlr.Options(same_scale=True, **asked))
    for drawing in drawings:
        again = hlr.draw_views(bar(), [drawing.request.view], drawing.request.options)[0]
        alike(again, drawing)


def test_with_a_scale_or_a_single_view_nothing_changes():
    for views, asked in ((VIEWS, {"scale": 0.5}), (["iso"], {})):
        plain, same = (hlr.draw_views(bar(), views, hlr.Options(same_scale=on, **asked)) for on in (False, True))
        assert [drawing.to_svg() for drawing in plain] == [drawing.to_svg() for drawing in same]


def test_finer_and_finer_drawings_have_one_scale():
    drawings = hlr.draw_views(bar(), VIEWS, hlr.Options(same_scale=True, within=2.0))
    assert len({drawing.scale for drawing in drawings}) == 1
