"""`arrange` in a manifest: all views of a source on one page."""

from __future__ import annotations

import re

import pytest
from batch.models import Silent

from hlr.batch.carry_out import carry_out
from hlr.batch.kept import Kept
from hlr.batch.keys import Digests, key_of
from hlr.batch.manifest import manifest_of, read
from hlr.batch.plan import plan
from hlr.batch.request import wrong_one
from hlr.batch.run import run
from hlr.errors import OptionError

MESH = "OFF\n4 4 0\n0 0 0\n30 0 0\n0 20 0\n0 0 10\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


def jobs(folder, **keys):
    (folder / "part.off").write_text(MESH)
    found = manifest_of({"files": "part.off", **keys}, folder)
    return found, plan(found, folder / "out").jobs


@pytest.mark.parametrize(
    ("keys", "views"),
    [
        ({"arrange": "third-angle"}, ("front", "top", "right", "iso")),
        ({"arrange": "first-angle"}, ("front", "top", "left", "iso")),
        ({"arrange": "first-angle", "views": ["front", [1, 2, 3]]}, ("front", (1, 2, 3))),
    ],
)
def test_one_file_holds_all_views(tmp_path, keys, views):
    _, (job,) = jobs(tmp_path, formats=["svg", "pdf"], **keys)
    name = f"./part-{keys['arrange']}"
    assert job.views == views
    assert [[file.removeprefix("./") for file in row] for row in job.files] == [[f"{name[2:]}.svg", f"{name[2:]}.pdf"]]
    outcome = carry_out(job)
    assert outcome.failure is None
    ((svg, pdf),) = outcome.contents
    assert svg.count(b"<view ") == len(views)
    assert pdf.startswith(b"%PDF")
    assert [drawing["view"] for drawing in outcome.drawings] == [keys["arrange"]]


def test_sections_are_said_by_their_views(tmp_path):
    section = {"front": True, "left": [5, 0, 0]}
    _, (page,) = jobs(tmp_path, arrange="first-angle", section=section)
    outcome = carry_out(page)
    assert outcome.failure is None
    ((svg,),) = outcome.contents
    assert svg.count(b"A-A</text>") == svg.count(b"B-B</text>") == 1
    assert outcome.drawings[0]["parts"] == 1
    _, alone = jobs(tmp_path, views=["front", "top"], section={"front": True})
    assert [b'<g class="hatch"' in row[0] for row in carry_out(alone[0]).contents] == [True, False]
    assert len({key_of(job, Digests()) for job in (page, alone[0], jobs(tmp_path, views=["front", "top"])[1][0])}) == 3


def test_several_sections_of_a_view_are_pairs(tmp_path):
    section = [["left", 5], ["front", [0, 3, 0]], ["left", [8, 2, 1]]]
    _, (page,) = jobs(tmp_path, arrange="first-angle", section=section)
    ((svg,),) = carry_out(page).contents
    assert [svg.count(f"{letter}-{letter}</text>".encode()) for letter in "ABCD"] == [1, 1, 1, 0]
    _, (alone,) = jobs(tmp_path, views=["iso", "left", "front"], section=section, formats=["json"])
    assert [row[0].removeprefix("./") for row in alone.files] == [
        f"part-{name}.json" for name in ("iso", "left", "left-C", "front")
    ]
    outcome = carry_out(alone)
    assert [drawing["view"] for drawing in outcome.drawings] == ["iso", "left", "left-C", "front"]
    assert len(outcome.contents) == len(alone.files)


@pytest.mark.parametrize("arrange", ["", "first-angle"])
@pytest.mark.parametrize("section", [[["left", 5]], {"left": 5}])
def test_a_view_is_drawn_whole_besides_its_section(tmp_path, section, arrange):
    asked = {"section": section, "views": ["front", "left"], "arrange": arrange, "formats": ["json"]}
    _, (job,) = jobs(tmp_path, whole=["left"], **asked)
    names = [row[0].removeprefix("./").removeprefix("part-").removesuffix(".json") for row in job.files]
    assert names == (["first-angle"] if arrange else ["front", "left", "left-A"])
    outcome = carry_out(job)
    assert outcome.failure is None
    assert [drawing["view"] for drawing in outcome.drawings] == names
    assert b'"left-A"' in outcome.contents[-1][0]
    _, (other,) = jobs(tmp_path, **asked)
    assert key_of(job, Digests()) != key_of(other, Digests())


