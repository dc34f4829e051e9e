"""Where several views lie on one page: cells of the two methods, scales, gaps, and pages without room."""

from __future__ import annotations

from itertools import combinations

import pytest

from hlr.errors import OptionError
from hlr.image.arrangement import LEAST_GAP, Room, arranged, check_views, inside_margins
from hlr.image.method_cells import own_cells
from hlr.tables.projection_methods import PROJECTION_METHODS
from hlr.tables.sheets import MARGIN, papers

BLOCK = {"front": (60, 30), "back": (60, 30), "top": (60, 20), "bottom": (60, 20), "left": (20, 30), "right": (20, 30),
         "iso": (50, 50), "iso-sw": (50, 50), "iso-ne": (50, 50)}  # fmt: skip
"""Width and height of the views of a block of 60 x 20 x 30 mm, nearly."""


def rooms_of(sheet):
    return [inside_margins(paper) for paper in papers(sheet)]


def page(names, method="third-angle", sheet="A4", scale=None):
    sizes, row = [BLOCK[name] for name in names], PROJECTION_METHODS[method]
    found = arranged(own_cells(names, row), sizes, row, rooms_of(sheet), scale)
    return found, dict(zip(names, found.places(sizes), strict=True))


def box(name, place, scale):
    (x, y), (width, height) = place, BLOCK[name]
    return x - scale * width / 2, y - scale * height / 2, x + scale * width / 2, y + scale * height / 2


@pytest.mark.parametrize(
    ("method", "above", "right"), [("first-angle", "bottom", "left"), ("third-angle", "top", "right")]
)
def test_the_sides_on_which_views_lie(method, above, right):
    names = ["front", "top", "bottom", "left", "right", "back"]
    _, at = page(names, method)
    x, y = at["front"]
    assert at[above][0] == x
    assert at[above][1] > y
    assert at[right][1] == y
    assert at[right][0] > x
    below, left = ({"top", "bottom"} - {above}).pop(), ({"left", "right"} - {right}).pop()
    assert at[below][1] < y
    assert at[left][0] < x
    assert at["back"][0] > max(at["left"][0], at["right"][0])


@pytest.mark.parametrize("method", list(PROJECTION_METHODS))
@pytest.mark.parametrize("sheet", ["A4", "A3-portrait", "150x120"])
@pytest.mark.parametrize("count", [1, 3, 4, 6, 9])
def test_views_lie_apart_inside_the_margins(method, sheet, count):
    names = list(BLOCK)[:count]
    found, at = page(names, method, sheet)
    boxes = [box(name, at[name], found.scale) for name in names]
    for x0, y0, x1, y1 in boxes:
        assert min(x0, y0) >= MARGIN - 0.1
        assert x1 <= found.room.paper.width - MARGIN + 0.1
        assert y1 <= found.room.paper.height - MARGIN + 0.1
    for one, other in combinations(boxes, 2):
        apart = [max(one[k] - other[k + 2], other[k] - one[k + 2]) for k in (0, 1)]
        assert max(apart) >= LEAST_GAP - 1e-9


def test_the_scale_is_the_largest_standard_one():
    names = ["front", "top", "right", "iso"]
    found, _ = page(names)
    assert found.scale == 2.0
    assert found.needs([BLOCK[name] for name in names]) <= (277, 190)
    larger, _ = page(names, scale=5.0)
    assert larger.needs([BLOCK[name] for name in names])[0] > 277


def test_a_pictorial_view_takes_the_free_cell_that_leaves_the_largest_scale():
    assert page(["front", "top", "right", "iso"])[0].cells[3] == (1, 1)
    assert page(["front", "top", "left", "iso"], "first-angle")[0].cells[3] == (1, -1)
    # On a wide page there is more room beside the front view than above it.
    assert page(["front", "iso"], sheet="150x70")[0].cells == ((0, 0), (1, 0))


def test_a_sheet_lies_the_way_that_allows_the_larger_scale():
    assert page(["front", "top"])[0].room.paper.name == "A4"
    assert page(["front", "back"])[0].room.paper.width == 297.0
    tall = arranged([(0, 0)], [(10, 100)], PROJECTION_METHODS["first-angle"], rooms_of("A4"), None)
    assert (tall.scale, tall.room.paper.height) == (2.0, 297.0)


