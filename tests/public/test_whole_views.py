"""Views that are drawn whole besides their sections: names, letters, places on a page, files of all formats."""

from __future__ import annotations

import re

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.compare import compare
from hlr.errors import OptionError

VIEWS = ["front", "top", "left"]


@pytest.fixture(scope="module")
def model():
    return cq.Workplane().box(60, 40, 12).faces(">Z").workplane().center(15, 8).circle(9).extrude(20)


def page_of(model, views=VIEWS, method="first-angle", **options):
    return hlr.draw_arranged(model, method, views, hlr.Options(**options))


def of_view(page, name):
    """The lines of a view, and (2, 2) its lower left and upper right corner on the page."""
    lines = [line for line in page.lines if page.parts[line.part].name.startswith(f"{name}/")]
    points = np.concatenate([line.points for line in lines])
    return lines, np.array([points.min(axis=0), points.max(axis=0)])


def shown(page):
    return [(view.name, view.letter) for view in page.sheet.views]


@pytest.mark.parametrize("section", [{"left": 5}, [("left", 5)]])
@pytest.mark.parametrize("whole", ["left", ["left"], ("LEFT",), ["left", "left"]])
def test_a_page_shows_the_view_and_its_section(model, section, whole):
    page = page_of(model, section=section, whole=whole)
    assert shown(page) == [("front", ""), ("top", ""), ("left", ""), ("left-A", "A")]


def test_the_view_has_its_place_and_its_lines_and_the_section_lies_beside_it(model):
    page = page_of(model, section={"left": 5}, whole=["left"], scale=1)
    plain = page_of(model, scale=1)
    (_, at_front), (left, at_left), (cut, at_cut) = (of_view(page, name) for name in ("front", "left", "left-A"))
    assert len(left) == len(of_view(plain, "left")[0])
    assert {line.kind for line in left} & {"hatch"} == set()
    assert any(line.kind == "hatch" for line in cut)
    # In line with the front view, as without a section; the section in line with the view.
    assert at_left[:, 1] == pytest.approx(at_front[:, 1], abs=1e-6)
    assert at_left[0, 0] > at_front[1, 0]
    along = [k for k in (0, 1) if at_cut[:, k] == pytest.approx(at_left[:, k], abs=1e-6)]
    assert len(along) == 1


def test_the_cutting_line_is_that_of_a_section_in_the_place_of_its_view(model):
    def of_front(page):
        (mark,) = page.sheet.marks
        return np.array(mark.line) - of_view(page, "front")[1][0], mark.back, mark.letter

    one = of_front(page_of(model, section={"left": 5}, whole=["left"], scale=1))
    other = of_front(page_of(model, section={"left": 5}, scale=1))
    assert one[0] == pytest.approx(other[0], abs=1e-6)
    assert one[1:] == other[1:]


def test_a_view_that_is_drawn_whole_is_marked_rather_than_a_section(model):
    page = page_of(model, section=[("front", 0), ("left", 5), ("top", 8)], whole=["left"], scale=1)
    assert shown(page) == [("front", "A"), ("top", "C"), ("left", ""), ("left-B", "B")]
    _, (low, high) = of_view(page, "left")
    marked = {mark.letter: np.mean(mark.line, axis=0) for mark in page.sheet.marks}
    assert (marked["A"] > low).all() and (marked["A"] < high).all()
    assert (marked["C"] > low).all() and (marked["C"] < high).all()


def test_several_sections_of_a_view_and_the_view(model):
    planes = [("left", -10), ("left", 15)]
    assert shown(page_of(model, section=planes, whole="left")) == [
        ("front", ""), ("top", ""), ("left", ""), ("left-A", "A"), ("left-B", "B")
    ]  # fmt: skip
    assert shown(page_of(model, section=planes)) == [("front", ""), ("top", ""), ("left", "A"), ("left-B", "B")]


def test_a_pictorial_view_and_its_section(model):
    page = page_of(model, ["front", "iso"], "third-angle", section={"iso": (0, 0, 0)}, whole=["iso"])
    assert shown(page) == [("front", ""), ("iso", ""), ("iso-A", "A")]
    assert not any(line.kind == "hatch" for line in of_view(page, "iso")[0])
    assert any(line.kind == "hatch" for line in of_view(page, "iso-A")[0])


def test_a_view_without_a_place_on_the_list_is_added(model):
    page = hlr.draw_arranged(model, "first-angle", options=hlr.Options(section={"right": True}, whole=["right"]))
    assert [view.name for view in page.sheet.views] == ["front", "top", "left", "iso", "right", "right-A"]