@pytest.mark.parametrize(
    ("section", "told"),
    [
        ([["left", 5], ["left", 5.0]], "`section` left@5 is asked for twice: give each plane once"),
        ([["left", 5], ["left", 6, 7]], "section needs pairs of a view and its place"),
        ([["left", 5], ["lft", 6]], "`section`: no view is called 'lft'"),
        ([["left", 5], ["right", 6]], "section right is none of the views, front and left: add it to them"),
    ],
)
@pytest.mark.parametrize("arrange", ["", "first-angle"])
def test_pairs_that_cannot_be_drawn_are_refused_where_they_stand(tmp_path, section, told, arrange):
    with pytest.raises(OptionError, match=re.escape(told)):
        manifest, _ = jobs(tmp_path, views=["front", "left"], section=section, arrange=arrange)
        run(plan(manifest, tmp_path / "out"), Kept(None, Digests()), pytest.fail, Silent())


def test_the_order_of_sections_is_part_of_what_is_asked_for(tmp_path):
    one, other = {"front": True, "left": 5}, {"left": 5, "front": True}
    keys = {key_of(jobs(tmp_path, arrange="first-angle", section=each)[1][0], Digests()) for each in (one, other)}
    assert len(keys) == 2


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"section": "front"}, "section needs True for the middle of the model"),
        ({"section": {"back": True}}, "section back is none of the views"),
        ({"section": True, "arrange": "first-angle"}, "a page of several views has sections by name"),
        ({"uncut": ["bolt"]}, "`uncut` is for parts of a section"),
        ({"whole": ["front"]}, "`whole` is for the views of sections"),
        ({"section": {"front": True}, "whole": ["top"]}, "`whole` top is none of the sections, front"),
        ({"section": {"front": True}, "whole": ["front"], "crease": 999}, "crease 999 is not a crease angle"),
        ({"section": {"front": True}, "uncut": ["bolt"], "crease": 999}, "crease 999 is not a crease angle"),
    ],
)
def test_sections_that_cannot_be_are_refused_before_anything_is_drawn(tmp_path, keys, message):
    found, _ = jobs(tmp_path, **keys)
    with pytest.raises(OptionError, match=message):
        run(plan(found, tmp_path / "out"), Kept(None, Digests()), pytest.fail, Silent())


def test_the_key_that_is_wrong_is_found_beside_sections():
    values = {"section": {"front": True}, "uncut": ["bolt"], "crease": 999}
    assert wrong_one(values, "", "first-angle") == wrong_one(values, "") == "crease"
    assert wrong_one({"hidden": True, "section": {"front": "x"}}, "") == "section"
    assert wrong_one({"uncut": ["bolt"], "section": {"front": True}, "page": "A4", "fit": "A4"}, "") == "fit"
    assert wrong_one({"uncut": ["bolt"], "section": {"front": True}, "page": "A4"}, "") is None
    for section in ({"front": True}, [["front", 3]]):
        assert wrong_one({"whole": ["front"], "section": section, "crease": 999}, "", "first-angle") == "crease"
        assert wrong_one({"whole": ["top"], "section": section}, "", "first-angle") == "whole"
    assert wrong_one({"whole": ["top"], "section": True}, "") is None
    assert wrong_one({"whole": ["top"], "section": {"front": "x"}}, "") == "section"
    assert wrong_one({"whole": ["top"]}, "") == wrong_one({"whole": 7, "section": True}, "") == "whole"


def test_options_that_contradict_one_another_are_refused_with_the_line_of_one(tmp_path):
    (tmp_path / "part.off").write_text(MESH)
    (tmp_path / "hlr.toml").write_text('files = "part.off"\nfit = "A4"\npage = "A4"\n')
    with pytest.raises(OptionError, match=r"hlr\.toml, line 3, page: page and fit both name a sheet"):
        run(plan(read(tmp_path / "hlr.toml"), tmp_path / "out"), Kept(None, Digests()), pytest.fail, Silent())


