"""A drawing of one view beside a page: it is the view of its name, wherever that lies and whatever looks alike."""

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
    rows = {row.name: row for row in found.views}
    assert list(rows) == ["front", "top", "left", "iso"]
    assert [name for name, row in rows.items() if row.after] == [view]
    assert rows[view].same_mm > 50.0 and not any(rows[view].mm.values()), rows[view]
    assert {each.kind for each in found.differences} == {"gone"}


def test_the_page_may_be_the_second(model, page):
    found = compare(hlr.draw(model, view="top", scale=1), page)
    assert [row.name for row in found.views if row.before] == ["top"]
    assert {each.kind for each in found.differences} == {"new"}


def test_it_is_compared_as_it_lies_where_that_is_asked_for(model, page):
    found = compare(page, hlr.draw(model, view="top", scale=1), register="off")
    (row,) = (row for row in found.views if row.name == "top")
    assert row.shift is None and row.mm["gone"] > 50.0


def test_a_view_that_the_page_has_not_is_found_by_its_lines(model, page):
    found = compare(page, hlr.draw(model, view="right", scale=1), register="translation")
    assert sum(row.same_mm for row in found.views) > 50.0
