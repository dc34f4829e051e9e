"""Arranged pages with a template: a frame, a title block, and texts in its fields."""

from __future__ import annotations

import re

import numpy as np
import pytest

import hlr
from hlr.source.page_template import read_page_template

BOX = ([(x, y, z) for x in (0, 30) for y in (0, 20) for z in (0, 10)],
       [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
        (1, 5, 7), (1, 7, 3)])  # fmt: skip

TEMPLATE = """<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:freecad="http://www.freecad.org" width="{width}" height="{height}"
     viewBox="{box}">
{comments}
<rect x="10" y="10" width="277" height="190" fill="none" stroke="#000"/>
<text freecad:editable="TITLE" x="150" y="190"><tspan>a title</tspan></text>
<text freecad:editable="FC-SC" x="250" y="190"><tspan>a scale</tspan></text>
</svg>
"""
COMMENTS = "<!-- Working space 10 10 287 200 -->\n<!-- Title block 107 162 287 200 -->"


@pytest.fixture
def template(tmp_path):
    def write(comments=COMMENTS, width="297mm", height="210mm", box="0 0 297 210", **changes):
        text = TEMPLATE.format(comments=comments, width=width, height=height, box=box)
        for old, new in changes.items():
            text = text.replace(old, new)
        path = tmp_path / "sheet.svg"
        path.write_text(text, "utf-8")
        return path

    return write


def extent(page):
    points = np.concatenate([line.points for line in page.lines])
    return points.min(axis=0), points.max(axis=0)


def texts_of(svg):
    return re.findall(r"<(?:tspan|text)[^>]*>([^<]+)<", svg)


def test_views_keep_clear_of_frame_and_title_block(template):
    page = hlr.draw_arranged(BOX, "third-angle", template=template())
    assert (page.page.name, page.page.width, page.page.height) == ("sheet", 297.0, 210.0)
    low, high = extent(page)
    assert (low >= (15, 210 - 162 + 5)).all()
    assert (high <= (282, 195)).all()


def test_beside_the_title_block_where_that_leaves_a_larger_scale(template):
    comments = "<!-- Working space 10 10 287 200 -->\n<!-- Title block 200 20 287 200 -->"
    page = hlr.draw_arranged(BOX, "third-angle", template=template(comments))
    low, high = extent(page)
    assert low[0] >= 15
    assert high[0] <= 195


def test_the_scale_and_texts_are_filled_in(template):
    page = hlr.draw_arranged(BOX, template=template(), texts={"TITLE": 'A <b> & "c"'})
    svg = page.to_svg()
    assert texts_of(svg)[-2:] == ['A &lt;b&gt; &amp; "c"', "2:1"]
    assert "a title" not in svg
    assert page.to_pdf().startswith(b"%PDF")
    given = hlr.draw_arranged(BOX, template=template(), texts={"FC-SC": "as shown"})
    assert texts_of(given.to_svg())[-2:] == ["a title", "as shown"]


@pytest.mark.parametrize("key", ["SCALE", "Scale", "FC-Scale", "FC-SC"])
def test_fields_for_the_scale(template, key):
    svg = hlr.draw_arranged(BOX, template=template(**{"FC-SC": key})).to_svg()
    assert texts_of(svg)[-1] == "2:1"


def test_the_symbol_of_the_method_is_left_to_the_template(template):
    assert "<circle" not in hlr.draw_arranged(BOX, template=template()).to_svg()


def test_a_room_that_is_asked_for(template):
    page = hlr.draw_arranged(BOX, template=template(""), room=(20, 100, 120, 200))
    low, high = extent(page)
    assert (low >= (20, 100)).all()
    assert (high <= (120, 200)).all()
    plain = hlr.draw_arranged(BOX, room=(150, 20, 280, 200))
    assert extent(plain)[0][0] >= 150


@pytest.mark.parametrize(
    ("width", "height", "size"),
    [
        ("29.7cm", "21cm", (297, 210)),
        ("11in", "8.5in", (279.4, 215.9)),
        ("420", "297", (420, 297)),
        ("960px", "480px", (254, 127)),
    ],
)
def test_lengths_in_any_unit(template, width, height, size):
    read = read_page_template(template(width=width, height=height))
    assert (read.width, read.height) == size


def test_comments_are_in_the_units_of_the_box_of_the_view(template):
    read = read_page_template(template(width="297mm", height="210mm", box="0 0 594 420"))
    assert read.rooms[0] == pytest.approx((10, 210 - 76, 138.5, 200))


def test_what_could_run_or_lead_out_of_the_file_is_left_out(template):
    path = template(**{"</svg>": '<script>alert(1)</script><image href="http://x/y.png"/><g onclick="z()"/></svg>'})
    svg = hlr.draw_arranged(BOX, template=path).to_svg()
    assert not re.search("script|http://x|onclick", svg)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"width": "wide"}, "sheet.svg is no page template: its width is no length such as 297mm, but 'wide'"),
        ({"height": "0mm"}, "its height is no length"),
        ({"<rect": "<rect <"}, "sheet.svg cannot be read as a page template: it is no sound XML"),
        ({'<?xml version="1.0" encoding="UTF-8"?>': "<!DOCTYPE svg [<!ENTITY a 'b'>]>"}, "sheet.svg"),
    ],
)
def test_what_is_no_template_is_refused(template, changes, words):
    with pytest.raises(hlr.SourceError, match=re.escape(words)):
        hlr.draw_arranged(BOX, template=template(**changes))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"texts": {"NAME": "x"}}, "sheet.svg has no field 'NAME': its fields are TITLE and FC-SC"),
        ({"options": hlr.Options(page="A3")}, "a template has a size of its own: leave out `page`, or `template`"),
        ({"room": (0, 0, 400, 100)}, "the room 0,0,400,100 leads out of a page of 297 x 210 mm"),
        ({"room": (50.0, 0.0, 20.0, 100.0)}, "millimetres, such as 20,60,287,200, not 50,0,20,100"),
        ({"room": "A4"}, "`room` needs two corners in millimetres"),
        (
            {"template": None, "texts": {"TITLE": "x"}},
            "`texts` is for the fields of a template: give `template` as well",
        ),
        ({"texts": "TITLE"}, "texts are needed by the keys of fields, such as {'TITLE': 'Bracket'}, not 'TITLE'"),
        ({"texts": {"TITLE": "a\x07b"}}, r"the text for TITLE has the character '\x07', which SVG cannot hold"),
        ({"texts": {"TITLE": "a\udcffb"}}, r"the text for TITLE has the character '\udcff', which SVG cannot hold"),
        ({"template": 3}, "template needs the name of an SVG file, not 3"),
        ({"template": ""}, "template needs the name of an SVG file, not ''"),
    ],
)
def test_what_contradicts_is_refused(template, options, words):
    with pytest.raises(hlr.OptionError, match=re.escape(words)):
        hlr.draw_arranged(BOX, **{"template": template(), **options})


def test_a_scale_that_is_too_large_for_the_room_is_told(template):
    page = hlr.draw_arranged(BOX, template=template(), options=hlr.Options(scale=10))
    assert any("which has room for 267 x 142 mm: give the scale" in note.text for note in page.notes if note.is_warning)


def test_a_template_that_does_not_say_where_its_title_block_is(template):
    page = hlr.draw_arranged(BOX, template=template(""))
    assert any("does not say where views may lie" in note.text for note in page.notes)
    assert not any(
        "where views may lie" in n.text for n in hlr.draw_arranged(BOX, template=template("")).notes if n.is_warning
    )
