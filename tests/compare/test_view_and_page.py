"""A drawing of one view beside a page: it is the view of its name, wherever that lies and whatever looks alike, and the
page's other views are left out."""

import pytest

import hlr
from hlr.compare import compare
from support.models import box, parts


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """Its front and its left view look the same."""
    path = tmp_path_factory.mktemp("model") / "post.stl"
    parts(box((30, 30, 10)), box((10, 10, 20), (0, 0, 15))).export(path)
    return path


@pytest.fixture(scope="module")
def page(model):
    return hlr.draw_arranged(model, "first-angle", options=hlr.Options(scale=1))


@pytest.mark.parametrize("ending", ["svg", "json"])
@pytest.mark.parametrize("scale", [1, 2])
@pytest.mark.parametrize("view", ["front", "top", "left", "iso"])
def test_a_view_by_itself_is_compared_with_the_view_of_its_name(view, scale, ending, model, page, tmp_path):
    hlr.draw(model, view=view, scale=scale).save(tmp_path / f"one.{ending}")
    found = compare(page, tmp_path / f"one.{ending}")
    (row,) = found.views
    assert (row.name, row.before, row.after) == (view, True, True)
    assert row.same_mm > 50.0 and not any(row.mm.values()), row
    # Twice as large is a difference, of which no line is one.
    assert not found.differences and found.same == (scale == 1)
    assert found.left_out == ({"other views": 3}, {})


@pytest.mark.parametrize("page_first", [True, False])
def test_either_side_may_be_the_page(page_first, model, page):
    top = hlr.draw(model, view="top", scale=1)
    found = compare(page, top) if page_first else compare(top, page)
    assert [row.name for row in found.views] == ["top"] and found.same
    assert found.left_out[page_first] == {} and found.left_out[not page_first] == {"other views": 3}


def test_what_differs_in_that_view_is_found(model, page):
    changed = hlr.draw(parts(box((30, 30, 10)), box((10, 10, 22), (0, 0, 16))), view="front", scale=1)
    found = compare(page, changed)
    assert not found.same and {each.view for each in found.differences} == {"front"}


def test_a_page_of_one_view_is_a_page_all_the_same(model, page):
    """Two pages are compared with all their views."""
    alone = hlr.draw_arranged(model, views=["front"], scale=1)
    assert [row.name for row in compare(page, alone).views if not row.after] == ["top", "left", "iso"]


def test_it_is_compared_as_it_lies_where_that_is_asked_for(model, page):
    found = compare(page, hlr.draw(model, view="top", scale=1), register="off")
    (row,) = (row for row in found.views if row.name == "top")
    assert row.shift is None and row.mm["gone"] > 50.0


def test_a_view_that_the_page_has_not_is_found_by_its_lines(model, page):
    found = compare(page, hlr.draw(model, view="right", scale=1), register="translation")
    assert sum(row.same_mm for row in found.views) > 50.0
