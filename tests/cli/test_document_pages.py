"""`--page NAME` and `--all-pages` of a FreeCAD document."""

from __future__ import annotations

from pathlib import Path

import pytest

DATA = Path(__file__).parents[1] / "data"
HOUSING = str(DATA / "housing_body.FCStd")
STEP = str(DATA / "as1-oc-214.stp")


@pytest.mark.slow
def test_a_page_by_its_name(hlr_real, tmp_path):
    result = hlr_real("draw", HOUSING, "--page", "Page", "-o", "page.svg", "-o", "page.dxf")
    assert result.code == 0
    assert result.err.splitlines() == [
        'hlr: warning: Page "Page": 3 dimensions not drawn.',
    ]
    assert 'id="template"' in (tmp_path / "page.svg").read_text("utf-8")
    assert b"LINE" in (tmp_path / "page.dxf").read_bytes()


def test_pages_of_the_same_label_have_files_by_their_names():
    from hlr.cli.document_pages import _distinct

    pages = [("Page", "Sheet"), ("Page001", "SHEET"), ("Page002", "Cover")]
    assert _distinct(pages) == ["Page", "Page001", "Cover"]


@pytest.mark.slow
def test_all_pages(hlr_real, tmp_path):
    assert hlr_real("draw", HOUSING, "--all-pages", "-o", "{stem}-{view}.dxf").code == 0
    assert [path.name for path in tmp_path.iterdir()] == ["housing_body-Page.dxf"]


@pytest.mark.slow
def test_a_sheet_of_paper_is_still_one(hlr_real, tmp_path):
    assert hlr_real("draw", HOUSING, "--page", "A3", "-o", "a.svg").code == 0
    assert 'width="420mm"' in (tmp_path / "a.svg").read_text("utf-8")
    assert 'id="template"' not in (tmp_path / "a.svg").read_text("utf-8")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((HOUSING, "--page", "Blatt"), 'housing_body.FCStd has no page "Blatt": its pages are "Page"'),
        ((HOUSING, "--page", "Page", "--view", "top"), "leave out --view"),
        (
            (HOUSING, "--page", "Page", "--scale", "2"),
            "a page of a document is drawn as it is: leave out --scale",
        ),
        ((HOUSING, "--all-pages", "--page", "A4"), "leave out --page"),
        (
            (STEP, "--all-pages"),
            "only FreeCAD documents (.FCStd) have pages, and as1-oc-214.stp is none: leave --all-pages out",
        ),
        ((STEP, "--page", "Blatt"), "no page is called 'Blatt'"),
    ],
)
def test_what_is_refused(hlr_real, tmp_path, arguments, message):
    result = hlr_real("draw", *arguments)
    assert (result.code, result.out) == (2, "")
    assert message in result.err and len(result.err.splitlines()) <= 3
    assert list(tmp_path.iterdir()) == []


def test_a_name_that_cannot_be_is_refused_before_the_document_is_read(hlr_real):
    result = hlr_real("draw", "none.FCStd", "--all-pages", "-o", "{page}.svg")
    assert result.code == 2 and "the unknown field {page}" in result.err
