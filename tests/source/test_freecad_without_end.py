"""FreeCAD documents whose groups and links lead to one another without end, and long chains of links."""

from __future__ import annotations

import pytest

from hlr.source import open_source
from hlr.source.freecad import tree
from support import freecad_document as fc
from support.freecad_document import item, kept, links, placement, write, xlink

FILES = {"a.brp": fc.box(10, 20, 30)}
BOX = item("Part::Box", Shape=kept("Part", "a.brp"))


def opened(path, objects):
    return open_source(write(path / "made.FCStd", objects, FILES))


def texts(source):
    return [str(note) for note in source.notes]


def test_folders_that_all_hold_one_another_are_followed_once(tmp_path, monkeypatch):
    monkeypatch.setattr(tree, "MAX_VISITS", 200)
    names = [f"F{i}" for i in range(40)]
    folders = {
        name: item("App::DocumentObjectGroup", Group=links("Box", *(other for other in names if other != name)))
        for name in names
    }
    part = item("App::Part", Group=links(*names))
    source = opened(tmp_path, {"Box": BOX, **folders, "Part": part, "Other": BOX})
    assert [name.split("/")[-1] for name in source.names()] == ["Box", "Other"]
    assert texts(source)[0] == '"F0" leads back to itself and was left out.'
    assert not [text for text in texts(source) if "more than" in text]


@pytest.mark.parametrize("linked", [False, True])
def test_parts_that_all_hold_one_another_are_followed_once(tmp_path, linked):
    names = [f"P{i}" for i in range(40)]
    objects = {"Box": BOX}
    for name in names:
        others = [other for other in names if other != name]
        if linked:
            objects |= {f"{name}-{other}": item("App::Link", LinkedObject=xlink(other)) for other in others}
            others = [f"{name}-{other}" for other in others]
        objects[name] = item("App::Part", Group=links("Box", *others))
    source = opened(tmp_path, objects | {"Top": item("App::Part", Group=links("P0"))})
    of_top = [name for name in source.names() if name.startswith("Top/")]
    assert of_top[:2] == ["Top/P0/Box", f"Top/P0/{'P0-P1' if linked else 'P1'}/Box"] and len(of_top) == 40
    assert any("leads back to itself and was left out" in text for text in texts(source))
    assert not [text for text in texts(source) if "more than" in text]


def test_two_links_of_a_part_to_another_show_it_each(tmp_path):
    objects = {
        "Box": BOX,
        "Inner": item("App::Part", Group=links("Box")),
        "One": item("App::Link", LinkedObject=xlink("Inner")),
        "Two": item("App::Link", LinkedObject=xlink("Inner"), Placement=placement(0, 50, 0)),
        "Part": item("App::Part", Group=links("One", "Two", "Back")),
        "Back": item("App::Link", LinkedObject=xlink("Part")),
    }
    source = opened(tmp_path, objects)
    assert source.names() == ["Inner/Box", "Part/One/Box", "Part/Two/Box"]
    assert texts(source) == ['"Back" leads back to itself and was left out.']


def test_ways_without_number_have_an_end(tmp_path, monkeypatch):
    monkeypatch.setattr(tree, "MAX_VISITS", 500)
    objects = {"Box": BOX, "P30": item("App::Part")}
    for i in range(30):
        objects[f"P{i}"] = item("App::Part", Group=links(f"A{i}", f"B{i}"))
        objects |= {f"{kind}{i}": item("App::Link", LinkedObject=xlink(f"P{i + 1}")) for kind in "AB"}
    source = opened(tmp_path, objects)
    assert source.names() == ["Box"]
    assert texts(source) == ["Groups and links lead to more than 500 objects: those that come later were left out."]


def test_a_long_chain_of_links_is_told_in_one_sentence(tmp_path):
    count = tree.MAX_DEPTH + 6
    chain = {
        f"L{i}": item("App::Link", LinkedObject=xlink(f"L{i + 1}" if i + 1 < count else "Box")) for i in range(count)
    }
    source = opened(tmp_path, {"Box": BOX, **chain})
    assert len(source.names()) == tree.MAX_DEPTH
    what = "7 objects at the end of more than 100 groups and links left out"
    assert texts(source)[0] == f'{what}: "L0", "L1", "L2", "L3", "L4" and others.'


@pytest.mark.parametrize("moved", [False, True])
def test_links_to_one_folder_show_it_each(tmp_path, moved):
    place = {"Placement": placement(0, 50, 0)} if moved else {}
    objects = {
        "Box": BOX,
        "Folder": item("App::DocumentObjectGroup", Group=links("Box")),
        "One": item("App::Link", LinkedObject=xlink("Folder")),
        "Two": item("App::Link", LinkedObject=xlink("Folder"), **place),
        "Part": item("App::Part", Group=links("Folder", "One", "Two")),
    }
    assert opened(tmp_path, objects).names() == ["Part/Folder/Box", "Part/One/Box", "Part/Two/Box"]
