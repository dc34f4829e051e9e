"""Damaged colours in FreeCAD documents: the shape is drawn without them."""

from __future__ import annotations

import struct

import pytest

from hlr.source import open_source
from support import freecad_document as fc
from support.freecad_document import flag, item, kept, write, xlink

SHORT = struct.pack("<I", 6) + b"1234"
FILES = {"a.brp": fc.box(10, 20, 30), "short": SHORT}
COLOR = '<PropertyColor value="4278190335"/>'


@pytest.mark.parametrize(
    ("view", "why"),
    [
        ({"ShapeColor": COLOR, "DiffuseColor": kept("ColorList", "short")}, "a list is cut short"),
        ({"ShapeAppearance": kept("MaterialList", "short")}, "a list is cut short"),
        ({"ShapeColor": '<PropertyColor value="red"/>'}, '"red" is no number'),
    ],
)
def test_a_shape_is_drawn_without_them(tmp_path, view, why):
    objects = {"Box": item("Part::Box", Shape=kept("Part", "a.brp"), view=view)}
    source = open_source(write(tmp_path / "made.FCStd", objects, FILES))
    assert source.names() == ["Box"]
    assert [(note.code, note.text) for note in source.notes] == [
        ("colors-left-out", f'"Box" is drawn without its colours: {why}.')
    ]


def test_what_a_link_shows_is_drawn_without_them(tmp_path):
    material = '<PropertyMaterial diffuseColor="red" transparency="0"/>'
    objects = {
        "Box": item("Part::Box", Shape=kept("Part", "a.brp")),
        "Link": item(
            "App::Link", LinkedObject=xlink("Box"), view={"OverrideMaterial": flag(True), "ShapeMaterial": material}
        ),
    }
    source = open_source(write(tmp_path / "made.FCStd", objects, FILES))
    assert source.names() == ["Box", "Link"]
    assert [str(note) for note in source.notes] == ['"Link" is drawn without its colours: "red" is no number.']
