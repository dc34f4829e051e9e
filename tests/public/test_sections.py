"""Sections and details of a FreeCAD page: what is cut away, what fills the cut, and the marks in the base view."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from hlr.compare import compare
from hlr.compare.reading.document import page_of
from support import freecad_document as fc
from support.freecad_document import item, kept, link, links, number, text, vector, whole
from support.freecad_page import SVG, drawn

DATA = Path(__file__).parents[1] / "data" / "freecad" / "sections"

ROWS = b"*Rows, level lines 2 mm apart\n0,0,0.5,0,2\n*Dashed\n0,0,0.5,0,2,3,-1\n*Dense\n0,0,0,0,0.00001\n"
TILE = b'<svg xmlns="http://www.w3.org/2000/svg" width="64" height="64"><path d="M0 32H64" stroke="#000000"/></svg>'


def plate() -> bytes:
    """40 x 20 x 10 with a hole of radius 4 in its middle."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    hole = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(20, 10, 0), gp_Dir(0, 0, 1)), 4, 10).Shape()
    return fc.brep(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(40, 20, 10).Shape(), hole).Shape())


def section(*, normal=(0, -1, 0), origin=(20, 10, 5), scale=1.0, view=None, **values):
    return item(
        "TechDraw::DrawViewSection",
        view=view,
        **{
            "Label": text("Section A - A"),
            "BaseView": link("Top"),
            "Source": links("Box"),
            "Direction": vector(*normal),
            "XDirection": vector(1, 0, 0),
            "SectionNormal": vector(*normal),
            "SectionOrigin": vector(*origin),
            "SectionSymbol": text("A"),
            "X": number(150.0),
            "Y": number(30.0),
            "ScaleType": whole(2),
            "Scale": number(scale),
            **values,
        },
    )


def top(**values):
    axes = {"Direction": vector(0, 0, 1), "XDirection": vector(1, 0, 0)}
    place = {"X": number(100.0), "Y": number(70.0), "ScaleType": whole(2), "Scale": number(1.0)}
    return item("TechDraw::DrawViewPart", Source=links("Box"), **axes, **place, **values)


def page(path, files=None, **things):
    """The drawing of a plate, what is printed on its page, and the lines of the view `name`."""
    drawing, root = drawn(path, files={"box.brp": plate(), **(files or {})}, Top=top(), **things)
    return drawing, root


def lines_of(drawing, name):
    own = [part.name.startswith(f"{name}/") for part in drawing.parts]
    return [line for line in drawing.lines if own[line.part]]


def length(lines):
    return sum(float(np.hypot(*np.diff(line.points, axis=0).T).sum()) for line in lines)


def strokes(root):
    """Ends of the strokes of a hatch."""
    (path,) = [each for each in root.iter(f"{SVG}path") if each.get("stroke-width") == "0.1"]
    pairs = [step.split("L") for step in path.get("d").split("M")[1:]]
    return np.array([[[float(x) for x in end.split()] for end in pair] for pair in pairs])


def test_a_section_shows_what_its_plane_leaves(tmp_path):
    drawing, _ = page(tmp_path, A=section())
    lines = lines_of(drawing, "A")
    # The border of the cut, and the two sides of the hole.
    assert length(lines) == pytest.approx(2 * (40 + 10) + 2 * 10)
    low, high = (np.array([f(line.points, axis=0) for line in lines]) for f in (np.min, np.max))
    assert low.min(axis=0) == pytest.approx([130.0, 25.0]) and high.max(axis=0) == pytest.approx([170.0, 35.0])
    assert {round(float(line.points3[:, 1].min()), 6) for line in lines} == {10.0}
    assert drawing.notes == ()


def test_the_base_view_is_drawn_as_without_a_section(tmp_path):
    """Cutting changes no shape of the document."""
    alone, _ = page(tmp_path)
    beside, _ = page(tmp_path, A=section())
    for a, b in zip(lines_of(alone, "Top"), lines_of(beside, "Top"), strict=True):
        assert np.array_equal(a.points, b.points) and np.array_equal(a.points3, b.points3)


@pytest.mark.parametrize(("height", "left"), [(-1.0, True), (21.0, False)])
def test_a_plane_beside_the_model_leaves_all_or_nothing(tmp_path, height, left):
    drawing, _ = page(tmp_path, A=section(origin=(0, height, 0)))
    assert bool(lines_of(drawing, "A")) == left
    notes = [str(note) for note in drawing.notes]
    nothing = 'Page "Page": view "Section A - A" (its plane leaves nothing of the model) not drawn.'
    assert notes == ([] if left else [nothing])


def test_a_section_of_a_section_cuts_the_whole_model_but_where_the_document_says_otherwise(tmp_path):
    again = {"normal": (1, 0, 0), "origin": (20, 10, 5), "X": number(180.0), "XDirection": vector(0, 1, 0)}
    for previous, wide in ((False, 20.0), (True, 10.0)):
        values = {**again, "BaseView": link("A"), "UsePreviousCut": fc.flag(previous)}
        drawing, _ = page(tmp_path, A=section(), B=section(**values))
        points = np.concatenate([line.points for line in lines_of(drawing, "B")])
        assert np.ptp(points[:, 0]) == pytest.approx(wide) and np.ptp(points[:, 1]) == pytest.approx(10.0)


