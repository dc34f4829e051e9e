"""Pages are compared view by view: each is moved by itself, and each difference names its view."""

from dataclasses import replace

import numpy as np
import pytest

import hlr
from hlr.compare import compare
from hlr.compare.difference import Difference
from hlr.compare.matching.pairing import BESIDE
from hlr.compare.overlay.cells import cells_of
from hlr.compare.overlay.table import rows
from hlr.drawing.page import Page
from hlr.drawing.sheet import Sheet, SheetView
from hlr.errors import OptionError
from support import freecad_document
from support.drawings import arc, drawing, line, part
from support.freecad_document import item, kept, links, number, text, vector, whole

TEMPLATE = '<rect x="10" y="10" width="277" height="190" fill="none" stroke="#000000"/>\n'


def outline(x, y, n):
    """Lines of a view about its middle."""
    corners = [[-15, -8], [15, -8], [15, 8], [-4, 8], [-15, -8]]
    return [
        line([[x + a, y + b] for a, b in corners], part=n),
        arc((x + 5, y), 4 + n, 4 + n, (0, 2 * np.pi), part=n),
        line([[x - 6, y - 8], [x - 6, y + 4]], visible=False, part=n),
    ]


def page(places, without=()):
    """A page with a view at each place; without: views of which the hidden line is left out."""
    parts = [part(f"{name}/bolt") for name in places]
    lines = []
    for n, (name, (x, y)) in enumerate(places.items()):
        lines += outline(x, y, n)[: 2 if name in without else 3]
    views = tuple(SheetView(name, name, 1.0, place, 0.0, (0, 0, 1), (1, 0, 0)) for name, place in places.items())
    made = drawing(lines, parts=parts, page=Page("A4", 297.0, 210.0, 0.0, 0.0))
    return replace(made, sheet=Sheet(views, TEMPLATE))


PLACES = {"Front": (60.0, 150.0), "Top": (60.0, 70.0), "Iso": (200.0, 110.0)}
MOVED = {"Front": (60.03, 150.2), "Top": (60.0, 69.6), "Iso": (199.5, 110.0)}


def test_views_are_moved_by_themselves_and_the_difference_names_its_view():
    found = compare(page(PLACES), page(MOVED, without=["Top"]), register="translation")
    (one,) = found.differences
    assert (one.view, one.kind, one.visible, one.part) == ("Top", "gone", False, "Top/bolt")
    views = {view.name: view for view in found.views}
    assert {name: row.shift for name, row in views.items()} == {
        name: pytest.approx(np.subtract(PLACES[name], MOVED[name]), abs=1e-3) for name in PLACES
    }
    assert [row.mm["gone"] for row in views.values()] == [0.0, pytest.approx(12.0), 0.0]
    assert sum(row.same_mm for row in views.values()) == pytest.approx(found.same_mm, abs=1e-3)
    assert found.to_dict()["views"][1]["name"] == "Top"


def test_the_tables_name_a_view_once():
    found = compare(page(PLACES), page(PLACES, without=["Top"]))
    ours = Difference("gone", (1.0, 2.0), 9.0, "sharp", True, "Top/bolt", 7, "before", view="Top")
    others = [
        replace(ours, part=None, edge=None, view="Iso"),
        replace(ours, part="Left/bolt", edge=None, view="Right"),
        replace(ours, part="Topper/bolt"),
    ]
    cells = [cells_of(each, {})[4] for each in (*found.differences, ours, *others)]
    assert cells == ["Top/bolt", "Top/bolt, edge 7", "Iso", "Right Left/bolt", "Top Topper/bolt, edge 7"]
    assert rows(found, 9)[2].endswith("  Top/bolt")


def test_as_they_lie_views_that_lie_elsewhere_differ():
    found = compare(page(PLACES), page(MOVED))
    assert {view.name: view.shift for view in found.views} == dict.fromkeys(PLACES)
    assert {each.view for each in found.differences} == set(PLACES)


def test_a_view_that_lies_elsewhere_on_the_page_is_told():
    found = compare(page(PLACES), page(PLACES | {"Iso": (200.0, 113.0)}), register="translation")
    assert [view.name for view in found.views if view.displaced] == ["Iso"]
    assert not found.same and found.differences == () and found.summary.endswith("elsewhere on the page: Iso")


def test_a_view_of_one_page_alone_is_told():
    fewer = {name: place for name, place in PLACES.items() if name != "Iso"}
    for found, there in (
        (compare(page(PLACES), page(fewer)), (True, False)),
        (compare(page(fewer), page(PLACES)), (False, True)),
    ):
        assert {view.name: (view.before, view.after) for view in found.views}["Iso"] == there
        assert {each.view for each in found.differences} == {"Iso"}


@pytest.mark.parametrize("ending", ["svg", "dxf", "pdf"])
def test_files_of_a_page_are_the_same_view_by_view(ending, tmp_path):
    whole = page(PLACES)
    found = compare(whole, whole.save(tmp_path / f"a.{ending}"))
    assert found.same and [view.name for view in found.views] == list(PLACES), found.summary


