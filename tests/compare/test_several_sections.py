"""Sections of one view are told apart by their lines, whatever they are called on a page or by themselves."""

import cadquery as cq
import pytest

import hlr
from hlr.compare import compare
from hlr.compare.reading.stated_view import views_in_text


@pytest.fixture(scope="module")
def model():
    made = cq.Workplane().box(60, 40, 12).faces(">Z").workplane().center(15, 8).circle(9).extrude(20)
    return made.faces(">Z").workplane().hole(6)


def page_of(model, *places):
    return hlr.draw_arranged(model, "first-angle", options=hlr.Options(section=[("left", x) for x in places], scale=1))


@pytest.fixture(scope="module")
def page(model):
    return page_of(model, -10, 15)


def same(found):
    """The names of the views that are on both sides, and that none of their lines differs."""
    both = [row for row in found.views if row.before and row.after]
    assert all(row.same_mm > 50.0 and not any(row.mm.values()) for row in both), both
    return [row.name for row in both]


@pytest.mark.parametrize("ending", ["svg", "json", "pdf", "dxf"])
@pytest.mark.parametrize(("place", "name"), [(-10, "left"), (15, "left-B")])
def test_a_section_by_itself_is_found_on_a_page(model, page, tmp_path, place, name, ending):
    hlr.draw(model, view="left", section=place, scale=1).save(tmp_path / f"one.{ending}")
    assert same(compare(page, tmp_path / f"one.{ending}")) == [name]
    assert same(compare(tmp_path / f"one.{ending}", page)) == [name]


def test_drawings_of_one_run_are_found_on_the_page_of_another(model, page):
    drawn = hlr.draw_views(model, ["left"], hlr.Options(section=[("left", 15), ("left", -10)], scale=1))
    assert [same(compare(page, drawing)) for drawing in drawn] == [["left-B"], ["left"]]


def test_a_section_by_itself_beside_its_model(model):
    drawn = hlr.draw_views(model, ["left"], hlr.Options(section=[("left", 15), ("left", -10)], scale=1))
    for drawing in drawn:
        assert compare(drawing, model).same


@pytest.mark.parametrize("ending", ["pdf", "dxf"])
@pytest.mark.parametrize(
    "options",
    [
        {"view": "left", "section": 15},
        {"view": "top", "section": (0, (10, 14)), "hidden": True},
        {"view": (1, -2, 0.5)},
        {"view": "front", "window": (5, 2, 40, 25)},
        {"view": "front", "perspective": hlr.Perspective(fov=50)},
    ],
)
def test_a_view_that_lines_do_not_tell_is_stated_in_all_formats(model, tmp_path, ending, options):
    file = hlr.draw(model, **options).save(tmp_path / f"one.{ending}")
    found = compare(file, model)
    assert found.same and found.view_found, found.summary


@pytest.mark.parametrize("ending", ["pdf", "dxf"])
def test_a_whole_view_with_a_name_is_as_before(model, ending):
    drawing = hlr.draw(model, view="front")
    written = drawing.to_pdf() if ending == "pdf" else drawing.to_dxf()
    assert b"direction=" not in (written if isinstance(written, bytes) else written.encode())


def test_a_section_that_does_not_say_its_plane_is_refused(model, tmp_path):
    old = hlr.draw(model, view="left", section=15, style={"dxf": "R12"}).save(tmp_path / "old.dxf")
    with pytest.raises(hlr.OptionError, match=r"old\.dxf is a section and does not say where its plane lies"):
        compare(old, model)
    # Whoever says the view compares with the whole model.
    new = hlr.draw(model, view="left", section=15).save(tmp_path / "new.dxf")
    assert not compare(new, model, view="left").same and not compare(old, model, view="left").same


def test_a_view_that_another_program_has_changed_is_found_by_its_lines(model, tmp_path):
    file = hlr.draw(model, view="front", window=(0, 0, 400, 400)).save(tmp_path / "one.dxf")
    file.write_bytes(file.read_bytes().replace(b"direction=0 -1 0", b"direction=0 x 0"))
    assert compare(file, model).same


def test_sections_of_two_pages_are_paired_by_their_lines(model, page):
    other = page_of(model, 15, -10)
    assert same(compare(page, other, register="translation")) == [
        "front", "top", "left / left-B", "left-B / left", "iso"
    ]  # fmt: skip
    assert same(compare(page, page)) == ["front", "top", "left", "left-B", "iso"]


def test_a_section_that_one_page_alone_has_is_new(model, page):
    found = compare(page_of(model, 15), page, register="translation")
    assert same(found) == ["front", "top", "left / left-B", "iso"]
    assert [row.name for row in found.views if not row.before] == ["left"]


def test_sections_that_look_alike_are_paired_by_their_names():
    bar = cq.Workplane().box(60, 40, 12)
    assert same(compare(page_of(bar, -10, 10), page_of(bar, -12, 8))) == ["front", "top", "left", "left-B", "iso"]


@pytest.mark.parametrize("ending", ["pdf", "dxf", "svg", "json"])
@pytest.mark.parametrize("cut", [True, False])
def test_a_page_is_compared_with_its_model_in_the_formats_that_its_refusal_names(model, page, tmp_path, cut, ending):
    file = (page if cut else hlr.draw_arranged(model)).save(tmp_path / f"page.{ending}")
    if ending in ("svg", "json"):
        assert compare(file, model).same
    else:
        text = r"is a page of \d views, and does not say how the model is seen in them, as the SVG and JSON .* do: "
        with pytest.raises(hlr.OptionError, match=text):
            compare(file, model)
        assert compare(file, file).same


@pytest.mark.parametrize(
    ("text", "views"),
    [("views=4", 4), ("", 0), ("views=", 0), ("views=-4", 0), ("views=²", 0), ("view=top; up=0 1 0", 0)],
)
def test_how_many_views_a_page_has_is_read_or_not_said(text, views):
    assert views_in_text(text) == views


def test_a_page_in_an_old_dxf_is_refused_where_it_has_sections(model, tmp_path):
    old = hlr.draw_arranged(
        model, "first-angle", options=hlr.Options(section=[("left", 15)], scale=1, style={"dxf": "R12"})
    ).save(tmp_path / "old.dxf")
    with pytest.raises(hlr.OptionError, match=r"of several views, .* do not: draw it anew as SVG or JSON"):
        compare(old, model)