def test_a_colour_fills_the_faces_of_the_cut(tmp_path):
    shown = {"CutSurfaceColor": '<PropertyColor value="287454020"/>'}
    _, root = page(tmp_path, A=section(CutSurfaceDisplay=whole(1), view=shown))
    (path,) = [each for each in root.iter(f"{SVG}path") if each.get("fill") == "#112233"]
    loops = [
        np.array([[float(x) for x in point.split()] for point in loop.split("L")])
        for loop in path.get("d").rstrip("Z").replace("Z", "").split("M")[1:]
    ]
    onward = [np.roll(loop, -1, axis=0) for loop in loops]
    areas = [
        0.5 * abs(float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())) for a, b in zip(loops, onward, strict=True)
    ]
    assert areas == pytest.approx([160.0, 160.0])
    assert np.concatenate(loops).min(axis=0) == pytest.approx([130.0, 65.0])


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_the_rows_of_a_pattern_lie_inside_the_cut_at_their_own_spacing(tmp_path, scale):
    """The spacing is millimetres on paper: it does not follow the view, and its origin is the middle of the view."""
    pattern = {"PatIncluded": kept("FileIncluded", "a.pat"), "NameGeomPattern": text("Rows")}
    asked = section(CutSurfaceDisplay=whole(3), scale=scale, **pattern)
    _, root = page(tmp_path, {"a.pat": ROWS}, A=asked)
    found = strokes(root)
    heights = 5.0 * scale
    expected = [y for y in np.arange(-40, 40) * 2.0 + 0.5 if -heights < y < heights]
    assert sorted(set((70.0 - found[:, 0, 1]).round(6))) == pytest.approx(expected)
    assert np.allclose(np.abs(found[:, 1, 0] - found[:, 0, 0]), 16.0 * scale) and len(found) == 2 * len(expected)


def test_a_dashed_pattern_has_its_gaps(tmp_path):
    pattern = {"PatIncluded": kept("FileIncluded", "a.pat"), "NameGeomPattern": text("Dashed")}
    _, root = page(tmp_path, {"a.pat": ROWS}, A=section(CutSurfaceDisplay=whole(3), **pattern))
    found = strokes(root)
    assert np.abs(found[:, 1, 0] - found[:, 0, 0]).max() == pytest.approx(3.0)
    row = found[np.isclose(found[:, 0, 1], 69.5)]
    assert np.abs(row[:, 1, 0] - row[:, 0, 0]).sum() == pytest.approx(32.0 * 0.75, abs=2.0)


def test_tiles_of_a_hatch_are_as_large_as_freecad_draws_them(tmp_path):
    """64 units are 6.4 mm, and a tile of one line makes lines 6.4 mm apart, times its scale."""
    asked = section(scale=4.0, CutSurfaceDisplay=whole(2), HatchScale=number(0.5), SvgIncluded=kept("File", "a.svg"))
    _, root = page(tmp_path, {"a.svg": TILE}, A=asked)
    heights = np.unique(strokes(root)[:, 0, 1].round(4))
    assert np.diff(heights) == pytest.approx(3.2) and len(heights) == 12


@pytest.mark.parametrize(
    ("files", "values"),
    [
        ({}, {"CutSurfaceDisplay": whole(2)}),
        ({"a.svg": b"<svg"}, {"CutSurfaceDisplay": whole(2), "SvgIncluded": kept("File", "a.svg")}),
        ({"a.pat": ROWS}, {"CutSurfaceDisplay": whole(3), "PatIncluded": kept("File", "a.pat")}),
        (
            {"a.pat": b"*A\n0,0,0,0,nan\n"},
            {"CutSurfaceDisplay": whole(3), "PatIncluded": kept("File", "a.pat"), "NameGeomPattern": text("A")},
        ),
    ],
)
def test_a_pattern_that_cannot_be_read_is_named(tmp_path, files, values):
    drawing, _ = page(tmp_path, files, A=section(**values))
    assert [str(note) for note in drawing.notes] == ['Page "Page": 1 hatch not drawn.']
    assert lines_of(drawing, "A")


def test_a_pattern_of_too_many_strokes_is_named(tmp_path):
    pattern = {"PatIncluded": kept("FileIncluded", "a.pat"), "NameGeomPattern": text("Dense")}
    drawing, _ = page(tmp_path, {"a.pat": ROWS}, A=section(CutSurfaceDisplay=whole(3), **pattern))
    (note,) = drawing.notes
    assert str(note) == 'Page "Page": the hatch of "Section A - A" (it has too many strokes) not drawn.'


