"""Pages of several views as JSON: each view with its place, parts and lines; read back, it is the same page."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh

import hlr
from hlr.drawing.page import Page
from hlr.drawing.section_marks import SectionMark
from hlr.drawing.sheet import Sheet, SheetView
from hlr.errors import WriteError
from hlr.writers.loading import loads
from support.drawings import drawing, line, part

TEMPLATE = """<svg xmlns="http://www.w3.org/2000/svg" xmlns:freecad="urn:freecad" width="420mm" height="297mm">
<!-- Working space 10 10 410 287 -->
<text freecad:editable="TITLE"><tspan>a title</tspan></text><text freecad:editable="NUMBER">007</text>
<text freecad:editable="FC-SC"><tspan>scale</tspan></text></svg>
"""


def two_bodies():
    """In inches: a plate, and a block on it, so that nothing is even."""
    plate, block = trimesh.creation.box((3, 2, 0.5)), trimesh.creation.box((1, 0.7, 1))
    block.apply_translation((0.7, 0.4, 0.75))
    both = trimesh.Scene({"plate": plate, "block": block})
    both.units = "inches"
    return both


@pytest.fixture(scope="module")
def arranged(tmp_path_factory):
    template = tmp_path_factory.mktemp("page") / "sheet.svg"
    template.write_text(TEMPLATE)
    options = hlr.Options(section={"front": True}, hidden=True)
    return hlr.draw_arranged(
        two_bodies(), "third-angle", options=options, template=template, texts={"TITLE": 'A "plate" & <more>'}
    )


def by_hand(template="", method="", **changes):
    """A page of two views of a document: one turned, one in perspective."""
    front = SheetView(
        "Front", "From the front", 0.5, (20.0, 30.0), 90.0, (0.0, -1.0, 0.0), (1.0, 0.0, 0.0), "", (4.0, 5.0)
    )
    other = replace(front, name="Other", rotation=0.0, origin=None)
    marks = (SectionMark("B2", (1.0, 2.0)),)
    made = drawing(
        [line([[1, 2], [3, 4]], part=1), line([[5, 6], [7, 8]], part=0), line([[1, 1], [2, 2]], "hatch", part=0)],
        parts=[part("Front/a/b"), part("Other/a", (0.5, 0.25, 1.0))],
    )
    sheet = Sheet((front, other), template, method, marks, {"TITLE": "Hülse"})
    return replace(
        made, view=replace(made.view, name="Page"), page=Page("Page", 90.0, 60.0, 0.0, 0.0), sheet=sheet, **changes
    )


def test_each_view_has_its_place_its_parts_and_its_lines(arranged):
    made = json.loads(arranged.to_json())
    assert list(made) == [
        "format", "version", "source", "units", "accuracy", "name", "method", "scale", "page", "model", "texts",
        "template", "sections", "views", "notes", "plan", "counters", "timings",
    ]  # fmt: skip
    assert (made["format"], made["version"], made["method"]) == ("hlr-page", 1, "third-angle")
    assert made["model"] == {"unit": 25.4, "up_axis": np.eye(3).tolist()}
    assert made["page"] == {"name": "sheet", "width": 420.0, "height": 297.0, "left": 0.0, "bottom": 0.0}
    assert [(view["name"], view["scale"], view.get("letter")) for view in made["views"]] == [
        ("front", 2.0, "A"), ("top", 2.0, None), ("right", 2.0, None), ("iso", 2.0, None)
    ]  # fmt: skip
    for view, shown in zip(made["views"], arranged.sheet.views, strict=True):
        assert tuple(view["place"]) == shown.place
        assert {each["name"] for each in view["parts"]} <= {"plate", "block"}
        own = [x for x in arranged.lines if arranged.parts[x.part].name.startswith(f"{view['name']}/")]
        assert [each["points"] for each in view["lines"]] == [x.points.tolist() for x in own]
        names = [arranged.parts[x.part].name for x in own]
        assert [f"{view['name']}/{view['parts'][each['part']]['name']}" for each in view["lines"]] == names
    assert {each["class"] for each in made["views"][0]["lines"]} >= {"sharp", "hatch"}


def test_points_of_the_model_lie_where_the_page_has_them(arranged):
    made = json.loads(arranged.to_json())
    for view in made["views"]:
        axes = np.array([view["right"], view["up"]])
        for each in view["lines"]:
            found = np.array(each["points3"]) @ axes.T * made["model"]["unit"] * view["scale"] - view["origin"]
            assert found == pytest.approx(np.array(each["points"]), abs=1e-9)


def test_titles_cutting_lines_and_the_texts_of_the_title_block(arranged):
    made = json.loads(arranged.to_json())
    (mark,) = arranged.sheet.marks
    assert made["sections"] == [
        {
            "letter": "A",
            "title": "A-A",
            "place": list(mark.name),
            "line": [list(end) for end in mark.line],
            "back": list(mark.back),
        }
    ]
    assert made["texts"] == {"TITLE": 'A "plate" & <more>', "NUMBER": "007", "FC-SC": "2:1"}
    assert "A &quot;plate&quot;" in made["template"] or 'A "plate" &amp; &lt;more&gt;' in made["template"]


def test_a_page_of_a_document():
    made = json.loads(by_hand().to_json())
    assert (made["name"], made["method"], made["texts"]) == ("Page", None, {"TITLE": "Hülse"})
    assert made["sections"][0]["line"] is None
    front, other = made["views"]
    assert (front["label"], front["rotation"], front["up"], front["origin"]) == (
        "From the front",
        90,
        [0, 0, 1],
        [4, 5],
    )
    assert other["origin"] is None
    assert [each["points"] for each in front["lines"]] == [[[5, 6], [7, 8]], [[1, 1], [2, 2]]]
    assert [each["part"] for each in (*front["lines"], *other["lines"])] == [0, 0, 0]
    assert front["parts"][0]["name"] == "a/b"


def test_a_page_comes_back_as_it_was(arranged, tmp_path):
    found = hlr.load(arranged.save(tmp_path / "a.json"))
    assert found == arranged and hash(found) == hash(arranged)
    assert found.sheet == arranged.sheet and found.timings.keys() == arranged.timings.keys()
    for format in ("svg", "pdf", "dxf", "json"):
        made = [each.save(tmp_path / f"{i}.{format}").read_bytes() for i, each in enumerate((arranged, found))]
        assert made[0] == made[1]


def test_a_page_without_sections_comes_back():
    page = hlr.draw_arranged(two_bodies(), views=["front", "top"])
    assert loads(page.to_json()) == page


def test_a_page_of_a_document_comes_back_with_its_own_order_of_views():
    asked = by_hand(template='<svg width="9" viewBox=\'0 0 9 9\'><g id="a"><text>x</text></g></svg><path d="M0 0"/>')
    found = loads(asked.to_json())
    assert found.sheet == asked.sheet and found.parts == asked.parts and found.page == asked.page
    assert found.to_json() == asked.to_json()


def test_a_part_of_no_view_is_refused():
    with pytest.raises(WriteError, match="cannot write the page as JSON: its part 'Third/a' is of none of its views"):
        by_hand(parts=(part("Front/a"), part("Third/a"))).to_json()


def damaged(*path, value=None):
    """The page's JSON with one value changed; None takes it out."""
    document = json.loads(by_hand().to_json())
    inside = document
    for step in path[:-1]:
        inside = inside[step]
    inside[path[-1]] = value
    if value is None:
        del inside[path[-1]]
    return json.dumps(document)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (damaged("version", value=2), "has version 2 of the format, not 1: draw the model again"),
        (damaged("views"), "damaged: 'views' is missing"),
        (damaged("views", value=7), "views should be a list of objects"),
        (damaged("views", 0, "name", value="Other"), "views should each have a name of their own, without a slash"),
        (damaged("views", 0, "name", value="a/b"), "views should each have a name of their own, without a slash"),
        (damaged("views", 1, "place"), "views[1] should be an object with 'place'"),
        (damaged("views", 1, "scale", value=0), "views[1].scale is 0, not a positive number"),
        (damaged("views", 1, "right", value=[0, 0, 0]), "views[1].right is no direction"),
        (damaged("views", 1, "letter", value="<b>"), "views[1].letter should be a letter such as A"),
        (damaged("views", 1, "lines", 0, "part", value=1), "views[1].lines[0] is of part 1, and there are 1"),
        (damaged("views", 0, "lines", 1, "class", value="axis"), "views[0].lines[1].class should be one of"),
        (damaged("page"), "'page' is missing"),
        (damaged("page", "width", value=-1), "page.width is -1, not a positive number"),
        (damaged("method", value="fourth-angle"), "method should be null, or one of first-angle, third-angle"),
        (damaged("sections", 0, "letter", value="<script>"), "sections[0].letter should be a letter such as A"),
        (damaged("sections", 0, "line", value=[[0, 0]]), "sections[0].line should have two ends"),
        (damaged("texts", value={"TITLE": 7}), "texts.TITLE should be text"),
        (damaged("model", value=7), "model should be an object"),
        (damaged("style", value=7), "style should be an object"),
        (damaged("views", 1, "place", value=[math.nan, 1]), "views[1] has coordinates that are no numbers"),
        (damaged("views", 0, "origin", value=[0, math.inf]), "views[0] has coordinates that are no numbers"),
        (damaged("sections", 0, "back", value=[0, math.inf]), "sections[0] has coordinates that are no numbers"),
        (damaged("template", value="<svg>"), "its template is no sound XML"),
        (damaged("template", value="</svg><svg>"), "its template is no sound XML"),
    ],
)
def test_what_is_damaged_is_refused_in_a_sentence(text, message):
    with pytest.raises(hlr.SourceError) as caught:
        loads(text)
    assert message in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "template",
    [
        "<script>alert(1)</script>",
        '<svg><g onclick="alert(1)"/></svg>',
        '<image href="http://a.b/c.png"/>',
        '<rect fill="url(http://a.b/c)"/>',
        '<a href="javascript:alert(1)"/>',
        '<html xmlns="http://www.w3.org/1999/xhtml"/>',
    ],
)
def test_a_template_that_could_run_something_is_refused(template):
    with pytest.raises(hlr.SourceError, match="template holds what could run, or leads out of the file"):
        loads(damaged("template", value=template))
