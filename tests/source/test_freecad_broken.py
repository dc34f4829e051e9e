"""FreeCAD documents that are broken or hostile: refused, or drawn without what is broken, which is named."""

from __future__ import annotations

import zipfile

import pytest

from hlr.errors import SourceError
from hlr.source import archive, open_source
from hlr.source.freecad import tree
from support import freecad_document as fc
from support.freecad_document import item, kept, links, number, vector, whole, write, xlink

CUBE = {"cube.brp": fc.box(10, 20, 30)}
SHAPE = kept("Part", "cube.brp")


def cube(**values):
    return item("Part::Box", Shape=SHAPE, **values)


def opened(path, objects, files=CUBE):
    return open_source(write(path / "made.FCStd", objects, files))


def texts(source):
    return [str(note) for note in source.notes]


@pytest.mark.parametrize(
    ("objects", "files", "note"),
    [
        ({"Bad": cube()}, {}, '"Bad" was left out: its shape is missing in the document.'),
        ({"Bad": cube()}, {"cube.brp": b"nonsense"}, '"Bad" was left out: its shape is not a BREP file'),
        ({"Bad": cube()}, {"cube.brp": CUBE["cube.brp"][:400]}, '"Bad" was left out: its shape cannot be read as BREP'),
        (
            {"Bad": item("App::Link", LinkedObject=xlink("Box", file="other.FCStd"))},
            {},
            '"Bad" is kept in another document, other.FCStd, and was left out',
        ),
        ({"Bad": item("App::Link", LinkedObject=xlink(""))}, {}, '"Bad" is a link to nothing'),
        ({"Bad": item("App::Link", LinkedObject=xlink("Box", sub="Face1"))}, {}, '"Bad" is a link to a part'),
        (
            {"Bad": item("App::Link", LinkedObject=xlink("Bad"))},
            {},
            '"Bad" leads back to itself',
        ),
        (
            {
                "Part": item("App::Part", Group=links("Bad")),
                "Bad": item("App::Link", LinkedObject=xlink("Part")),
            },
            {},
            '"Bad" leads back to itself',
        ),
        ({"Bad": item("Mesh::Feature", Mesh=kept("Mesh", "m.bms"))}, {}, '"Bad" was left out: its mesh is missing'),
        (
            {"Bad": item("App::Link", LinkedObject=xlink("Box"), ScaleVector=vector(0, 1, 1))},
            CUBE,
            '"Bad" was left out: its shape has no volume at a scale of zero',
        ),
        (
            {"Bad": item("App::Link", LinkedObject=xlink("Box"), Scale=number(1e300))},
            CUBE,
            '"Bad" was left out: its shape is larger than numbers can be at its scale',
        ),
    ],
)
def test_what_cannot_be_drawn_is_named(tmp_path, objects, files, note):
    fine = item("Part::Box", Shape=kept("Part", "fine.brp"))
    files = {"fine.brp": fc.box(1, 1, 1), **files}
    source = opened(tmp_path, {"Fine": fine, "Box": fine, **objects}, files)
    assert "Fine" in source.names()
    assert [each for each in texts(source) if note in each], texts(source)
    assert all(each.is_warning for each in source.notes)


def test_a_document_of_meshes_alone_says_so_without_repeating_itself(tmp_path):
    with pytest.raises(SourceError) as told:
        opened(tmp_path, {"Bad": item("Mesh::Feature", Mesh=kept("Mesh", "m.bms"))}, {})
    assert str(told.value) == (
        'made.FCStd shows no shapes that can be drawn, for "Bad" was left out: its mesh is missing in the document.'
    )


def xml_document(xml, **others):
    return {"Document.xml": xml.encode(), **{name: data for name, data in others.items()}}


ENTITY = '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><Document/>'


@pytest.mark.parametrize(
    ("members", "message"),
    [
        ({"a.txt": b"x"}, "without Document.xml: it is no FreeCAD document"),
        (xml_document(ENTITY), "declares XML entities"),
        (xml_document("<Document>"), "Document.xml is no sound XML"),
        (xml_document("<Document/>"), "holds no shapes"),
        pytest.param(xml_document("<Document/>", x=bytes(65 << 20)), "ZIP bomb", marks=pytest.mark.slow),
        (
            xml_document(
                fc.document_xml({"P": item("App::Part", Group=links("A"), Placement='<P Px="inf"/>'), "A": cube()})
            ),
            "no finite number",
        ),
        (
            xml_document(
                fc.document_xml({"P": item("App::Part", Group=links("A"), Placement='<P Px="x"/>'), "A": cube()})
            ),
            '"x" is no number',
        ),
    ],
)
def test_broken_and_hostile_documents_are_refused(tmp_path, members, message):
    path = tmp_path / "bad.FCStd"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, data in members.items():
            packed.writestr(name, data)
    with pytest.raises(SourceError, match=message):
        open_source(path)


def test_no_zip_archive(tmp_path):
    path = tmp_path / "bad.FCStd"
    path.write_bytes(b"ISO-10303-21;")
    with pytest.raises(SourceError, match=r"is not a FreeCAD document .* it looks like a STEP file"):
        open_source(path)
    path.write_bytes(b"PK\3\4 nothing")
    with pytest.raises(SourceError, match="archive is broken"):
        open_source(path)


def test_a_path_out_of_the_archive_is_never_opened(tmp_path):
    (tmp_path / "secret.brp").write_bytes(CUBE["cube.brp"])
    with pytest.raises(SourceError, match="missing in the document"):
        opened(tmp_path, {"Box": item("Part::Box", Shape=kept("Part", "../secret.brp"))}, {})
    with pytest.raises(SourceError, match="missing in the document"):
        opened(tmp_path, {"Box": item("Part::Box", Shape=kept("Part", str(tmp_path / "secret.brp")))}, {})


def test_arrays_of_arrays_and_endless_xml_have_an_end(tmp_path, monkeypatch):
    monkeypatch.setattr(tree, "MAX_LEAVES", 500)
    row = {"ElementCount": whole(30), "LinkedObject": xlink("Box")}
    objects = {
        "Box": cube(),
        "Row": item("App::Link", **row),
        "Rows": item("App::Link", **{**row, "LinkedObject": xlink("Row")}),
    }
    with pytest.raises(SourceError, match="places more than 500 shapes"):
        opened(tmp_path, objects)
    monkeypatch.setattr(archive, "MAX_ELEMENTS", 20)
    with pytest.raises(SourceError, match="more than 20 elements"):
        opened(tmp_path, objects)
