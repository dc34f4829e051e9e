"""Several sections of one view: on a page each has its letter, cutting line, name and place; by themselves, a name."""

from __future__ import annotations

import re
from functools import cache
from itertools import combinations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.compare import compare
from hlr.drawing.section_marks import BEYOND, FARTHER, LETTER, shapes_of
from hlr.errors import OptionError

TWO = [("left", -10), ("left", 15)]


@cache
def bracket(scale=1.0):
    """Nothing about it is even: each view shows on which side it lies."""
    made = cq.Workplane().box(60, 40, 12).faces(">Z").workplane().center(15, 8).circle(9).extrude(20)
    return cq.Workplane(obj=made.val().scale(scale))


def page_of(section, method="first-angle", views=None, size=1.0, **options):
    return hlr.draw_arranged(bracket(size), method, views, hlr.Options(section=section, **options))


def extent(page, view, hatch=True):
    """(2, 2) lower left and upper right corner of a view."""
    of = [x for x in page.lines if page.parts[x.part].name.startswith(f"{view}/") and (hatch or x.kind != "hatch")]
    points = np.concatenate([line.points for line in of])
    return np.array([points.min(axis=0), points.max(axis=0)])


def ink_of(mark):
    """(n, 2) points of the ends of a cutting line, its arrows, and the corners of its letters."""
    shapes = shapes_of(mark)
    ends = [
        *shapes.wide,
        *((tip, left) for tip, left, _ in shapes.arrows),
        *((tip, back) for tip, _, back in shapes.arrows),
    ]
    points = [np.linspace(a, b, 40) for a, b in ends]
    half = 0.5 * LETTER * np.array([(0.75 * x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)])
    return np.concatenate([*points, *(np.array(place) + half for place, text in shapes.texts if text == mark.letter)])


def test_each_has_its_letter_in_the_order_asked_for_and_its_cutting_line_in_the_same_view():
    page = page_of([("left", -10), ("top", 3), ("left", 15)])
    assert [(view.name, view.letter) for view in page.sheet.views] == [
        ("front", ""), ("top", "B"), ("left", "A"), ("left-C", "C"), ("iso", "")
    ]  # fmt: skip
    assert [mark.title for mark in page.sheet.marks] == ["A-A", "B-B", "C-C"]
    (scale,) = {view.scale for view in page.sheet.views}
    low, high = extent(page, "front")
    for mark, x in zip((page.sheet.marks[0], page.sheet.marks[2]), (-10.0, 15.0), strict=True):
        (ax, ay), (bx, by) = mark.line
        assert (ax, bx) == pytest.approx([low[0] + (30.0 + x) * scale] * 2, abs=1e-3)
        assert (ay, by) == pytest.approx((low[1] - BEYOND, high[1] + BEYOND), abs=1e-3)
        assert mark.back == pytest.approx((-1.0, 0.0))
    for name, mark in (("left", page.sheet.marks[0]), ("left-C", page.sheet.marks[2])):
        low, high = extent(page, name)
        assert low[0] < mark.name[0] < high[0] and high[1] < mark.name[1] < high[1] + 10.0
    assert {page.parts[x.part].name for x in page.lines if x.kind == "hatch"} == {
        "top/part",
        "left/part",
        "left-C/part",
    }


@pytest.mark.parametrize("section", [{"left": -10, "top": True}, {"top": True, "left": -10}])
def test_letters_of_several_views_are_in_the_order_asked_for_as_well(section):
    page = page_of(section)
    letters = {view.name: view.letter for view in page.sheet.views if view.letter}
    assert letters == dict(zip(section, "AB", strict=True))


def test_each_is_the_section_that_it_is_by_itself():
    """The hatch is the same in both sections of the page; by itself each has its own, in the same places."""
    page = page_of(TWO)
    (scale,) = {view.scale for view in page.sheet.views}
    for name, place in (("left", -10), ("left-B", 15)):
        alone = hlr.draw(bracket(), "left", section=place, scale=scale, details=True)
        low = extent(page, name)[0]
        edges = [x for x in page.lines if page.parts[x.part].name == f"{name}/part" and x.kind != "hatch"]
        ours = [x.points - low for x in edges]
        theirs = [x.points - (alone.bounds.x0, alone.bounds.y0) for x in alone.lines if x.kind != "hatch"]
        ends = [sorted(tuple(np.round(x[k], 2)) for k in (0, -1)) for x in ours]
        assert sorted(ends) == sorted(sorted(tuple(np.round(x[k], 2)) for k in (0, -1)) for x in theirs)
        hatched = compare(page, alone)
        assert not hatched.differences and [row.name for row in hatched.views if row.before and row.after] == [name]


@pytest.mark.parametrize(
    ("method", "view", "beside"),
    [("first-angle", "left", 1.0), ("third-angle", "right", 1.0), ("third-angle", "left", -1.0)],
)
def test_they_lie_in_line_beyond_the_first(method, view, beside):
    page = page_of([(view, -20), (view, 0), (view, 20)], method, ["front", view], scale=0.5)
    first, second, third = (extent(page, name, hatch=False) for name in (view, f"{view}-B", f"{view}-C"))
    front = extent(page, "front")
    for one, other in ((front, first), (first, second), (second, third)):
        assert other[:, 1][0] == pytest.approx(one[:, 1][0], abs=1e-6)
        left, right = (one, other) if beside > 0.0 else (other, one)
        assert right[0, 0] - left[1, 0] > 2.0 * BEYOND