FREECAD = """<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 2970 2100">
<g><rect width="2970" height="2100"/></g><g id="DrawingContent">{}</g></svg>"""
GROUP = (
    '<g fill="none" stroke="#000" stroke-width="1" stroke-linecap="round" stroke-linejoin="bevel" '
    'transform="matrix(1,0,0,1,{:g},{:g})"><path d="{}"/></g>'
)


def freecad_page(tmp_path, places):
    """A page as FreeCAD writes it: ten units a millimetre, y down, each path in a group of its own."""
    groups = ""
    for n, (x, y) in enumerate(places.values()):
        r = 40 + 10 * n
        paths = (
            "M-150,80L150,80L150,-80L-40,-80L-150,80",
            f"M{50 + r},0A{r} {r} 0 1 1 {50 - r},0A{r} {r} 0 1 1 {50 + r},0",
            "M-60,80L-60,-40",
        )
        groups += "".join(GROUP.format(10 * x, 10 * (210 - y), path) for path in paths)
    path = tmp_path / "freecad.svg"
    path.write_text(FREECAD.format(groups))
    return path


def test_views_of_freecad_s_pages_are_found_by_their_places(tmp_path):
    theirs = freecad_page(tmp_path, PLACES | {"Iso": (200.4, 110.0)})
    for found in (compare(theirs, page(PLACES)), compare(page(PLACES), theirs)):
        assert found.same and [view.name for view in found.views] == list(PLACES), found.summary
        assert [abs(view.shift[0]) for view in found.views] == pytest.approx([0.0, 0.0, 0.4], abs=0.01)


def test_lines_that_belong_to_no_view_are_compared_too(tmp_path):
    more = page(PLACES)
    more = replace(more, lines=[*more.lines, line([[250, 20], [280, 20]])], sheet=None)
    found = compare(page(PLACES), more)
    assert [(each.view, each.kind, each.length_mm) for each in found.differences] == [(BESIDE, "new", 30.0)]


def test_a_drawing_without_lines_beside_a_page_is_all_missing():
    found = compare(page(PLACES), replace(page(PLACES), lines=(), sheet=None), register="translation")
    assert found.same_mm == 0.0 and {each.kind for each in found.differences} == {"gone"}


def document(path):
    """A box, 10 x 20 x 30, and a page with two views of it."""

    def view(x, direction, right):
        at = {"X": number(x), "Y": number(50.0), "ScaleType": whole(2), "Scale": number(1.0)}
        seen = {"Direction": vector(*direction), "XDirection": vector(*right)}
        return item("TechDraw::DrawViewPart", Source=links("Box"), **seen, **at)

    objects = {
        "Box": item("Part::Box", Shape=kept("Part", "box.brp")),
        "Page": item("TechDraw::DrawPage", Label=text("The page"), Views=links("Front", "Top"), Scale=number(1.0)),
        "Front": view(60.0, (0, -1, 0), (1, 0, 0)),
        "Top": view(120.0, (0, 0, 1), (0.6, 0.8, 0)),
    }
    return freecad_document.write(path / "box.FCStd", objects, {"box.brp": freecad_document.box(10, 20, 30)})


@pytest.mark.slow
def test_a_page_of_a_document_is_judged_by_its_shapes_view_by_view(tmp_path):
    path = document(tmp_path)
    (drawing,) = hlr.draw_pages(path)
    lost = next(n for n, each in enumerate(drawing.lines) if drawing.parts[each.part].name.startswith("Top/"))
    lines = [*drawing.lines[:lost], *drawing.lines[lost + 1 :], line([[50, 60], [68, 42]])]
    other = replace(drawing, lines=tuple(lines)).save(tmp_path / "other.svg")
    found = compare(other, path, page="The page")
    assert [(each.view, each.kind, each.verdict) for each in found.differences] == [
        ("Front", "gone", "second right"),
        ("Top", "new", "second right"),
    ]
    assert found.differences[0].reason == "no edge or outline of the model runs there"
    assert compare(path, other, page="Page").differences[0].verdict == "first right"
    one = compare(other, path, page="Page/Top")
    assert one.after == "box.FCStd, The page/Top" and one.lengths_mm["new"] == found.lengths_mm["new"]


def test_pages_and_views_that_are_not_there_are_refused(tmp_path):
    path = document(tmp_path)
    for wrong, why in (("Page/Left", 'has no view "Left" that is drawn: it has "Front", "Top"'), ("A", 'no page "A"')):
        with pytest.raises(OptionError, match=why):
            compare(path, path, page=wrong)


def test_beside_a_page_the_pages_of_a_document_are_named(tmp_path):
    why = 'box.FCStd is drawn in one: to compare a page of that document, give `page`: "Page"'
    with pytest.raises(OptionError, match=f"is a page of 3 views, and the model of {why}"):
        compare(page(PLACES), document(tmp_path))


def test_a_page_is_said_only_of_documents():
    with pytest.raises(OptionError, match="no side is a FreeCAD document"):
        compare(page(PLACES), page(PLACES), page="Page")
