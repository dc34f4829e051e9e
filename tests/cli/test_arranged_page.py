"""`--arrange`: several views on one page."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

DATA = Path(__file__).parents[1] / "data"
STEP = str(DATA / "as1-oc-214.stp")
HOUSING = str(DATA / "housing_body.FCStd")


@pytest.mark.slow
def test_a_page_of_four_views(hlr_real, tmp_path):
    done = hlr_real("draw", STEP, "--arrange", "third-angle", "-o", "a.svg", "-o", "{stem}-{view}.pdf", "-q")
    assert (done.code, done.err) == (0, "")
    svg = (tmp_path / "a.svg").read_text("utf-8")
    assert all(f'<view name="{name}"' in svg for name in ("front", "top", "right", "iso"))
    assert (tmp_path / "as1-oc-214-third-angle.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.slow
def test_views_that_are_asked_for(hlr_real, tmp_path):
    done = hlr_real("draw", STEP, "--arrange", "first-angle", "--view", "left", "--view", "1,2,3", "-o", "a.svg", "-q")
    assert done.code == 0
    svg = (tmp_path / "a.svg").read_text("utf-8")
    assert svg.count("<view ") == 2


TEMPLATE = """<svg xmlns="http://www.w3.org/2000/svg" xmlns:freecad="urn:freecad" width="420mm" height="297mm">
<!-- Working space 10 10 410 287 -->
<text freecad:editable="TITLE"><tspan>title</tspan></text></svg>
"""


@pytest.mark.slow
def test_a_template_with_a_title(hlr_real, tmp_path):
    (tmp_path / "sheet.svg").write_text(TEMPLATE)
    page = (
        "--arrange",
        "third-angle",
        "--template",
        "sheet.svg",
        "--text",
        "TITLE=Two = three",
        "--room",
        "20,20,400,200",
    )
    done = hlr_real("draw", STEP, *page, "-o", "a.svg", "-q")
    assert (done.code, done.err) == (0, "")
    svg = (tmp_path / "a.svg").read_text("utf-8")
    assert 'width="420mm"' in svg
    assert ">Two = three<" in svg
    done = hlr_real("draw", STEP, *page, "-o", "a.json", "-q")
    assert (done.code, done.err) == (0, "")
    found = json.loads((tmp_path / "a.json").read_text("utf-8"))
    assert (found["format"], found["texts"]) == ("hlr-page", {"TITLE": "Two = three"})
    done = hlr_real("draw", STEP, *page, "-o", "a.dxf")
    assert done.code == 0 and "warning" not in done.err
    assert "Two = three" in (tmp_path / "a.dxf").read_text("utf-8")
    done = hlr_real("draw", STEP, *page[:5], "TITLE=≥ 5 图", "-o", "a.pdf")
    assert 'warning: Page "third-angle": "图" not drawn in a.pdf, but ? instead: SVG has all letters.' in done.err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((STEP, "--arrange", "fourth-angle"), "'fourth-angle' is not one of 'first-angle', 'third-angle'"),
        ((STEP, "--arrange", "first-angle", "--explain"), "leave out --explain, or --arrange"),
        ((STEP, "--arrange", "first-angle", "--window", "0,0,9,9"), "leave out --window, or --arrange"),
        ((HOUSING, "--arrange", "first-angle", "--all-pages"), "leave out --arrange"),
        ((HOUSING, "--arrange", "first-angle", "--page", "Page"), "leave out --arrange"),
        ((STEP, "--arrange", "first-angle", "--template", "none.svg"), "none.svg does not exist"),
        (
            (STEP, "--arrange", "first-angle", "--text", "TITLE"),
            "'TITLE' is not a field and a text such as TITLE=Bracket",
        ),
        ((STEP, "--arrange", "first-angle", "--text", "A=1", "--text", "A=2"), "--text gives A twice"),
        ((STEP, "--template", "a.svg"), "--template is for --arrange"),
        ((STEP, "--room", "0,0,9,9"), "--room is for --arrange"),
    ],
)
def test_what_cannot_be_is_refused(hlr_real, tmp_path, arguments, words):
    done = hlr_real("draw", *arguments)
    assert done.code == 2
    assert words in done.err
    assert not list(tmp_path.iterdir())
