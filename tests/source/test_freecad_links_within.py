"""Links of FreeCAD to one object within another: placed as FreeCAD 0.20 places them."""

from __future__ import annotations

import numpy as np
import pytest

from hlr.source import open_source
from support import freecad_document as fc
from support.freecad_document import flag, item, kept, links, number, placement, text, write, xlink

FILES = {
    "cube.brp": fc.box(10, 20, 30, at=(1, 0, 0)),
    "pad.brp": fc.box(4, 4, 4),
    "body.brp": fc.box(3, 3, 3, at=(0, 0, 9)),
}


def document(sub, **values):
    """A part with a part, a link and a body in it, and a link into it; the part itself is hidden."""
    return {
        "Box": item("Part::Box", Shape=kept("Part", "cube.brp"), Label=text("A box")),
        "Inner": item("App::Part", Group=links("Box"), Placement=placement(0, 20)),
        "Copy": item("App::Link", LinkedObject=xlink("Inner"), Scale=number(2.0), Placement=placement(0, 0, 7)),
        "Pair": item("App::LinkGroup", ElementList=links("Twin"), Placement=placement(3)),
        "Twin": item("App::Link", LinkedObject=xlink("Box"), Placement=placement(0, 0, 2)),
        "Pad": item("PartDesign::Pad", Shape=kept("Part", "pad.brp")),
        "Body": item(
            "PartDesign::Body",
            Group=links("Pad"),
            Shape=kept("Part", "body.brp"),
            Placement=placement(0, 0, 9),
        ),
        "Outer": item(
            "App::Part",
            Group=links("Inner", "Copy", "Pair", "Body"),
            Placement=placement(0, 0, 40),
            view={"Visibility": flag(False)},
        ),
        "Link": item("App::Link", LinkedObject=xlink("Outer", sub=sub), Placement=placement(100), **values),
    }


def opened(path, sub, **values):
    source = open_source(write(path / "made.FCStd", document(sub, **values), FILES))
    lower = {n: np.round(np.min(box, 0), 6).tolist() for n, box in zip(source.names(), source.boxes(), strict=True)}
    return source, lower


def warnings(source):
    return [str(note) for note in source.notes if note.is_warning]


@pytest.mark.parametrize(
    ("sub", "name", "place"),
    [
        ("Inner.Box.", "Link", [101, 20, 0]),
        ("Inner.$A box.", "Link", [101, 20, 0]),
        ("Inner.", "Link/A box", [101, 20, 0]),
        ("Copy.Box.", "Link", [102, 0, 7]),
        ("Pair.Twin.", "Link", [103, 0, 2]),
        ("Body.", "Link", [100, 0, 9]),
        ("Body.Pad.", "Link", [100, 0, 9]),
    ],
)
def test_the_object_lies_where_freecad_has_it(tmp_path, sub, name, place):
    source, lower = opened(tmp_path, sub)
    assert lower == {name: place}
    assert not warnings(source)
    _, lower = opened(tmp_path, sub, LinkTransform=flag(True))
    assert lower == {name: [place[0], place[1], place[2] + 40]}


@pytest.mark.parametrize("sub", ["Nothing.", "Inner.Nothing.", "Inner.Box.Nothing.", "Body.Pad.Nothing."])
def test_a_way_that_ends_is_told(tmp_path, sub):
    objects = {"Fine": item("Part::Box", Shape=kept("Part", "pad.brp")), **document(sub)}
    source = open_source(write(tmp_path / "made.FCStd", objects, FILES))
    assert source.names() == ["Fine"]
    assert warnings(source) == ['"Link" is a link to what its target does not hold, and was left out.']


def test_a_face_is_left_out(tmp_path):
    objects = {"Fine": item("Part::Box", Shape=kept("Part", "pad.brp")), **document("Inner.Box.Face1")}
    source = open_source(write(tmp_path / "made.FCStd", objects, FILES))
    assert source.names() == ["Fine"]
    assert warnings(source) == ['"Link" is a link to a part of an object and was left out.']


def test_a_row_of_such_links(tmp_path):
    files = {**FILES, "places": fc.placement_list((0, 0, 0), (0, 50, 0))}
    row = {"ElementCount": fc.whole(2), "PlacementList": kept("PlacementList", "places")}
    source = open_source(write(tmp_path / "made.FCStd", document("Inner.Box.", **row), files))
    assert [np.round(np.min(box, 0), 6).tolist() for box in source.boxes()] == [[101, 20, 0], [101, 70, 0]]
