"""A page of arranged views beside a model: the model is drawn in all of its views, sections too."""

from __future__ import annotations

import re

import cadquery as cq
import pytest

import hlr
from hlr.compare import compare
from support.models import box, parts


def plate(hole=8.0):
    body = cq.Workplane().box(60, 40, 12).faces(">Z").workplane().pushPoints([(-15, 5), (18, -8)]).hole(hole)
    return body.edges("|Z").fillet(4)


PAGES = {
    "whole": {"hidden": True},
    "third angle": {"method": "third-angle", "views": ["front", "top", "right", "iso-sw"]},
    "sections": {"section": [("left", -15), ("left", 18), ("front", True)]},
    "a section that steps": {"views": ["top", "front"], "section": {"front": (5, (0, -8))}, "whole": ["front"]},
    "a direction": {"views": ["front", (1, -2, 0.7)]},
}


@pytest.mark.parametrize("kept", ["memory", "svg", "json"])
@pytest.mark.parametrize("page", PAGES)
def test_a_page_and_its_model_are_the_same(page, kept, tmp_path):
    drawn = hlr.draw_arranged(plate(), **PAGES[page])
    given = drawn if kept == "memory" else drawn.save(tmp_path / f"page.{kept}")
    found = compare(given, plate())
    assert found.same, found.differences[:3]
    assert [row.name for row in found.views] == [view.name for view in drawn.sheet.views]
    # They lie at their places: nothing had to be moved.
    assert all(row.shift is None and row.same_mm > 50.0 for row in found.views)


@pytest.mark.parametrize("page_first", [True, False])
def test_what_has_changed_is_found_in_each_view_and_judged(page_first):
    page, new = hlr.draw_arranged(plate(), hidden=True, scale=1), plate(hole=9.0)
    found = compare(page, new) if page_first else compare(new, page)
    assert {each.view for each in found.differences} == {"front", "top", "left", "iso"}
    right = "second right" if page_first else "first right"
    judged = [each.verdict for each in found.differences if each.view == "top" and each.length_mm > 5.0]
    assert judged and set(judged) == {right}
    # Parts are called alike on both sides.
    assert {each.part for each in found.differences if each.view == "top"} == {"top/part"}


def test_a_mesh_with_another_axis_up(tmp_path):
    path = tmp_path / "post.glb"
    parts(box((30, 20, 10)), box((10, 10, 20), (6, 0, 15))).export(path)
    assert compare(hlr.draw_arranged(path, scale=1, section={"left": True}), path).same


def test_the_views_of_a_page_are_not_said_twice():
    with pytest.raises(hlr.OptionError, match="is a page of 4 views and says itself how they are seen: leave out"):
        compare(hlr.draw_arranged(plate()), plate(), view="top")


@pytest.mark.parametrize("lost", ["origin", "plane"])
def test_a_page_that_does_not_say_all_is_refused(lost, tmp_path):
    path = hlr.draw_arranged(plate(), section={"left": True}).save(tmp_path / "page.svg")
    path.write_text(re.sub(f' {lost}="[^"]*"', "", path.read_text("utf-8")), "utf-8")
    with pytest.raises(hlr.OptionError, match=r"page.svg is a page of 4 views, and does not say how the model is seen"):
        compare(path, plate())


@pytest.mark.parametrize("wrong", ['origin="a b"', 'origin="1"', 'plane="1 2"', 'direction="0 0 0"', 'scale="0"'])
def test_a_damaged_page_is_refused(wrong, tmp_path):
    path = hlr.draw_arranged(plate(), section={"front": True}).save(tmp_path / "page.svg")
    name = wrong.partition("=")[0]
    path.write_text(re.sub(f'(<view name="front".*?) {name}="[^"]*"', rf"\1 {wrong}", path.read_text("utf-8")), "utf-8")
    with pytest.raises(hlr.HlrError, match=r"page.svg"):
        compare(path, plate())


def test_a_page_with_a_template_and_a_scale_of_its_own(tmp_path):
    """Its views lie elsewhere than on a page without: they are moved to their places."""
    frame = tmp_path / "frame.svg"
    frame.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210"/>')
    page = hlr.draw_arranged(plate(), scale=0.5, section={"left": 3.0}, template=frame, room=(100, 20, 280, 190))
    assert compare(page.save(tmp_path / "page.svg"), plate()).same
