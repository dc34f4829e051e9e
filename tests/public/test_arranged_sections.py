"""Sections among the views of one page: cutting lines, arrows, letters and names, and where they lie."""

from __future__ import annotations

import re

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.drawing.section_marks import BEYOND, JOG, REACH, SectionMark, shapes_of
from hlr.errors import OptionError
from hlr.request.shown_views import LETTERS, letter_of


def bracket():
    """Nothing about it is even: each view shows on which side it lies."""
    return cq.Workplane().box(60, 40, 12).faces(">Z").workplane().center(15, 8).circle(9).extrude(20)


def page_of(method="first-angle", views=None, thing=None, **options):
    return hlr.draw_arranged(bracket() if thing is None else thing, method, views, hlr.Options(**options))


def extent(page, view, hatch=True):
    """(2, 2) lower left and upper right corner of a view."""
    of = [x for x in page.lines if page.parts[x.part].name.startswith(f"{view}/") and (hatch or x.kind != "hatch")]
    points = np.concatenate([line.points for line in of])
    return np.array([points.min(axis=0), points.max(axis=0)])


def test_a_section_takes_the_place_of_its_view():
    page = page_of(section={"front": True})
    assert [(view.name, view.letter) for view in page.sheet.views] == [
        ("front", "A"), ("top", ""), ("left", ""), ("iso", "")
    ]  # fmt: skip
    front, top, left = (extent(page, view) for view in ("front", "top", "left"))
    assert front[:, 0] == pytest.approx(top[:, 0], abs=1e-6)
    assert front[:, 1] == pytest.approx(left[:, 1], abs=1e-6)
    assert {page.parts[x.part].name for x in page.lines if x.kind == "hatch"} == {"front/part"}


def test_the_cutting_line_lies_where_the_plane_is_and_its_arrows_look_as_the_viewer_does():
    page = page_of(section={"front": 5.0})
    (mark,) = page.sheet.marks
    (scale,) = {view.scale for view in page.sheet.views}
    low, high = extent(page, "top")
    (ax, ay), (bx, by) = mark.line
    # The view from above has y up: -20 to 20 mm.
    assert (ay, by) == pytest.approx((low[1] + 25.0 * scale, low[1] + 25.0 * scale), abs=1e-3)
    assert (ax, bx) == pytest.approx((low[0] - BEYOND, high[0] + BEYOND), abs=1e-3)
    assert mark.back == pytest.approx((0.0, -1.0))
    assert (mark.letter, mark.title) == ("A", "A-A")
    front = extent(page, "front")
    assert mark.name[0] == pytest.approx(front[:, 0].mean(), abs=1e-3)
    assert front[1, 1] < mark.name[1] < front[1, 1] + REACH


@pytest.mark.parametrize(
    ("method", "view", "back"),
    [
        ("first-angle", "left", (-1.0, 0.0)),
        ("third-angle", "right", (1.0, 0.0)),
        ("third-angle", "top", (0.0, 1.0)),
        ("first-angle", "bottom", (0.0, -1.0)),
    ],
)
def test_sections_from_other_sides_are_marked_in_the_front_view(method, view, back):
    page = page_of(method, section={view: True})
    (mark,) = page.sheet.marks
    assert mark.back == pytest.approx(back)
    low, high = extent(page, "front")
    middle = np.mean(mark.line, axis=0)
    assert (middle > low).all() and (middle < high).all()


