"""TechDraw pages of a FreeCAD document: every view at its place, the template filled in, what is not drawn named."""

from __future__ import annotations

import io
import json
from pathlib import Path
from xml.etree import ElementTree
from zipfile import ZipFile

import numpy as np
import pytest

import hlr
from hlr.drawing.lines import bounds_of
from hlr.errors import OptionError, SourceError, StrictError
from support import freecad_document as fc
from support.freecad_document import flag, item, kept, link, links, number, placement, text, vector, whole, write

DATA = Path(__file__).parents[1] / "data"
SVG = "{http://www.w3.org/2000/svg}"

TEMPLATE = b"""<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:freecad="https://www.freecad.org/wiki/x" viewBox="0 0 420 297"
     xmlns:xlink="http://www.w3.org/1999/xlink" onload="alert(1)" style="background:url(http://a.b/d)">
  <script>alert(1)</script><foreignObject/><style>@import url(http://a.b/c)</style>
  <rect x="10" y="10" width="400" height="277" onclick="alert(1)" fill="url(http://a.b/c)"/>
  <image xlink:href="file:///etc/passwd"/><use href="#own"/>
  <text freecad:editable="Title" x="5"><tspan>old</tspan></text><text freecad:editable="None">stays</text>
</svg>"""


def view(*, x=100.0, y=50.0, direction=(0, -1, 0), right=(1, 0, 0), source="Box", shown=None, **values):
    found = {
        "Source": links(source),
        "Direction": vector(*direction),
        "XDirection": vector(*right),
        "X": number(x),
        "Y": number(y),
        "ScaleType": whole(2),
        "Scale": number(1.0),
        **values,
    }
    return item("TechDraw::DrawViewPart", view=shown, **found)


def page(path, views, *others, **values):
    """A document of a box, 10 x 20 x 30, with one page of A3."""
    names = [name for name in views if not name.startswith("_")]
    objects = {
        "Box": item("Part::Box", Shape=kept("Part", "box.brp")),
        "Pin": item("Part::Cylinder", Shape=kept("Part", "pin.brp")),
        "Page": item(
            "TechDraw::DrawPage",
            Label=text("The page"),
            Template=link("Template"),
            Views=links(*names),
            Scale=number(0.5),
            **values,
        ),
        "Template": item(
            "TechDraw::DrawSVGTemplate",
            Width=number(420.0),
            Height=number(297.0),
            PageResult='<FileIncluded file="t.svg"/>',
            EditableTexts='<Map count="1"><Item key="Title" value="a &lt; b"/></Map>',
        ),
        **{name.lstrip("_"): thing for name, thing in views.items()},
    }
    return write(path / "made.FCStd", objects, {"box.brp": fc.box(10, 20, 30), "pin.brp": pin(), "t.svg": TEMPLATE})