def test_views_lie_inside_the_room_that_allows_the_larger_scale():
    (paper, _) = papers("A4")
    above, beside = Room(paper, 20, 60, 260, 140), Room(paper, 20, 10, 80, 190)
    sizes = [BLOCK["front"], BLOCK["top"]]
    for order in ((above, beside), (beside, above)):
        wide = arranged([(0, 0), (0, 1)], sizes, PROJECTION_METHODS["third-angle"], order, None)
        assert wide.room == above
        for (x, y), (width, height) in zip(wide.places(sizes), sizes, strict=True):
            assert 20 <= x - wide.scale * width / 2 < x + wide.scale * width / 2 <= 280
            assert 60 <= y - wide.scale * height / 2 < y + wide.scale * height / 2 <= 200
    tall = arranged([(-1, 0)], [(10, 90)], PROJECTION_METHODS["third-angle"], [above, beside], None)
    assert tall.room == beside


def test_two_pictorial_views_lie_where_that_leaves_the_largest_scale():
    # 100 x 15 x 30 in five views: at 1:1 only with both pictorial ones in a third column.
    names, sizes = ["front", "top", "right", "iso", "iso-sw"], [(100, 30), (100, 15), (15, 30), (82, 64), (82, 64)]
    row = PROJECTION_METHODS["third-angle"]
    found = arranged(own_cells(names, row), sizes, row, rooms_of("A4"), None)
    assert found.scale == 1.0
    assert len(set(found.cells)) == 5


def test_a_long_part_has_its_pictorial_view_above_or_below():
    row = PROJECTION_METHODS["first-angle"]
    for sizes, along in (([(1000, 5), (711, 411)], 0), ([(5, 1000), (411, 711)], 1)):
        found = arranged([(0, 0), None], sizes, row, rooms_of("A4"), None)
        assert found.scale == 0.2
        assert found.cells[1][along] == 0


@pytest.mark.parametrize(
    ("direction", "cell"),
    [
        ((0, -1, 0), (0, 0)),
        ((0, 0, 2), (0, 1)),
        ((1, 0, 0), (1, 0)),
        ((0, 5, 0), (2, 0)),
        ((1, -1, 0), None),
        ((0, 1e-3, 1), None),
    ],
)
def test_a_direction_along_an_axis_has_the_place_of_that_view(direction, cell):
    assert own_cells([direction], PROJECTION_METHODS["third-angle"]) == [cell]


def test_a_page_without_room_is_refused():
    with pytest.raises(OptionError, match="a page of 30 x 30 mm has no room for 4 views with 10 mm between"):
        page(["front", "top", "right", "iso"], sheet="30x30")
    row, cells, sizes = PROJECTION_METHODS["third-angle"], [(0, 0), (0, 1), (1, 0)], [(9.0, 9.0)] * 3
    (paper,) = papers("A4-landscape")
    rooms = [Room(paper, 0.0, 0.0, 5.0, 1.0), Room(paper, 0.0, 0.0, 12.5, 9.0)]
    message = "the room of 12.5 x 9 mm on a page of 297 x 210 mm is too small for 3 views with 10 mm between them: give"
    with pytest.raises(OptionError, match=message):
        arranged(cells, sizes, row, rooms, None)


@pytest.mark.parametrize(
    ("views", "words"),
    [
        (["front", "top", "front"], "the view front is given twice"),
        (["iso", "iso"], "the view iso is given twice"),
        (["front", (0, -1, 0)], "the view front is given twice"),
        (["front", *((1, n, 1) for n in range(1, 15))], "15 views are too many for one page"),
    ],
)
def test_what_cannot_be_arranged_is_refused(views, words):
    row = PROJECTION_METHODS["first-angle"]
    names = [view if isinstance(view, str) else ",".join(map(str, view)) for view in views]
    with pytest.raises(OptionError, match=words):
        check_views(names, own_cells(views, row), row)