def test_another_method_is_another_drawing(tmp_path):
    keys = {
        key_of(jobs(tmp_path, arrange=method, views="front")[1][0], Digests())
        for method in ("", "first-angle", "third-angle")
    }
    assert len(keys) == 3


def test_a_source_may_have_pages_for_each_view_again(tmp_path):
    (tmp_path / "part.off").write_text(MESH)
    (tmp_path / "other.off").write_text(MESH)
    sources = [{"files": "part.off"}, {"files": "other.off", "arrange": ""}]
    found = manifest_of({"arrange": "third-angle", "source": sources}, tmp_path)
    one, other = plan(found, tmp_path / "out").jobs
    assert len(one.files) == 1
    assert len(other.files) == len(other.views) == 4


def test_a_method_that_does_not_exist(tmp_path):
    with pytest.raises(OptionError, match="first-angle or third-angle, or an empty text is needed, not 'second'"):
        jobs(tmp_path, arrange="second")


TEMPLATE = """<svg xmlns="http://www.w3.org/2000/svg" xmlns:freecad="urn:freecad" width="297mm" height="210mm">
<!-- Working space 10 10 287 200 -->
<text freecad:editable="TITLE"><tspan>title</tspan></text><text freecad:editable="Scale"><tspan>1</tspan></text></svg>
"""


def test_a_template_with_the_name_of_each_source_in_its_title(tmp_path):
    (tmp_path / "sheet.svg").write_text(TEMPLATE)
    keys = {
        "arrange": "third-angle",
        "template": "sheet.svg",
        "texts": {"TITLE": "{stem} {what}"},
        "room": [20, 20, 120, 90],
    }
    _, (job,) = jobs(tmp_path, **keys)
    assert job.depends == ("sheet.svg",)
    outcome = carry_out(job)
    ((svg,),) = outcome.contents
    assert b"part {what}" in svg
    assert b">1:1<" in svg
    before = key_of(job, Digests())
    (tmp_path / "sheet.svg").write_text(TEMPLATE.replace("title", "a title"))
    assert key_of(job, Digests()) != before


def test_what_files_leave_out_of_a_page_stands_in_the_report(tmp_path):
    (tmp_path / "sheet.svg").write_text(TEMPLATE)
    keys = {"arrange": "third-angle", "template": "sheet.svg", "texts": {"TITLE": "図 5"}, "hidden": False}
    _, (job,) = jobs(tmp_path, formats=["svg", "pdf", "dxf", "json"], **keys)
    outcome = carry_out(job)
    assert outcome.warned
    assert [text for note in outcome.drawings[0]["notes"] if "not drawn" in (text := note["text"])] == [
        'Page "third-angle": "図" not drawn in PDF, but ? instead: SVG has all letters.'
    ]
    assert "図 5".encode() in outcome.contents[0][2]  # DXF
    assert b"not drawn" not in outcome.contents[0][3]  # the same bytes as those of `hlr draw`
    _, (job,) = jobs(tmp_path, formats=["pdf"], strict=True, **keys)
    assert carry_out(job).failure.kind == "StrictError"
    _, (job,) = jobs(tmp_path, formats=["svg"], strict=True, **keys)
    assert carry_out(job).failure is None


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"template": "sheet.svg"}, "it is for pages with several views: give arrange as well"),
        ({"arrange": "third-angle", "template": "none.svg"}, "none.svg does not exist"),
        ({"arrange": "third-angle", "texts": {"TITLE": "x"}}, "texts are for the fields of a template"),
        (
            {"arrange": "third-angle", "template": "sheet.svg", "texts": {"NAME": "x"}},
            "sheet.svg has no field 'NAME': its fields are TITLE and Scale",
        ),
        ({"arrange": "third-angle", "template": "sheet.svg", "page": "A3"}, "leave one of them out"),
        ({"arrange": "third-angle", "room": [1, 2, 3]}, "four numbers is needed"),
    ],
)
def test_what_a_template_cannot_have_is_refused(tmp_path, keys, words):
    (tmp_path / "sheet.svg").write_text(TEMPLATE)
    with pytest.raises(OptionError, match=words):
        jobs(tmp_path, **keys)
