"""JSON documents have the keys that hlr/docs/json.md lists and no others, and the page lists none that never comes."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

import hlr
from hlr.drawing.page import Page
from hlr.drawing.reached import Errors, Labels, Reached
from hlr.drawing.section_marks import SectionMark
from hlr.drawing.sheet import Sheet, SheetView
from hlr.request.style import LineRule, Style
from hlr.tables.documents import VERSIONS
from support.described_json import described
from support.drawings import drawing, line, part, sample

PAGE = (Path(hlr.__file__).parent / "docs" / "json.md").read_text("utf-8")
SECTIONS = dict(re.findall(r"^\| \[`([\w-]+)`\]\(#([\w-]+)\)", PAGE, re.MULTILINE))
"""The section of each format."""

DATA = Path(__file__).parents[1] / "data"
BOX = DATA / "freecad" / "box.step"
TORUS = DATA / "freecad" / "torus_sphere.brep"
ROUNDED = DATA / "brep" / "rounded.brep"
HOUSING = DATA / "housing_body.FCStd"

SIDES = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n{0} 0 0\n0 {0} 0\n0 0 {0}\n" + SIDES
CROSSING = (
    "OFF\n8 8 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n1 1 -1\n8 2 -1\n2 8 -1\n2 2 5\n"
    f"{SIDES}3 4 6 5\n3 4 5 7\n3 5 6 7\n3 4 7 6\n"
)
FOREIGN = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60">'
    '<g fill="none" stroke="black"><path d="M5,5 H50 V40 H5 Z"/><path d="M10,10 L30,{}"/></g></svg>'
)

SCRIPT = """
import os
open("lost.py", "w").write("size = 3")
import lost
os.remove("lost.py")
import cadquery as cq
show_object(cq.Workplane().box(1, 2, lost.size), "bar", {"color": "red"})
"""
"""Of what it depends on, one file is gone when the report is written."""


def test_the_page_names_every_format_with_its_version():
    rows = re.findall(r"^\| \[`([\w-]+)`\]\(#[\w-]+\) \| (\d+) \|", PAGE, re.MULTILINE)
    assert {name: int(version) for name, version in rows} == VERSIONS
    said = re.findall(r'`format` \| text \| always \| `"([\w-]+)"` \|\n\| `version` .* always \| (\d+) \|', PAGE)
    assert said == rows


def read(name):
    return json.loads(Path(name).read_text("utf-8"))


def by_hand():
    """Drawings with what few models have."""
    nothing, some = Errors(None, why="there is none"), Errors(0.01, 0.01, 3, where="at 1,2")
    blind, wrong = Labels(None, why="the drawing has no lines"), Labels(0.1, 2.0, 20.0, where="at 3,4")
    rule = LineRule(parts="bolt*", kind="sharp", visible=True, width=0.3, color="red", dash=(4, 2), cap="round")
    for style, size in ((Style(background=None, wide=0.6, narrow=0.2), {"dpi": 300}), (Style(), {"size": (9, 9)})):
        asked = replace(style, lines=(*style.lines, rule, replace(rule, width="wide")), part_colors="lines", **size)
        for labels, bound in ((blind, None), (wrong, 0.4)):
            reached = Reached(0.05, some, some, some, nothing, some, some, bound, some, some, labels)
            yield json.loads(replace(sample(), style=asked, reached=reached).to_json())
    eye = SheetView("box", "Box", 1.0, (9.0, 9.0), 0.0, (0.0, -1.0, 0.0), (1.0, 0.0, 0.0))
    sheet = Sheet((eye,), marks=(SectionMark("A", (5.0, 5.0)),))
    yield json.loads(
        replace(
            drawing([line([[0, 0], [9, 9]])], parts=[part("box/a")]),
            sheet=sheet,
            page=Page("A4", 297.0, 210.0, 0.0, 0.0),
            group=(0.35, 0.18),
        ).to_json()
    )


def of_draw(hlr_real):
    """Summaries, and the drawings."""
    Path("crossing.off").write_text(CROSSING)
    Path("script.py").write_text(SCRIPT)
    for arguments in (
        ("crossing.off", "--hidden", "--scale", "2"),
        ("script.py", "--perspective", "--page", "A3", "--within", "1s"),
        (ROUNDED, "--fill", "--style", "dark", "--window", "1,1,40,40", "--report"),
        (DATA / "freecad" / "spring.step", "--accuracy", "0.1"),
        (DATA / "soup.stl", "--fit", "30x30"),
        (BOX, "--section", "front"),
        (BOX, "--section", "front@3,6:5"),
        (BOX, "--arrange", "first-angle", "--section", "front", "--hidden"),
        (BOX, "--arrange", "first-angle", "--section", "front@3,6:5"),
        (DATA / "as1-oc-214.stp", "--only", "rod-assembly"),
        (HOUSING, "--page", "Page"),
    ):
        yield json.loads(hlr_real("draw", *arguments, "-o", "a.json", "--json").out)
        yield read("a.json")
    yield json.loads(hlr_real("draw", HOUSING, "--page", "Page", "-o", "page.svg", "--json").out)


def of_other_verbs(hlr_real, monkeypatch):
    """Plans, models, the cache, errors."""
    for arguments in (
        ("plan", BOX, "--view", "iso", "--view", "1,2,3"),
        ("info", BOX),
        ("info", "script.py"),
        ("cache", "info"),
        ("info", "missing.step"),
        ("draw", "--scale", "none"),
    ):
        yield json.loads(hlr_real(*arguments, "--json").out)
    with monkeypatch.context() as patched:
        patched.setenv("HLR_CACHE", "off")
        yield json.loads(hlr_real("cache", "info", "--json").out)


def of_compare(hlr_real):
    """Comparisons of drawings, models, pages, and what other programs have drawn."""
    for name, *asked in (
        ("shown.svg", "--scale", "1:3", "--hidden", "--no-smooth"),
        ("other.svg", "--scale", "1:5", "--no-hidden", "--smooth"),
    ):
        assert hlr_real("draw", BOX, "--view", "front", *asked, "-o", name).code == 0
    page = Path("page.svg").read_text("utf-8")
    begin = page.index("<path", page.index("data-part"))
    Path("less.svg").write_text(page[:begin] + page[page.index("/>", begin) + 2 :], "utf-8")
    for y in (20, 30):
        Path(f"foreign{y}.svg").write_text(FOREIGN.format(y))
    for asked in (
        ("shown.svg", "other.svg"),
        ("less.svg", "page.svg", "--register", "translation"),
        ("less.svg", "page.svg"),
        ("foreign20.svg", "foreign30.svg"),
        (DATA / "freecad" / "box_iso.svg", BOX),
        (DATA / "freecad" / "torus_sphere_front.svg", ROUNDED, "--view", "front"),
    ):
        assert hlr_real("compare", *asked, "-o", "compared.json").code < 2
        yield read("compared.json")


def of_batch(hlr_real, monkeypatch):
    """Reports of all that may become of a source, and beside a baseline."""
    Path("batch").mkdir()
    Path("script.py").rename("batch/script.py")
    monkeypatch.chdir("batch")
    for name in ("same", "changed", "gone"):
        Path(f"{name}.off").write_text(TETRAHEDRON.format(10))
    Path("open.off").write_text(TETRAHEDRON.format(10).replace("4 4 0", "4 3 0").replace("3 0 3 2\n", ""))
    Path("broken.step").write_text("nothing")
    Path("fails.py").write_text("import cadquery\nprint('on the way')\nresult = 1 / 0\n")
    asked = ("batch", "--jobs", "1", "--format", "svg", "--view", "front")
    assert hlr_real(*asked).code == 1
    yield read("drawings/manifest.json")
    Path("drawings").rename("../earlier")
    Path("gone.off").unlink()
    Path("new.off").write_text(TETRAHEDRON.format(7))
    Path("changed.off").write_text(TETRAHEDRON.format(10).replace("0 0 10", "0 0 6"))
    assert hlr_real(*asked, "--baseline", "../earlier").code == 1
    yield read("drawings/manifest.json")
    Path("new.off").unlink()
    assert hlr_real(*asked).code == 1
    yield read("drawings/manifest.json")
    assert hlr_real(*asked, "same.off", "-o", "drawings").code == 0
    yield read("drawings/manifest.json")
    assert hlr_real(*asked, "same.off", "-o", "drawings", "--no-times").code == 0
    yield read("drawings/manifest.json")


UNSEEN = [("batches", "folder", "null"), ("batches", "sources[].sha256", "null")]
"""What no command shows at will: two drives, and a source that vanishes as soon as the batch has found it."""


@pytest.mark.slow
def test_documents_have_the_keys_that_the_page_lists_and_no_others(hlr_real, monkeypatch):
    pytest.importorskip("cadquery")
    page, formats, wrong = described(PAGE), set(), set()
    for document in (
        *by_hand(),
        *of_draw(hlr_real),
        *of_other_verbs(hlr_real, monkeypatch),
        *of_compare(hlr_real),
        *of_batch(hlr_real, monkeypatch),
    ):
        assert list(document)[:2] == ["format", "version"]
        name = document["format"]
        assert document["version"] == VERSIONS[name]
        formats.add(name)
        wrong.update(page.problems(document, SECTIONS[name]))
    assert sorted(wrong) == []
    assert formats == set(VERSIONS)
    assert sorted(page.promised() - page.met) == UNSEEN