def test_below_one_another_they_are_in_line_as_well():
    page = page_of([("top", 3), ("top", -3), ("top", 10)], "third-angle", ["front", "top"], page="A4-portrait")
    sides = np.array([extent(page, name)[:, 0] for name in ("front", "top", "top-B")])
    assert np.abs(sides - sides[0]).max() < 1e-6
    boxes = [extent(page, view.name) for view in page.sheet.views]
    for a, b in combinations(boxes, 2):
        assert ((a[1] < b[0]) | (b[1] < a[0])).any()


@pytest.mark.parametrize("size", [1.0 / 60.0, 1.0, 100_000.0 / 60.0])
def test_marks_that_are_close_together_lie_side_by_side_at_any_size(size):
    page = page_of(
        [("left", 15 * size), ("left", 13 * size), ("left", -10 * size)], size=size, page="A3", scale=1.0 / size
    )
    assert page.notes == ()
    for one, other in combinations(page.sheet.marks, 2):
        apart = np.hypot(*(ink_of(one)[:, None] - ink_of(other)[None]).T)
        assert apart.min() > 0.5, (one.letter, other.letter)
    ends = {mark.letter: np.array(mark.line)[:, 1] for mark in page.sheet.marks}
    # The plane that is farther from the viewer ends farther out.
    assert np.abs(ends["A"] - ends["B"]) == pytest.approx([FARTHER, FARTHER], abs=1e-6)
    assert ends["B"] == pytest.approx(ends["C"], abs=1e-6)
    points = np.concatenate([ink_of(mark) for mark in page.sheet.marks])
    assert (points > 10.0).all() and (points < [page.page.width - 10.0, page.page.height - 10.0]).all()


@pytest.mark.parametrize(("apart", "shift"), [(0.0, 0.0), (8.0, FARTHER), (18.0, FARTHER), (19.5, 0.0), (-6.0, 0.0)])
def test_so_do_those_of_planes_that_look_at_each_other(apart, shift):
    page = page_of([("front", apart), ("back", 0)], views=["front", "top", "back"], page="A3", scale=1.0)
    one, other = page.sheet.marks
    assert not page.notes
    between = np.hypot(*(ink_of(one)[:, None] - ink_of(other)[None]).T)
    # In one plane they have their line in common.
    assert between.min() > (0.9 if apart else -1.0)
    lines = [np.array(mark.line) for mark in (one, other)]
    assert (lines[0] - lines[1])[:, 1] == pytest.approx([apart, apart])
    assert np.abs(lines[0] - lines[1])[:, 0] == pytest.approx([shift, shift], abs=1e-6)


@pytest.mark.parametrize(("base", "near"), [("top", 0), ("bottom", 1)])
def test_only_ends_that_are_close_together_in_one_view_go_farther_out(base, near):
    stepped = (5.0, (-4.0, 20.0))
    page = page_of([("left", stepped), ("left", 2.0)], views=[base, "left"], scale=1)
    low, high = (side[1] for side in extent(page, base))
    ends = [np.array([mark.line[0][1], mark.line[-1][1]]) for mark in page.sheet.marks]
    out = np.array([low - BEYOND, high + BEYOND])
    assert ends[1] == pytest.approx(out, abs=1e-3)
    out[near] += FARTHER * (-1.0, 1.0)[near]
    assert ends[0] == pytest.approx(out, abs=1e-3)
    # The plane that steps is marked in the view from above, the other in that from the front.
    page = page_of([("left", stepped), ("left", 2.0)], views=["front", "top", "left"], scale=1)
    assert page.notes == ()
    for mark, view in zip(page.sheet.marks, ("top", "front"), strict=True):
        low, high = (side[1] for side in extent(page, view))
        assert sorted(y for _, y in (mark.line[0], mark.line[-1])) == pytest.approx(
            [low - BEYOND, high + BEYOND], abs=1e-3
        )


@pytest.mark.parametrize(
    ("places", "options"),
    [
        ((-10, -8), {"page": "A5"}),
        ((-13, -10, -8), {"page": "A4", "scale": 1}),
        ((-13, -10, -8, -6), {"page": "A3", "scale": 1}),
    ],
)
def test_marks_have_room_where_they_lie_clear_of_all_else(places, options):
    page = page_of([("left", place) for place in places], **options)
    assert page.notes == ()
    inks = [ink_of(mark) for mark in page.sheet.marks]
    for one, other in combinations(inks, 2):
        assert np.hypot(*(one[:, None] - other[None]).T).min() > 0.5
    points = np.concatenate(inks)
    assert (points > 10.0).all() and (points < [page.page.width - 10.0, page.page.height - 10.0]).all()
    for view in page.sheet.views:
        low, high = extent(page, view.name)
        if view.name != "front":
            assert not ((points > low - 1.0) & (points < high + 1.0)).all(axis=1).any(), view.name