def pin():
    """A cylinder of radius 2 and height 30 about x 20, y 10: to the right of the box. Its seam is on the right."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    return fc.brep(BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(20, 10, 0), gp_Dir(0, 0, 1)), 2, 30).Shape())


def boxes(drawing):
    """Lower left and upper right corner of each view, by name."""
    found = {}
    for each in drawing.sheet.views:
        lines = [x for x in drawing.lines if drawing.parts[x.part].name.startswith(f"{each.name}/")]
        found[each.name] = np.round(bounds_of(lines), 6).tolist()
    return found


def test_views_lie_with_their_middle_at_their_place(tmp_path):
    views = {
        "Front": view(),
        "Turned": view(Rotation=number(90.0)),
        "Double": view(Scale=number(2.0)),
        "OfPage": view(ScaleType=whole(0), Scale=number(7.0)),
        "Sideways": view(right=(0, 0, 1)),
        "Right": view(direction=(1, 0, 0), right=(0, 1, 0), x=200.0),
    }
    (drawing,) = hlr.draw_pages(page(tmp_path, views))
    assert boxes(drawing) == {
        "Front": [95, 35, 105, 65],
        "Turned": [85, 45, 115, 55],
        "Double": [90, 20, 110, 80],
        "OfPage": [97.5, 42.5, 102.5, 57.5],
        "Sideways": [85, 45, 115, 55],
        "Right": [190, 35, 210, 65],
    }
    assert (drawing.page.name, drawing.page.width, drawing.page.height) == ("The page", 420, 297)


def test_a_view_turns_anticlockwise_and_its_curves_with_it(tmp_path):
    both = {"Source": links("Box", "Pin"), "direction": (0, 0, 1)}
    (drawing,) = hlr.draw_pages(page(tmp_path, {"Plain": view(**both), "Turned": view(**both, Rotation=number(90.0))}))
    circles = {drawing.parts[x.part].name: x for x in drawing.lines if x.curve is not None and x.visible}
    # The middle of all is at x 11, y 10, and the pin's at x 20.
    for name, middle in {"Plain/Pin": (109, 50), "Turned/Pin": (100, 59)}.items():
        assert np.allclose(circles[name].curve.centre, middle)
        assert np.allclose(circles[name].points.mean(axis=0), middle, atol=0.2)


def test_each_switch_is_for_one_class(tmp_path):
    """Seen from the left the seam of the pin is behind it: hidden edges are asked for, and hidden seams are not."""
    seen = {"source": "Pin", "direction": (-1, 0, 0), "right": (0, -1, 0), "HardHidden": flag(True)}
    views = {"Without": view(**seen), "With": view(**seen, SeamHidden=flag(True))}
    (drawing,) = hlr.draw_pages(page(tmp_path, views))
    seams = [drawing.parts[x.part].name for x in drawing.lines if x.kind == "seam"]
    assert seams == ["With/Pin"]


def test_a_group_places_and_scales_its_views(tmp_path):
    views = {
        "Group": item(
            "TechDraw::DrawProjGroup",
            Views=links("Item"),
            ScaleType=whole(2),
            Scale=number(0.5),
            X=number(200.0),
            Y=number(100.0),
        ),
        "_Item": view(x=10.0, y=-20.0),
    }
    (drawing,) = hlr.draw_pages(page(tmp_path, views))
    assert boxes(drawing) == {"Item": [207.5, 72.5, 212.5, 87.5]}


def test_switches_choose_the_lines(tmp_path):
    views = {"Plain": view(direction=(1, -1, 1), right=(1, 1, 0)), "Full": view(HardHidden=flag(True))}
    views["Full"] = view(direction=(1, -1, 1), right=(1, 1, 0), HardHidden=flag(True))
    (drawing,) = hlr.draw_pages(page(tmp_path, views))
    counts = {
        (name, visible): sum(
            drawing.parts[x.part].name == f"{name}/Box" and x.visible is visible for x in drawing.lines
        )
        for name in ("Plain", "Full")
        for visible in (True, False)
    }
    assert counts == {("Plain", True): 9, ("Plain", False): 0, ("Full", True): 9, ("Full", False): 3}


def test_lines_are_as_wide_as_the_views_say(tmp_path):
    wide = {"LineWidth": number(1.0), "HiddenWidth": number(0.5)}
    usual = {"LineWidth": number(0.7), "HiddenWidth": number(0.35)}
    (drawing,) = hlr.draw_pages(page(tmp_path, {"A": view(shown=usual), "B": view(shown=wide)}))
    root = ElementTree.fromstring(drawing.to_svg())
    lines = root.find(f"{SVG}g[@id='visible']")
    assert lines.get("stroke-width") == ".7"
    assert [group.get("stroke-width") for group in lines.iter(f"{SVG}g") if group.get("stroke-width")] == [".7", "1"]
    (thin,) = hlr.draw_pages(page(tmp_path, {"A": view(shown=usual)}), options=hlr.Options(style="thin"))
    assert 'stroke-width=".25"' in thin.to_svg()


def test_an_object_that_is_named_lies_where_it_lies_in_the_document(tmp_path):
    views = {
        "Front": view(),
        "_Part": item("App::Part", Group=links("Box"), Placement=placement(turn=90)),
    }
    (drawing,) = hlr.draw_pages(page(tmp_path, views))
    assert boxes(drawing) == {"Front": [90, 35, 110, 65]}


def test_on_a_page_glass_hides_without_a_remark(tmp_path):
    """The remark names an option that pages do not take."""
    red = {"ShapeColor": whole(0xFF0000FF), "Transparency": whole(50)}
    glass = item("Part::Box", Shape=kept("Part", "box.brp"), view=red)
    path = page(tmp_path, {"Front": view(Source=links("Glass", "Pin")), "_Glass": glass})
    assert [note.code for note in hlr.draw(path, only=["Glass", "Pin"]).notes] == ["glass-hides"]
    (drawing,) = hlr.draw_pages(path)
    assert drawing.notes == ()


def test_perspective_looks_at_the_middle(tmp_path):
    views = {"Eye": view(Perspective=flag(True), Focus=number(40.0))}
    (drawing,) = hlr.draw_pages(page(tmp_path, views))
    # The front face, 20 deep, is 10 nearer than the middle: as large as 40 / (40 - 10).
    assert np.allclose(boxes(drawing)["Eye"], [100 - 20 / 3, 30, 100 + 20 / 3, 70], atol=1e-3)


def test_the_template_is_filled_in_and_harmless(tmp_path):
    (drawing,) = hlr.draw_pages(page(tmp_path, {"Front": view()}))
    svg = drawing.to_svg()
    template = ElementTree.fromstring(svg).find(f"{SVG}g[@id='template']/{SVG}svg")
    assert template.attrib == {"width": "420", "height": "297", "overflow": "hidden", "viewBox": "0 0 420 297"}
    assert [each.tag.removeprefix(SVG) for each in template] == ["rect", "image", "text", "text"]
    rect, image, title, other = template
    assert rect.attrib == {"x": "10", "y": "10", "width": "400", "height": "277"}
    assert image.attrib == {}
    assert "".join(title.itertext()) == "a < b"
    assert other.text == "stays"
    assert not [word for word in ("alert", "passwd", "http://a.b") if word in svg]


def wire(*points):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakePolygon
    from OCP.gp import gp_Pnt

    polygon = BRepBuilderAPI_MakePolygon()
    for point in points:
        polygon.Add(gp_Pnt(*point))
    return fc.brep(polygon.Wire())


def test_wires_and_sketches_are_drawn_and_solids_hide_them(tmp_path):
    """Seen from the front: one wire runs through behind the box, 10 wide, one lies above it, a sketch beside it."""
    objects = {
        "Page": item("TechDraw::DrawPage", Views=links("All", "Alone")),
        "Box": item("Part::Box", Shape=kept("Part", "box.brp")),
        "Behind": item("Part::Feature", Shape=kept("Part", "behind.brp")),
        "Above": item("Part::Feature", Shape=kept("Part", "above.brp")),
        "Sketch": item("Sketcher::SketchObject", Shape=kept("Part", "sketch.brp")),
        "All": view(Source=links("Box", "Behind", "Above", "Sketch"), HardHidden=flag(True)),
        "Alone": view(Source=links("Sketch"), x=300.0),
    }
    files = {
        "box.brp": fc.box(10, 20, 30),
        "behind.brp": wire((-5, 25, 10), (20, 25, 10)),
        "above.brp": wire((0, 5, 35), (8, 5, 40)),
        "sketch.brp": wire((12, 0, 0), (16, 0, 0), (16, 0, 3)),
    }
    (drawing,) = hlr.draw_pages(write(tmp_path / "made.FCStd", objects, files))
    found = [
        (
            drawing.parts[x.part].name,
            x.visible,
            round(float(np.linalg.norm(np.diff(x.points, axis=0), axis=1).sum()), 6),
        )
        for x in drawing.lines
        if "Box" not in drawing.parts[x.part].name
    ]
    assert sorted(found) == [
        ("All/Above", True, round(89**0.5, 6)),
        ("All/Behind", False, 10.0),
        ("All/Behind", True, 5.0),
        ("All/Behind", True, 10.0),
        ("All/Sketch", True, 3.0),
        ("All/Sketch", True, 4.0),
        ("Alone/Sketch", True, 3.0),
        ("Alone/Sketch", True, 4.0),
    ]
    # The middle is that of everything drawn.
    assert boxes(drawing) == {"All": [87.5, 30, 112.5, 70], "Alone": [298, 48.5, 302, 51.5]}
    assert drawing.notes == ()


def test_what_is_not_drawn_is_named(tmp_path):
    splines = 2 * '<CosmeticEdge><GeometryType value="6"/></CosmeticEdge>'
    added = {"CosmeticEdges": f"<CosmeticEdgeList>{splines}</CosmeticEdgeList>"}
    views = {
        "Front": view(IsoHidden=flag(True), IsoCount=whole(4), **added),
        "Empty": view(source="Nothing"),
        "Dimension": item("TechDraw::DrawViewDimension"),
        "Other": item("TechDraw::DrawViewDimension"),
        "New": item("TechDraw::DrawSomethingNew"),
        "Clip": item("TechDraw::DrawViewClip", Views=links("Inside")),
        "Inside": item("TechDraw::DrawViewAnnotation"),
        "Off": view(Visibility=flag(False)),
        "_Hatch": item("TechDraw::DrawHatch", Source='<LinkSub value="Front" count="1"><Sub value="Face1"/></LinkSub>'),
    }
    path = page(tmp_path, views)
    (drawing,) = hlr.draw_pages(path)
    assert [view.name for view in drawing.sheet.views] == ["Front"]
    assert [str(note) for note in drawing.notes] == [
        'Page "The page": view "Empty" (made.FCStd holds no shapes: there is nothing to draw) not drawn.',
        'Page "The page": 1 DrawSomethingNew, 1 annotation, 2 cosmetic lines, 2 dimensions, 1 hatch and '
        "1 set of isoparametric lines not drawn.",
    ]
    with pytest.raises(StrictError):
        hlr.draw_pages(path, options=hlr.Options(strict=True))


def test_which_page(tmp_path):
    path = page(tmp_path, {"Front": view()})
    for name in ("Page", "The page"):
        assert len(hlr.draw_pages(path, [name])) == 1
    with pytest.raises(OptionError, match='has no page "Other": its pages are "The page"'):
        hlr.draw_pages(path, ["Other"])
    with pytest.raises(OptionError, match=r"leave out `hidden` and `scale`"):
        hlr.draw_pages(path, options=hlr.Options(hidden=True, scale=2))
    with pytest.raises(OptionError, match=r"only FreeCAD documents .* have pages"):
        hlr.draw_pages(DATA / "as1-oc-214.stp")
    with pytest.raises(SourceError, match="has no TechDraw pages"):
        hlr.draw_pages(write(tmp_path / "none.FCStd", {}, {}))


def test_without_a_template_the_page_is_as_large_as_its_views(tmp_path):
    objects = {
        "Box": item("Part::Box", Shape=kept("Part", "box.brp")),
        "Page": item("TechDraw::DrawPage", Views=links("Front")),
        "Front": view(),
    }
    path = write(tmp_path / "bare.FCStd", objects, {"box.brp": fc.box(10, 20, 30)})
    (drawing,) = hlr.draw_pages(path)
    assert (drawing.page.width, drawing.page.height) == (30, 50)
    assert drawing.sheet.template == ""


def test_files(tmp_path):
    (drawing,) = hlr.draw_pages(page(tmp_path, {"Front": view()}))
    assert drawing.to_pdf().startswith(b"%PDF")
    assert b"LWPOLYLINE" in drawing.to_dxf() or b"LINE" in drawing.to_dxf()
    (found,) = json.loads(drawing.to_json())["views"]
    assert (found["name"], found["place"], len(found["lines"])) == ("Front", [100.0, 50.0], len(drawing.lines))


def test_json_says_where_points_of_the_model_lie(tmp_path):
    views = {"Front": view(Rotation=number(30.0)), "Eye": view(Perspective=flag(True), Focus=number(100.0))}
    (drawing,) = hlr.draw_pages(page(tmp_path, views))
    document = json.loads(drawing.to_json())
    front, eye = document["views"]
    assert (front["rotation"], eye["origin"]) == (30.0, None)
    turn = np.radians(30.0)
    matrix = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    for line in front["lines"]:
        flat = np.array(line["points3"]) @ np.array([front["right"], front["up"]]).T * front["scale"]
        assert flat @ matrix.T - front["origin"] == pytest.approx(np.array(line["points"]), abs=1e-9)
    assert document["texts"] == {"Title": "a < b", "None": "stays"}
    assert hlr.load(io.StringIO(drawing.to_json())) == drawing


def test_a_real_page():
    """Corners about the place of each view, as FreeCAD 0.20.2 has them; it is off by up to 0.0002 mm."""
    (drawing,) = hlr.draw_pages(DATA / "housing_body.FCStd")
    about = {}
    for each in drawing.sheet.views:
        x0, y0, x1, y1 = boxes(drawing)[each.name]
        x, y = each.place
        about[each.label] = [x0 - x, y0 - y, x1 - x, y1 - y]
    side, end = [-27, -8.4, 27, 8.4], [-18, -8.4, 18, 8.4]
    expected = {"Front": end, "Left": side, "Right": side, "Rear": end}
    expected |= {"Top": [-18, -27, 18, 27], "Bottom": [-18, -27, 18, 27]}
    expected["FrontTopLeft"] = [-29.8316, -24.0818, 29.8316, 24.0818]
    assert set(about) == set(expected)
    for label, corners in expected.items():
        assert np.allclose(about[label], corners, atol=1e-3), label
    assert [str(note) for note in drawing.notes] == ['Page "Page": 3 dimensions not drawn.']


def without_shapes(name, tmp_path):
    """A document whose shapes were lost."""
    path = tmp_path / name
    with ZipFile(DATA / name) as whole_file, ZipFile(path, "w") as left:
        for entry in whole_file.namelist():
            if not entry.endswith(".brp"):
                left.writestr(entry, whole_file.read(entry))
    return path


def test_pages_of_which_no_view_can_be_drawn_are_refused(tmp_path):
    path = without_shapes("housing_body.FCStd", tmp_path)
    with pytest.raises(SourceError, match=r"^housing_body\.FCStd shows no shapes that can be drawn") as told:
        hlr.draw_pages(path)
    assert str(told.value).count("housing_body.FCStd") == 1