@pytest.mark.parametrize("view", ["front", "back"])
def test_the_cutting_line_of_a_plane_that_steps_jogs_with_thick_corners(view):
    page = page_of(
        "first-angle", ["front", "top", *([view] if view != "front" else [])], section={view: (5.0, (10.0, -8.0))}
    )
    (mark,) = page.sheet.marks
    (scale,) = {each.scale for each in page.sheet.views}
    low, high = extent(page, "top")
    # The view from above: x from -30 to 30, y from -20 to 20 mm.
    x, first, then = low[0] + 40.0 * scale, low[1] + 25.0 * scale, low[1] + 12.0 * scale
    wanted = [(low[0] - BEYOND, first), (x, first), (x, then), (high[0] + BEYOND, then)]
    assert np.array(mark.line) == pytest.approx(np.array(wanted), abs=1e-3)
    assert mark.back == pytest.approx((0.0, -1.0 if view == "front" else 1.0))
    shapes = shapes_of(mark)
    assert len(shapes.chain) == 3 and len(shapes.arrows) == 2
    thick = [ends for ends in shapes.wide if ends[0] in mark.line[1:-1]]
    lengths = [float(np.hypot(*np.subtract(*ends))) for ends in thick]
    assert lengths == pytest.approx([JOG] * 4)
    tips = [np.array(arrow[0]) for arrow in shapes.arrows]
    for tip, end in zip(tips, (mark.line[0], mark.line[-1]), strict=True):
        assert np.abs(tip - end).max() < 1e-6


def test_steps_are_marked_in_the_view_that_sees_them_and_else_in_none():
    both = page_of(views=["front", "left", "top"], section={"left": (5.0, (-4.0, 20.0))})
    (mark,) = both.sheet.marks
    low, high = extent(both, "top")
    assert all(low[0] < x < high[0] for x, _ in mark.line)
    below = page_of(views=["front", "left", "bottom"], section={"left": (5.0, (-4.0, 20.0))})
    line = np.array(below.sheet.marks[0].line)
    low, high = extent(below, "bottom")
    (scale,) = {each.scale for each in below.sheet.views}
    # From below y points down: the line begins where y is large.
    x, y = low[0] + np.array([35.0, 50.0]) * scale, high[1] - 16.0 * scale
    wanted = [(x[1], low[1] - BEYOND), (x[1], y), (x[0], y), (x[0], high[1] + BEYOND)]
    assert line == pytest.approx(np.array(wanted), abs=1e-3)
    alone = page_of(views=["front", "left"], section={"left": (5.0, (-4.0, 20.0))})
    assert alone.sheet.marks[0].line is None
    assert [note.code for note in alone.notes] == ["section-not-marked"]


def test_files_of_a_page_show_the_jogs(tmp_path):
    page = page_of(section={"front": (5.0, (10.0, -8.0))})
    group = page.to_svg().partition('<g class="section"')[2].partition("</g>")[0]
    assert group.count("stroke-dasharray") == 3
    import ezdxf

    document = ezdxf.readfile(page.save(tmp_path / "page.dxf"))
    lines = document.modelspace().query('LINE[layer=="SECTION_MARKS"]')
    assert len(lines) == 3 + 2 + 2 + 4


def boxes_of(mark, name=False):
    """(n, 2, 2) around letters, or the name: each letter is 3.75 mm wide and 5 mm high at most."""
    texts = [(place, text) for place, text in shapes_of(mark).texts if ("-" in text) == name]
    return [
        (np.array(place) - (1.875 * len(text), 2.5), np.array(place) + (1.875 * len(text), 2.5))
        for place, text in texts
    ]


def test_letters_of_opposite_views_of_one_plane_lie_apart():
    for other in (True, 0.5):
        one, two = page_of(section={"left": True, "right": other}).sheet.marks
        assert one.back[0] == -two.back[0]
        for low, high in boxes_of(one):
            assert not any((low < top).all() and (bottom < high).all() for bottom, top in boxes_of(two))


@pytest.mark.parametrize("method", ["first-angle", "third-angle"])
@pytest.mark.parametrize("side", [("left",), ("right",), ("left", "right")])
def test_a_name_lies_clear_of_the_cutting_lines_in_its_view(method, side):
    """All views are sections: that from the front has its name above, and the cutting lines of the sides."""
    views = ["front", "top", *side]
    flange = cq.Workplane().circle(40).extrude(10).faces(">Z").workplane().circle(15).extrude(20)
    page = page_of(method, views, flange, section=dict.fromkeys(views, True))
    for mark in page.sheet.marks:
        ((low, high),) = boxes_of(mark, name=True)
        for other in page.sheet.marks:
            shapes = shapes_of(other)
            for a, b in [*shapes.wide, *shapes.chain, *(arrow[:2] for arrow in shapes.arrows), *boxes_of(other)]:
                assert not ((low < np.maximum(a, b)).all() and (np.minimum(a, b) < high).all())
    front = page.sheet.marks[0].name
    assert abs(front[0] - extent(page, "front")[:, 0].mean()) < 25.0