def test_all_formats_have_both(model, tmp_path):
    import ezdxf

    page = page_of(model, section={"left": 5}, whole=["left"], style={"dxf": "R2018"})
    svg = page.to_svg()
    assert re.findall(r'<view name="([\w-]+)"[^>]*?(?: section="(.*?)")?/>', svg) == [
        ("front", ""), ("top", ""), ("left", ""), ("left-A", "A-A")
    ]  # fmt: skip
    assert re.findall(r">([^<>]+)</text>", svg) == ["A", "A", "A-A"]
    document = ezdxf.readfile(page.save(tmp_path / "page.dxf"))
    texts = [text.dxf.text for text in document.modelspace().query('TEXT[layer=="SECTION_MARKS"]')]
    assert sorted(texts) == ["A", "A", "A-A"]
    again = hlr.load(page.save(tmp_path / "page.json"))
    assert again.to_svg() == svg
    for ending in ("svg", "pdf", "dxf", "json"):
        assert compare(page, page.save(tmp_path / f"page.{ending}")).same


def test_drawings_by_themselves(model):
    asked = hlr.Options(section=[("left", -10), ("left", 15)], whole=["left"], scale=1)
    drawn = hlr.draw_views(model, VIEWS, asked)
    assert [drawing.view.name for drawing in drawn] == ["front", "top", "left", "left-A", "left-B"]
    assert [drawing.section is not None for drawing in drawn] == [False, False, False, True, True]
    plain, alone = hlr.draw(model, "left", scale=1), hlr.draw(model, "left", section=15, scale=1)
    assert drawn[2].to_svg() == plain.to_svg()
    assert [line.points.tolist() for line in drawn[4].lines] == [line.points.tolist() for line in alone.lines]
    for drawing in drawn:
        (again,) = hlr.draw_views(model, [drawing.request.view], drawing.request.options)
        assert (len(again.lines), again.section) == (len(drawing.lines), drawing.section)
    assert [each.view for each in hlr.plan_views(model, ["left"], asked)] == ["left", "left-A", "left-B"]


def test_one_place_for_all_views(model):
    drawn = hlr.draw_views(model, ["left", "front"], hlr.Options(section=True, whole=["front"], scale=1))
    assert [(drawing.view.name, drawing.section is None) for drawing in drawn] == [
        ("left", False), ("front", True), ("front-B", False)
    ]  # fmt: skip


def test_views_of_two_pages_are_told_apart(model):
    both = page_of(model, section={"left": 5}, whole=["left"], scale=1)
    found = compare(both, page_of(model, section={"left": 5}, scale=1), register="translation")
    assert [(row.name, row.before, row.after) for row in found.views] == [
        ("front", True, True), ("top", True, True), ("left", True, False), ("left-A / left", True, True)
    ]  # fmt: skip
    found = compare(page_of(model, scale=1), both, register="translation")
    assert [row.name for row in found.views if not row.before] == ["left-A"]
    for name in ("left", "left-A"):
        (alone,) = (
            each
            for each in hlr.draw_views(model, ["left"], hlr.Options(section={"left": 5}, whole=["left"], scale=1))
            if each.view.name == name
        )
        (row,) = (row for row in compare(alone, both).views if row.before and row.after)
        assert row.name == name and row.same_mm > 50.0 and not any(row.mm.values())


def test_one_drawing_is_no_view_and_section(model):
    with pytest.raises(OptionError, match="one drawing is cut once: draw a view and its sections with draw_views"):
        hlr.draw(model, "left", section=5, whole="left")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"whole": ["left"]}, "`whole` is for the views of sections: give `section` as well, or leave it out"),
        ({"section": {"left": 5}, "whole": ["top"]}, "`whole` top is none of the sections, left: leave it out"),
        ({"section": {"left": 5}, "whole": 7}, r'whole needs a list of views, such as \["left"\], not 7'),
        ({"section": {"left": 5}, "whole": "lft"}, "`whole`: no view is called 'lft'"),
        ({"section": {"left": 5}, "whole": [7]}, "`whole`: 7 is no view"),
    ],
)
def test_what_cannot_be_is_refused(model, options, message):
    with pytest.raises(OptionError, match=message):
        page_of(model, **options)
    with pytest.raises(OptionError, match=message):
        hlr.draw_views(model, VIEWS, hlr.Options(**options))
