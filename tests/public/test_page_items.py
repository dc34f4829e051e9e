"""Symbols, tables, rich texts, leaders, added lines and clips of a page: from their stored values, at their places."""

from __future__ import annotations

from xml.sax.saxutils import escape

import numpy as np
import pytest

import hlr
from hlr.errors import SourceError
from support import freecad_document as fc
from support.freecad_document import flag, item, kept, link, links, number, text, vector, whole, write
from support.freecad_page import SVG, drawn


def symbol(svg, **values):
    return item("TechDraw::DrawViewSymbol", Symbol=text(svg), X=number(150.0), Y=number(70.0), **values)


def test_a_symbol_is_as_large_as_freecad_draws_it_and_harmless(tmp_path):
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20" onload="alert(1)">'
        "<script>alert(1)</script><circle r='8' onclick='alert(1)'/></svg>"
    )
    drawing, root = drawn(tmp_path, Symbol=symbol(svg, Scale=number(2.0), Rotation=number(30.0)))
    group = root.find(f"{SVG}g")
    assert group.attrib == {"transform": "translate(150 30) rotate(-30)"}
    inner = group.find(f"{SVG}svg")
    # 20 mm are 70 whole pixels for Qt, of which 96 lie on an inch: 18.52 mm, twice as large.
    assert (inner.attrib["width"], inner.attrib["x"], inner.attrib["viewBox"]) == ("37.0370", "-18.5185", "0 0 20 20")
    assert [each.tag for each in inner] == [f"{SVG}circle"]
    assert "alert" not in drawing.to_svg()
    assert drawing.notes == ()
    assert drawing.to_pdf().startswith(b"%PDF")


def test_a_table_is_as_large_as_what_it_holds(tmp_path):
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg"><rect x="10" y="20" width="94.5" height="47.25"/><text>a</text></svg>'
    )
    table = item("TechDraw::DrawViewSpreadsheet", Symbol=text(svg), X=number(100.0), Y=number(50.0))
    _, root = drawn(tmp_path, Table=table)
    inner = root.find(f"{SVG}g/{SVG}svg")
    found = {name: inner.attrib[name] for name in ("x", "y", "width", "height", "viewBox")}
    assert found == {
        "x": "-12.5000",
        "y": "-6.2500",
        "width": "25.0000",
        "height": "12.5000",
        "viewBox": "10 20 94.5 47.25",
    }


def test_fields_of_a_symbol_are_filled_in_their_order(tmp_path):
    fields = "".join(f'<text freecad:editable="f{i}"><tspan>old</tspan></text>' for i in range(3))
    names = 'xmlns="http://www.w3.org/2000/svg" xmlns:freecad="https://a.b/c"'
    svg = f'<svg {names} width="10" height="10">{fields}</svg>'
    texts = '<StringList count="2"><String value="a &lt;"/><String value="b"/></StringList>'
    _, root = drawn(tmp_path, Symbol=symbol(svg, EditableTexts=texts))
    assert ["".join(each.itertext()) for each in root.iter(f"{SVG}text")] == ["a <", "b", "old"]


@pytest.mark.parametrize("svg", ["", '<svg xmlns="http://www.w3.org/2000/svg"/>'])
def test_a_symbol_without_a_picture_is_named(tmp_path, svg):
    drawing, root = drawn(tmp_path, Symbol=symbol(svg))
    assert len(root) == 0
    assert [str(note) for note in drawing.notes] == ['Page "Page": 1 symbol not drawn.']


@pytest.mark.parametrize("svg", ["<svg", "<html/>", '<!DOCTYPE a [<!ENTITY b "c">]><svg/>'])
def test_a_broken_symbol_is_an_error_in_one_sentence(tmp_path, svg):
    with pytest.raises(SourceError, match=r"made\.FCStd"):
        drawn(tmp_path, Symbol=symbol(svg))


def test_a_rich_text_has_its_lines_and_letters(tmp_path):
    html = (
        "<html><head><style>p{}</style></head><body><p><b>Bold</b> and <i>slanted</i></p>"
        '<p><span style="font-size:20pt; color:#ff0000">big &lt;</span></p></body></html>'
    )
    note = item("TechDraw::DrawRichAnno", AnnoText=text(html), X=number(150.0), Y=number(70.0), ShowFrame=flag(True))
    drawing, root = drawn(tmp_path, Note=note)
    group = root.find(f"{SVG}g")
    assert group.attrib["transform"] == "translate(150 30) rotate(0)"
    frame, bold, middle, slanted, big = group
    assert float(frame.attrib["x"]) == pytest.approx(-0.5 * float(frame.attrib["width"]), abs=1e-3)
    assert [each.text for each in (bold, middle, slanted, big)] == ["Bold", "and", "slanted", "big <"]
    assert (bold.get("font-weight"), slanted.get("font-style"), middle.get("font-weight")) == ("bold", "italic", None)
    assert (big.get("font-size"), big.get("fill")) == ("7.05556", "#ff0000")
    assert float(bold.get("y")) == float(slanted.get("y")) < float(big.get("y"))
    assert float(bold.get("x")) < float(middle.get("x")) < float(slanted.get("x"))
    assert drawing.notes == ()


def test_a_rich_text_is_as_wide_as_it_may_be(tmp_path):
    note = item("TechDraw::DrawRichAnno", AnnoText=text("one two three"), MaxWidth=number(13.0), ShowFrame=flag(False))
    _, root = drawn(tmp_path, Note=note)
    assert [each.text for each in root.iter(f"{SVG}text")] == ["one two", "three"]