def test_an_oblique_section_is_marked_where_it_is_seen_from_its_edge():
    page = page_of(views=["front", "top", (1, -1, 0)], section={"1,-1,0": (0, 0, 0)})
    (mark,) = page.sheet.marks
    assert mark.back == pytest.approx((np.sqrt(0.5), -np.sqrt(0.5)))
    way = np.subtract(*mark.line)
    assert way[0] == pytest.approx(way[1])


def test_each_section_has_its_letter_and_all_marks_lie_on_the_page():
    for method in ("first-angle", "third-angle"):
        page = page_of(method, section={"front": True, "top": 3.0, "left": True})
        assert [mark.letter for mark in page.sheet.marks] == ["A", "B", "C"]
        for mark in page.sheet.marks:
            shapes = shapes_of(mark)
            points = [p for each in (*shapes.wide, *shapes.chain, *shapes.arrows) for p in each]
            points += [place for place, _ in shapes.texts]
            low, high = np.min(points, axis=0), np.max(points, axis=0)
            assert (low > 10.0).all() and (high < [page.page.width - 10.0, page.page.height - 10.0]).all()


def test_the_name_of_a_section_is_clear_of_other_views():
    page = page_of(section={"front": True, "top": True})
    for mark in page.sheet.marks:
        for view in ("front", "top", "left"):
            low, high = extent(page, view)
            x, y = mark.name
            assert not (low[0] < x < high[0] and low[1] < y < high[1])


def test_a_section_that_shows_less_stays_in_line_and_all_views_on_the_page():
    """What lies before the plane is wider than what is left."""
    step = cq.Workplane().box(20, 20, 20).union(cq.Workplane().box(190, 6, 10).translate((85, -12, 0)))
    page = page_of(thing=step, section={"front": 0.0})
    (scale,) = {view.scale for view in page.sheet.views}
    front, top = extent(page, "front"), extent(page, "top")
    # The block goes from -10 to 10, as does the arm that was cut off, to 180.
    assert front[0, 0] - top[0, 0] == pytest.approx(0.0, abs=1e-6)
    assert (front[1, 0] - front[0, 0], top[1, 0] - top[0, 0]) == pytest.approx((20 * scale, 190 * scale), abs=1e-3)
    assert page.sheet.views[1].place[0] == pytest.approx(top[:, 0].mean(), abs=1e-3)
    points = np.concatenate([line.points for line in page.lines])
    assert (points > 10.0).all()
    assert (points < [page.page.width - 10.0, page.page.height - 10.0]).all()


def test_a_page_that_sees_no_plane_from_its_edge_says_so():
    page = page_of(views=["front", "iso"], section={"front": True})
    (note,) = page.notes
    assert (note.code, note.is_warning) == ("section-not-marked", False)
    assert note.text == "no view of the page sees the plane of section A-A from its edge: none marks it."
    assert page.sheet.marks[0].line is None


def test_a_whole_view_is_marked_before_a_section_is():
    page = page_of(views=["front", "top", "left"], section={"front": True, "top": True})
    front, left = extent(page, "front"), extent(page, "left")
    first, second = (np.mean(mark.line, axis=0) for mark in page.sheet.marks)
    assert (first > left[0]).all() and (first < left[1]).all()
    assert (second > left[0]).all() and (second < left[1]).all()
    page = page_of(views=["front", "top"], section={"front": True, "top": True})
    middle = np.mean(page.sheet.marks[1].line, axis=0)
    front = extent(page, "front")
    assert (middle > front[0]).all() and (middle < front[1]).all()


