"""Folders in parts of FreeCAD: the part lists what is in them once more, and each object is one part all the same."""

from __future__ import annotations

import pytest

import hlr
from hlr.source import open_source
from support import freecad_document as fc
from support.freecad_document import flag, item, kept, links, placement, write

FILES = {"a.brp": fc.box(10, 20, 30), "b.brp": fc.box(5, 5, 5, at=(50, 0, 0))}


def folder(*names, shown=True):
    return item("App::DocumentObjectGroup", Group=links(*names), view={"Visibility": flag(shown)})


def document(shown=True, **values):
    """What FreeCAD writes where a folder with a folder in it is moved into a part."""
    return {
        "Box": item("Part::Box", Shape=kept("Part", "a.brp")),
        "Pin": item("Part::Box", Shape=kept("Part", "b.brp"), **values),
        "Folder": folder("Box", "Inner", shown=shown),
        "Inner": folder("Pin"),
        "Part": item("App::Part", Group=links("Box", "Folder", "Inner", "Pin"), Placement=placement(0, 0, 9)),
    }


def test_each_object_is_one_part_named_by_its_folder(tmp_path):
    path = write(tmp_path / "made.FCStd", document(), FILES)
    assert open_source(path).names() == ["Part/Folder/Box", "Part/Folder/Inner/Pin"]
    drawing = hlr.draw(path, view="front")
    assert not drawing.notes
    assert hlr.info(path).bounds[0] == pytest.approx((0, 0, 9), abs=1e-5)


def test_what_is_in_a_hidden_folder_is_shown_where_the_part_has_it(tmp_path):
    path = write(tmp_path / "made.FCStd", document(shown=False), FILES)
    assert sorted(open_source(path).names()) == ["Part/Box", "Part/Inner/Pin"]
    assert len(open_source(path, hidden_objects=True).names()) == 2


def test_a_hidden_object_is_counted_once(tmp_path):
    path = write(tmp_path / "made.FCStd", document(view={"Visibility": flag(False)}), FILES)
    source = open_source(path)
    assert source.names() == ["Part/Folder/Box"]
    assert [str(note)[:36] for note in source.notes] == ["1 object that the document hides lef"]


def test_folders_that_hold_one_another_are_told(tmp_path):
    objects = {
        **document(),
        "Folder": folder("Box", "Inner"),
        "Inner": folder("Pin", "Folder"),
    }
    source = open_source(write(tmp_path / "made.FCStd", objects, FILES))
    assert any("leads back to itself" in str(note) for note in source.notes)
    assert {name.split("/")[-1] for name in source.names()} == {"Box", "Pin"}
