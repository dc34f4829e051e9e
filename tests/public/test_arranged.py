"""`hlr.draw_arranged`: several views on one page, in line with one another."""

from __future__ import annotations

import re

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.pipeline import arranged


def bracket():
    """Nothing about it is even: each view shows on which side it lies."""
    return cq.Workplane().box(60, 40, 12).faces(">Z").workplane().center(15, 8).circle(9).extrude(20)


def lines_of(page, view):
    return [line for line in page.lines if page.parts[line.part].name.startswith(f"{view}/")]


def extent(lines):
    points = np.concatenate([line.points for line in lines])
    return points.min(axis=0), points.max(axis=0)


@pytest.mark.parametrize("method", ["first-angle", "third-angle"])
def test_each_view_is_the_drawing_of_that_view(method):
    page = hlr.draw_arranged(bracket(), method)
    scale = page.sheet.views[0].scale
    for view in page.sheet.views:
        alone = hlr.draw(bracket(), view.name, scale=scale)
        found = lines_of(page, view.name)
        assert [(x.kind, x.visible, x.edge) for x in found] == [(x.kind, x.visible, x.edge) for x in alone.lines]
        shift = extent(found)[0] - extent(alone.lines)[0]
        for one, other in zip(found, alone.lines, strict=True):
            assert one.points == pytest.approx(other.points + shift, abs=0.02)


def test_a_point_of_the_model_is_in_line_in_all_views_that_share_an_axis():
    page = hlr.draw_arranged(bracket(), "third-angle", ["front", "top", "bottom", "right", "left", "back"])
    at = {view: extent(lines_of(page, view)) for view in ("front", "top", "bottom", "right", "left", "back")}
    for view in ("top", "bottom"):
        assert [p[0] for p in at[view]] == pytest.approx([p[0] for p in at["front"]], abs=1e-6)
    for view in ("right", "left", "back"):
        assert [p[1] for p in at[view]] == pytest.approx([p[1] for p in at["front"]], abs=1e-6)


def test_the_scale_is_the_largest_at_which_all_fit():
    for size in (0.01, 1.0, 1000.0):
        shape = cq.Workplane(obj=bracket().val().scale(size))
        page = hlr.draw_arranged(shape)
        (scale,) = {view.scale for view in page.sheet.views}
        assert scale == pytest.approx(2.0 / size)
        low, high = extent(page.lines)
        assert (low >= 9.9).all()
        assert (high <= [287.1, 200.1]).all()


def test_a_ball_of_which_less_is_seen_than_its_box_is_drawn_once_more():
    # Meshes do not tell how far they reach; the corners of a box stand out in a pictorial view.
    points, triangles = (np.array(x) for x in cq.Workplane().sphere(40).val().tessellate(0.5, 0.3))
    mesh = np.array([p.toTuple() for p in points]), triangles
    page = hlr.draw_arranged(mesh, views=["iso", "front", "top"])
    (scale,) = {view.scale for view in page.sheet.views}
    bounds = extent(page.lines)
    assert scale == 1.0
    assert (bounds[1] - bounds[0] <= (277, 190)).all()


def test_a_scale_that_is_too_large_is_drawn_with_a_warning():
    page = hlr.draw_arranged(bracket(), options=hlr.Options(scale="5:1"))
    (note,) = (note for note in page.notes if note.is_warning)
    assert "the views, 663.6 x 423.1 mm at 5:1, are too large for the page" in note.text
    assert "give the scale 2:1, or a larger page" in note.text
    with pytest.raises(hlr.StrictError, match="too large for the page"):
        hlr.draw_arranged(bracket(), options=hlr.Options(scale="5:1", strict=True))


def test_sizes_of_pages_are_told_as_people_type_them():
    hall = cq.Workplane().box(50_000, 40_000, 12_000)
    page = hlr.draw_arranged(hall, options=hlr.Options(scale=1))
    (note,) = (note for note in page.notes if note.code == "page-too-small")
    assert " mm at 1:1, are too large for the page" in note.text
    assert not re.search(r"\de[+-]", note.text)
    with pytest.raises(hlr.OptionError, match="the room 0,0,1000000000,1 leads out"):
        hlr.draw_arranged(bracket(), room=(0, 0, 1e9, 1))


def test_lines_that_no_pen_can_show_are_told_once_for_the_page():
    plate = cq.Workplane().box(100, 100, 2).faces(">Z").workplane().rarray(40, 40, 2, 2).hole(0.3)
    page = hlr.draw_arranged(plate)
    assert sum(note.code == "details-left-out" for note in page.notes) == 1
    assert len(hlr.draw_arranged(plate, options=hlr.Options(details=True)).lines) > len(page.lines)


