"""Annotations and balloons of a page: from their stored values, at their places."""

from __future__ import annotations

import pytest

from support.freecad_document import flag, item, link, number, text, whole
from support.freecad_page import SVG, drawn


def test_the_lines_of_an_annotation_lie_about_its_place(tmp_path):
    note = item(
        "TechDraw::DrawViewAnnotation",
        Text='<StringList count="2"><String value="iii &lt;"/><String value="MMMM"/></StringList>',
        TextSize=number(4.0),
        LineSpace=whole(80),
        TextColor='<PropertyColor value="4278190335"/>',
        Rotation=number(30.0),
        X=number(150.0),
        Y=number(70.0),
    )
    drawing, root = drawn(tmp_path, Note=note)
    group = root.find(f"{SVG}g")
    assert group.attrib["transform"] == "translate(150 30) rotate(-30)"
    assert (group.attrib["fill"], group.attrib["font-size"]) == ("#ff0000", "4")
    first, second = group
    assert (first.text, second.text) == ("iii <", "MMMM")
    # As FreeCAD's own: 5.28 mm apart, the same distance from the middle; the longer one is 4 * 0.833 * 4 mm wide.
    assert (first.attrib["y"], second.attrib["y"]) == ("-2.64", "2.64")
    assert first.attrib["x"] == second.attrib["x"] == "-6.664"
    assert drawing.notes == ()


def balloon(**values):
    found = {"SourceView": link("Front"), "Text": text("7"), "X": number(30.0), "Y": number(20.0)}
    found |= {"OriginX": number(10.0), "OriginY": number(-10.0), "KinkLength": number(5.0)}
    view = {"Fontsize": number(5.0), "LineWidth": number(0.25), "Color": '<PropertyColor value="255"/>'}
    return item("TechDraw::DrawViewBalloon", view=view, **{**found, **values})


def test_a_balloon_points_at_its_place_in_the_view(tmp_path):
    drawing, root = drawn(tmp_path, Balloon=balloon())
    line, arrow, bubble, letters = root.find(f"{SVG}g")
    # The view's middle is at 60, 60 from the upper left; offsets are in its scale.
    assert bubble.attrib == {"cx": "75", "cy": "50", "r": "4.75"}
    assert line.attrib["d"] == "M 65 65 L 65.25 50 L 70.25 50"
    assert arrow.attrib["d"].startswith("M 65 65 L ") and arrow.attrib["fill"] == "#000000"
    assert (letters.text, letters.attrib["x"], letters.attrib["text-anchor"]) == ("7", "75", "middle")
    assert drawing.notes == ()
    assert drawing.to_pdf().startswith(b"%PDF")


@pytest.mark.parametrize(
    ("shape", "tag"),
    [(0, "circle"), (1, None), (2, "path"), (3, "rect"), (4, "path"), (5, "rect"), (6, "rect"), (7, "path")],
)
def test_shapes_of_balloons(tmp_path, shape, tag):
    _, root = drawn(tmp_path, Balloon=balloon(BubbleShape=whole(shape), EndType=whole(7)))
    _, *bubble, letters = root.find(f"{SVG}g")
    assert [each.tag for each in bubble] == ([] if tag is None else [f"{SVG}{tag}"])
    assert letters.text == "7"


@pytest.mark.parametrize(("end", "tag"), [(0, "path"), (3, "circle"), (4, "circle"), (7, None)])
def test_ends_of_balloons(tmp_path, end, tag):
    _, root = drawn(tmp_path, Balloon=balloon(EndType=whole(end), BubbleShape=whole(1)))
    _, *ends, _ = root.find(f"{SVG}g")
    assert [each.tag for each in ends] == ([] if tag is None else [f"{SVG}{tag}"])


def test_a_balloon_of_a_view_that_is_not_drawn_is_named(tmp_path):
    drawing, root = drawn(tmp_path, Balloon=balloon(SourceView=link("Section")), Off=balloon(Visibility=flag(False)))
    assert len(root) == 0
    assert [str(note) for note in drawing.notes] == ['Page "Page": 1 balloon not drawn.']