def test_the_base_view_has_the_section_line_with_its_letters(tmp_path):
    _, root = page(tmp_path, A=section())
    assert [each.text for each in root.iter(f"{SVG}text")] == ["A", "A"]
    steps = [each.get("d") for each in root.iter(f"{SVG}path")]
    # From 10 mm before the plate to 10 mm behind it; the arrows look to the back, which is up on paper.
    assert steps[0] in ("M 70 30 L 130 30", "M 130 30 L 70 30")
    assert "M 130 42 L 130 35" in steps and "M 70 42 L 70 35" in steps
    assert {"M 130 30 L 130.85 35 L 129.15 35 Z", "M 130 30 L 129.15 35 L 130.85 35 Z"} & set(steps)


@pytest.mark.parametrize("values", [{"normal": (0, 0, 1)}, {"normal": (0, 0.6, 0.8)}])
def test_a_plane_that_is_not_seen_from_its_edge_has_no_line(tmp_path, values):
    _, root = page(tmp_path, A=section(**values))
    assert not list(root.iter(f"{SVG}text"))


def detail(**values):
    own = {"BaseView": link("Top"), "AnchorPoint": vector(4, 0, 0), "Radius": number(3.0), "Reference": text("X")}
    place = {"X": number(160.0), "Y": number(40.0), "ScaleType": whole(2), "Scale": number(5.0)}
    return item("TechDraw::DrawViewDetail", **{**own, **place, **values})


def test_a_detail_shows_a_circle_of_its_base_larger(tmp_path):
    drawing, root = page(tmp_path, D=detail())
    lines = lines_of(drawing, "D")
    # The circle of radius 4 about the middle, seen in a circle of radius 3 around a point on it.
    (arc,) = lines
    half = 2 * math.asin(1.5 / 4)
    assert abs(np.ptp(arc.curve.angles)) == pytest.approx(2 * half)
    assert arc.curve.centre == pytest.approx([140.0, 40.0]) and arc.curve.radii == pytest.approx((20.0, 20.0))
    assert np.hypot(*(arc.points[[0, -1]] - [160.0, 40.0]).T) == pytest.approx([15.0, 15.0])
    border, mark = root.iter(f"{SVG}circle")
    assert [border.get(each) for each in ("cx", "cy", "r")] == ["160", "60", "15"]
    assert [mark.get(each) for each in ("cx", "cy", "r")] == ["104", "30", "3"]
    assert [each.text for each in root.iter(f"{SVG}text")] == ["X"]
    assert drawing.notes == ()


def test_a_detail_of_a_section_shows_what_that_leaves(tmp_path):
    drawing, _ = page(tmp_path, A=section(), D=detail(BaseView=link("A"), AnchorPoint=vector(4, 0, 0)))
    (side,) = lines_of(drawing, "D")
    # One side of the hole, which is hidden in the whole model.
    assert length([side]) == pytest.approx(30.0) and side.points[:, 0] == pytest.approx(160.0)


@pytest.mark.parametrize(
    ("things", "named"),
    [
        ({"D": detail(BaseView=link("Nothing"))}, "1 detail"),
        ({"D": detail(BaseView=link("D"))}, "1 detail"),
        ({"A": section(BaseView=link("B")), "B": section(BaseView=link("A"))}, "2 sections"),
        ({"D": detail(Radius=number(0.0))}, "1 detail"),
        ({"A": section(normal=(0, 0, 0))}, "1 section"),
    ],
)
def test_what_cannot_be_made_is_named(tmp_path, things, named):
    drawing, _ = page(tmp_path, **things)
    assert [str(note) for note in drawing.notes] == [f'Page "Page": {named} not drawn.']


@pytest.mark.slow
@pytest.mark.parametrize(
    ("document", "page_name", "view"),
    [
        *(("flange", "PageSections", view) for view in ("SectionA", "SectionB", "SectionC", "SectionHide")),
        *((document, "Page", view) for document in ("block_0_20", "block_1_0") for view in ("SecA", "SecAB")),
        ("block_1_0_previous", "Page", "SecAB"),
    ],
)
def test_sections_show_what_freecad_shows(document, page_name, view):
    """Documents that FreeCAD 0.20.2 and 1.0.0 have made, and what they draw."""
    ours = page_of(DATA / document / "document.FCStd", f"{page_name}/{view}", 0.05).drawing
    found = compare(DATA / document / f"{view}.svg", ours, tolerance_mm=0.05)
    assert all(found.looks_same(each) for each in found.differences) and found.same_mm > 170.0, found


@pytest.mark.slow
def test_section_lines_in_a_pdf_are_no_edges():
    folder = DATA / "flange"
    found = compare(folder / "PageSections.pdf", folder / "document.FCStd", page="PageSections")
    (top,) = [view for view in found.views if view.name == "Top"]
    seen = [each for each in found.differences if each.view == "Top" and not found.looks_same(each)]
    assert sum(each.length_mm for each in seen) < 1.0 and top.same_mm > 100.0, seen