def test_rules_for_parts_hold_in_each_view():
    rule = hlr.LineRule(parts="solid", color="red")
    page = hlr.draw_arranged(
        cq.Assembly(name="all").add(bracket(), name="solid"), options=hlr.Options(style=hlr.Style(lines=(rule,)))
    )
    svg = page.to_svg()
    assert "#ff0000" in svg
    assert not re.search(r'<g id="visible"[^>]*stroke="#000000"[^>]*>\s*<g[^>]*>\s*<path', svg)
    assert (
        hlr.draw_arranged(bracket())
        .with_style(hlr.Style(lines=(hlr.LineRule(parts="*", color="red"),)))
        .to_svg()
        .count("#ff0000")
    )
    front = hlr.draw_arranged(bracket()).with_style(hlr.Style(lines=(hlr.LineRule(parts="front", color="red"),)))
    assert "#ff0000" not in front.to_svg()  # no part is called so


def test_the_symbol_has_the_colour_of_the_style():
    page = hlr.draw_arranged(bracket())
    dark = page.with_style("dark").to_svg()
    assert 'stroke="#000000"' not in dark[dark.index('id="template"') :].partition("</g>")[0].partition("<g fill")[2]
    assert page.with_style({"visible": {"color": "currentColor"}}).to_pdf().startswith(b"%PDF")


def test_a_narrow_page_has_no_symbol():
    narrow = hlr.draw_arranged(bracket(), views=["front"], options=hlr.Options(page=(40, 100)))
    assert 'id="template"' not in narrow.to_svg()


def test_what_all_views_took_is_told():
    page = hlr.draw_arranged(bracket())
    stages = ("source", "tessellate", "scene", "plan", "visibility", "linework")
    assert page.timings["total"] >= 0.99 * sum(page.timings[stage] for stage in stages)
    assert page.accuracy.deflection > 0.0


def test_pages_at_two_scales_are_compared_view_by_view():
    one, other = (
        hlr.draw_arranged(bracket(), options=hlr.Options(scale=scale, smooth=False, details=True)) for scale in (1, 2)
    )
    found = hlr.compare.compare(one, other)
    assert found.scales == (1.0, 2.0)
    assert not found.differences


def test_views_may_come_one_by_one():
    assert len(hlr.draw_arranged(bracket(), views=iter(["front", "top"])).sheet.views) == 2


@pytest.mark.parametrize(("method", "cone_first"), [("first-angle", True), ("third-angle", False)])
def test_the_symbol_of_the_method(method, cone_first):
    svg = hlr.draw_arranged(bracket(), method).to_svg()
    symbol = svg[svg.index('id="template"') :]
    cone, circle = float(re.search(r'd="M([\d.]+)', symbol)[1]), float(re.search(r'cx="([\d.]+)', symbol)[1])
    assert (cone < circle) is cone_first


@pytest.mark.parametrize(
    ("method", "views", "options", "words"),
    [
        ("second-angle", None, {}, "no method is called 'second-angle': give first-angle or third-angle"),
        (None, None, {}, "no method is called None"),
        ("first-angle", [], {}, "a page needs a view"),
        ("first-angle", ["front", "front"], {}, "the view front is given twice"),
        ("first-angle", None, {"fit": "A4"}, "only a view by itself has fit: leave out `fit`, or `arrange`"),
        (
            "first-angle",
            None,
            {"style": {"part-colors": "fills"}},
            "arranged views have lines alone: leave out `part_colors`",
        ),
        ("first-angle", None, {"up": (0, 1, 0), "within": 2.0}, "leave out `up` and `within`"),
        ("first-angle", None, {"page": (25, 25)}, "has no room for 4 views"),
    ],
)
def test_what_cannot_be_is_refused(method, views, options, words):
    with pytest.raises(hlr.OptionError, match=words):
        hlr.draw_arranged(bracket(), method, views, hlr.Options(**options))


def test_views_are_listed_as_of_other_functions():
    (one,) = hlr.draw_arranged(bracket(), views="front").sheet.views
    assert one.name == "front"
    with pytest.raises(hlr.ViewError, match=r"^3 is no list of views: give names such as 'iso', or directions\.$"):
        hlr.draw_arranged(bracket(), views=3)


def test_it_is_drawn_twice_at_most(monkeypatch):
    asked = []
    draw = arranged.draw_views
    monkeypatch.setattr(arranged, "draw_views", lambda *args, **more: asked.append(args) or draw(*args, **more))
    hlr.draw_arranged(bracket())
    assert len(asked) == 1