def test_pens_are_not_thinner_because_of_hatches():
    pins = [cq.Workplane().box(4, 4, 30).translate((12 * k, 0, 0)) for k in range(10)]
    plain, cut = page_of(thing=pins), page_of(thing=pins, section={"front": True})
    assert sum(line.kind == "hatch" for line in cut.lines) > 200
    assert plain.group is cut.group is None
    assert cut.notes == ()


def test_pages_without_sections_keep_their_gaps_and_have_no_marks():
    assert page_of().sheet.marks == ()
    low, high = (extent(page_of(), view) for view in ("front", "left"))
    assert high[0, 0] - low[1, 0] < 2.0 * REACH + 20.0


@pytest.mark.parametrize("section", [True, 5.0, (0, 0, 0)])
def test_one_place_for_all_views_is_refused(section):
    with pytest.raises(OptionError, match=r'a page of several views has sections by name: give \{"front": True\}'):
        page_of(section=section)


def test_a_section_that_is_none_of_the_views_is_refused_but_added_to_the_usual_ones():
    with pytest.raises(OptionError, match="section left is none of the views, front and top"):
        page_of(views=["front", "top"], section={"left": True})
    assert [view.name for view in page_of(section={"right": True}).sheet.views] == [
        "front", "top", "left", "iso", "right"
    ]  # fmt: skip


def test_svg_and_pdf_print_the_marks_in_the_pens_of_the_style():
    page = page_of(section={"front": True}, style="dark")
    svg = page.to_svg()
    marks = svg.partition('<g class="section"')[2].partition("</g>")[0]
    assert 'stroke="#e8e8e8" stroke-width="0.5"' in marks.partition(">")[0]
    assert re.findall(r">([^<>]+)</text>", marks) == ["A", "A", "A-A"]
    assert marks.count("stroke-dasharray") == 1
    assert ' section="A-A"/>' in svg
    assert page.to_pdf() != page_of(style="dark").to_pdf()
    assert page.to_png() == page_of(section={"front": True}, style="dark").to_png()


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
def test_dxf_has_the_marks_on_a_layer_of_their_own(tmp_path, version):
    import ezdxf

    page = page_of(section={"front": True}, style={"dxf": version, "visible": {"color": "#123456"}})
    document = ezdxf.readfile(page.save(tmp_path / "page.dxf"))
    assert not document.audit().has_errors
    marks = document.modelspace().query('*[layer=="SECTION_MARKS"]')
    kinds = sorted(entity.dxftype() for entity in marks)
    assert kinds == ["LINE"] * 5 + ["SOLID"] * 2 + ["TEXT"] * 3
    assert sorted(entity.dxf.text for entity in marks if entity.dxftype() == "TEXT") == ["A", "A", "A-A"]
    assert len({entity.dxf.linetype for entity in marks if entity.dxftype() == "LINE"}) == 2
    again = page_of(section={"front": True}, style={"dxf": version, "visible": {"color": "#123456"}})
    assert again.to_dxf() == page.to_dxf()


def test_marks_are_no_lines_of_a_comparison(tmp_path):
    page = page_of(section={"front": True})
    paths = [page.save(tmp_path / f"page.{ending}") for ending in ("svg", "pdf", "dxf")]
    for path in paths:
        assert hlr.compare.compare(page, path).same


def test_letters_go_on_after_the_last():
    assert [letter_of(k) for k in (0, 7, 8, len(LETTERS) - 1, len(LETTERS))] == ["A", "H", "J", "Z", "A2"]


def test_a_short_cutting_line_has_ends_that_meet():
    shapes = shapes_of(SectionMark("A", (0.0, 0.0), ((0.0, 0.0), (4.0, 0.0)), (0.0, 1.0)))
    assert shapes.wide[:2] == [((0.0, 0.0), (2.0, 0.0)), ((4.0, 0.0), (2.0, 0.0))]