@pytest.mark.parametrize(
    ("places", "options"),
    [
        ((-13, -10, -8, -6), {"page": "A5"}),
        (range(-24, -6, 3), {"page": "A0", "scale": 1}),
    ],
)
def test_a_page_without_room_for_close_marks_says_so(places, options):
    page = page_of([("left", place) for place in places], **options)
    (note,) = page.notes
    assert (note.code, note.is_warning) == ("section-marks-close", False)
    assert note.text.endswith("have no room side by side: give a larger page, or a larger scale.")


def test_one_section_is_drawn_as_ever_however_it_is_asked_for():
    for section in ({"left": 15}, {"front": (5.0, (10.0, -8.0))}):
        pairs = list(section.items())
        assert page_of(pairs).to_svg() == page_of(section).to_svg()
        one, other = (hlr.draw_views(bracket(), ["iso", *section], hlr.Options(section=x)) for x in (section, pairs))
        assert [each.to_svg() for each in one] == [each.to_svg() for each in other]


def test_files_of_a_page_name_them(tmp_path):
    import ezdxf

    page = page_of(TWO, style={"layers": "part"})
    svg = page.to_svg()
    assert re.findall(r'<view name="([\w-]+)" label="([\w-]+)".* section="([^"]+)"/>', svg) == [
        ("left", "left", "A-A"), ("left-B", "left-B", "B-B")
    ]  # fmt: skip
    assert re.findall(r">([^<>]+)</text>", svg) == ["A", "A", "A-A", "B", "B", "B-B"]
    assert svg.count('<g class="section"') == 2
    assert re.findall(r'inkscape:label="(left[^"]*)"', svg) == ["left/part", "left-B/part"]
    assert b"left-B/part" in page.to_pdf()
    document = ezdxf.readfile(page.save(tmp_path / "page.dxf"))
    assert {"left_part", "left-B_part"} <= {layer.dxf.name for layer in document.layers}
    texts = document.modelspace().query('TEXT[layer=="SECTION_MARKS"]')
    assert sorted(text.dxf.text for text in texts) == ["A", "A", "A-A", "B", "B", "B-B"]
    again = hlr.load(page.save(tmp_path / "page.json"))
    assert again.sheet == page.sheet and again.to_svg() == svg


def test_a_page_whose_planes_step_comes_back_from_its_json(tmp_path):
    page = page_of([("front", (5.0, (10.0, -8.0))), ("front", 12.0)])
    assert len(page.sheet.marks[0].line) == 4
    again = hlr.load(page.save(tmp_path / "page.json"))
    assert again.sheet == page.sheet and again.to_svg() == page.to_svg()


def test_by_themselves_they_are_drawings_with_names():
    options = hlr.Options(section=TWO, scale=1)
    drawings = hlr.draw_views(bracket(), ["left", "iso"], options)
    assert [(each.view.name, each.section is not None) for each in drawings] == [
        ("left", True), ("left-B", True), ("iso", False)
    ]  # fmt: skip
    assert [each.section.point[0] for each in drawings[:2]] == [-10.0, 15.0]
    assert "view left-B," in drawings[1].to_svg()
    assert [plan.view for plan in hlr.plan_views(bracket(), ["left", "iso"], options)] == ["left", "left-B", "iso"]
    for drawing in drawings:
        (again,) = hlr.draw_views(bracket(), [drawing.request.view], drawing.request.options)
        assert [line.points.tolist() for line in again.lines] == [line.points.tolist() for line in drawing.lines]


def test_notes_name_the_section_that_they_are_of():
    text = "the plane of section left-B only touches the model: nothing is taken away."
    options = hlr.Options(section=[("left", -10), ("left", -30)], scale=1)
    assert [[note.text for note in each.notes] for each in hlr.draw_views(bracket(), ["left"], options)] == [[], [text]]
    assert [note.text for note in page_of([("left", -10), ("left", -30)]).notes] == [text]


def test_a_page_says_of_which_view_a_note_is():
    far = [
        *(cq.Workplane().box(2, 2, 2).translate((3 * x, 0, 0)) for x in range(5)),
        cq.Workplane().box(2, 2, 2).translate((0, 0, 500)),
    ]
    (text,) = [note.text for note in hlr.draw_arranged(far, views=["front", "top"]).notes if note.code == "stray-parts"]
    assert text.startswith("view front: the part ")
    (text,) = [note.text for note in hlr.draw_arranged(far, views=["front"]).notes if note.code == "stray-parts"]
    assert text.startswith("the part ")


def test_one_drawing_is_cut_once():
    with pytest.raises(
        OptionError, match="one drawing is cut once: draw several sections with draw_views, or draw_arr"
    ):
        hlr.draw(bracket(), "left", section=TWO)


def test_all_are_refused_where_one_cannot_be():
    with pytest.raises(OptionError, match="section left at x = 99 misses the model"):
        page_of([("left", 0), ("left", 99)])