@pytest.mark.parametrize(
    ("view", "end"),
    [
        ({}, "M 70 50 L 72 52 L 73.5 52"),  # up to 0.21: in tenths of a millimetre
        ({"UseOldCoords": flag(False)}, "M 70 50 L 80 60 L 87.5 60"),
    ],
)
def test_a_leader_begins_at_its_place_in_the_view(tmp_path, view, end):
    points = fc.vector_list((0, 0, 0), (20, 20, 0), (35, 20, 0))
    values = {"X": number(20.0), "Y": number(20.0), "Scalable": flag(True), "EndSymbol": whole(7)}
    leader = item(
        "TechDraw::DrawLeaderLine",
        view=view,
        LeaderParent=link("Front"),
        WayPoints=kept("VectorList", "points"),
        **values,
    )
    _, root = drawn(tmp_path, files={"points": points}, Leader=leader)
    line, arrow = root.find(f"{SVG}g")
    assert line.attrib["d"] == end
    assert arrow.attrib["d"].startswith("M 70 50 L ")


def test_a_written_text_of_a_dimension_is_drawn_and_its_lines_are_named(tmp_path):
    at = {"References2D": '<LinkSubList count="1"><Link obj="Front" sub="Edge1"/></LinkSubList>', "Y": number(20.0)}
    written = item("TechDraw::DrawViewDimension", Arbitrary=flag(True), FormatSpec=text("4 holes"), **at)
    measured = item("TechDraw::DrawViewDimension", FormatSpec=text("%.2w"), **at)
    drawing, root = drawn(tmp_path, Written=written, Measured=measured)
    (words,) = root
    assert (words.text, words.attrib["x"], words.attrib["y"]) == ("4 holes", "60", "44.5")
    assert [str(note) for note in drawing.notes] == ['Page "Page": 1 dimension and 1 set of dimension lines not drawn.']


def added(kind, geometry, style=1, **more):
    fields = {"Style": style, "Weight": 0.5, "Color": "#0000ff", "Visible": 1, "GeometryType": kind, **more}
    values = "".join(f'<{name} value="{value}"/>' for name, value in fields.items())
    return f"<CosmeticEdge>{values}{geometry}</CosmeticEdge>"


def test_added_lines_lie_about_the_middle_of_their_view(tmp_path):
    straight = added(7, '<Points><Point X="-5" Y="2"/><Point X="5" Y="-2"/></Points>', style=2)
    circle = added(1, '<Center X="5" Y="3"/>', Radius=4)
    arc = added(2, '<Center X="0" Y="0"/>', Radius=2, StartAngle=0, EndAngle=1.5707963267948966)
    unseen = added(1, '<Center X="5" Y="3"/>', Radius=4, Visible=0)
    front = {"CosmeticEdges": f"<CosmeticEdgeList>{straight}{circle}{unseen}</CosmeticEdgeList>"}
    drawing, root = drawn(tmp_path, front=front | {"CenterLines": f"<CenterLineList>{arc}</CenterLineList>"})
    first, second = root.iter(f"{SVG}g")
    assert first.attrib["transform"] == "translate(60 60) rotate(0) scale(0.5)"
    # Half a millimetre wide on paper, at a scale of a half.
    assert [(each.attrib["d"], each.get("stroke-width"), each.get("stroke-dasharray")) for each in first] == [
        ("M -5 2 L 5 -2", "1", "4 2"),
        ("M 1 3 A 4 4 0 0 1 9 3 A 4 4 0 0 1 1 3 Z", "1", None),
    ]
    assert second[0].attrib["d"] == "M 2 0 A 2 2 0 0 1 1.22465e-16 2"
    assert drawing.notes == ()


def test_a_clip_leaves_what_lies_in_it(tmp_path):
    """The front of the box, 10 x 30, lies about the middle of the clip at 100, 50, and 5 higher."""
    at = {"Direction": vector(0, -1, 0), "XDirection": vector(1, 0, 0), "ScaleType": whole(2), "Scale": number(1.0)}
    objects = {
        "Box": item("Part::Box", Shape=kept("Part", "box.brp")),
        "Page": item("TechDraw::DrawPage", Template=link("Template"), Views=links("Clip", "Inside")),
        "Template": item("TechDraw::DrawSVGTemplate", Width=number(200.0), Height=number(100.0)),
        "Clip": item(
            "TechDraw::DrawViewClip",
            Views=links("Inside"),
            **{"X": number(100.0), "Y": number(50.0), "Width": number(20.0), "Height": number(12.0)},
        ),
        "Inside": item("TechDraw::DrawViewPart", Source=links("Box"), Y=number(5.0), **at),
    }
    (drawing,) = hlr.draw_pages(write(tmp_path / "made.FCStd", objects, {"box.brp": fc.box(10, 20, 30)}))
    ends = sorted(tuple(np.round(line.points[[0, -1]], 6).ravel().tolist()) for line in drawing.lines)
    assert ends in ([(95, 44, 95, 56), (105, 44, 105, 56)], [(95, 56, 95, 44), (105, 56, 105, 44)])
    assert '<rect x="90" y="44" width="20" height="12"' in drawing.sheet.template
    assert drawing.notes == ()


def test_what_is_written_is_escaped(tmp_path):
    note = item("TechDraw::DrawRichAnno", AnnoText=text(f"<p>{escape('<script>a</script>')}</p>"))
    drawing, _ = drawn(tmp_path, Note=note)
    assert "<script>" not in drawing.to_svg()
