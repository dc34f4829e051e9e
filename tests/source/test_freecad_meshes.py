"""Meshes in FreeCAD documents: where they lie, beside shapes and alone, and files that are broken."""

from __future__ import annotations

import random
import struct
import subprocess
import sys

import numpy as np
import pytest

import hlr
from hlr.errors import SourceError
from hlr.source import open_source
from hlr.source.freecad.kept_mesh import read_mesh
from support import freecad_document as fc
from support.freecad_document import flag, item, kept, links, placement, vector, write, xlink

CORNERS = [(x, y, z) for x in (0.0, 4.0) for y in (0.0, 6.0) for z in (0.0, 8.0)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [three for a, b, c, d in SIDES for three in ((a, b, c), (a, c, d))]


def bms(corners=CORNERS, triangles=TRIANGLES, order="<"):
    """The file of a mesh as FreeCAD writes it: a block of 4 x 6 x 8 mm where nothing else is given."""
    points = b"".join(struct.pack(f"{order}3f", *corner) for corner in corners)
    faces = b"".join(struct.pack(f"{order}6I", *three, 0, 0, 0) for three in triangles)
    head = struct.pack(f"{order}2I", 0xA0B0C0D0, 0x010000) + b"MESH-" * 51 + b"\n"
    counts = struct.pack(f"{order}2I", len(corners), len(triangles))
    return head + counts + points + faces + struct.pack(f"{order}6f", *[0.0] * 6)


def mesh(file="m.bms", **values):
    return item("Mesh::Feature", Mesh=kept("Mesh", file), **values)


def opened(path, objects, files=None, **options):
    given = {"m.bms": bms(), "cube.brp": fc.box(10, 20, 30)} | (files or {})
    return open_source(write(path / "made.FCStd", objects, given), **options)


def box_of(source, name):
    box = source.boxes()[source.names().index(name)]
    return [*box.min(axis=0).round(5).tolist(), *box.max(axis=0).round(5).tolist()]


@pytest.mark.parametrize("order", ["<", ">"])
def test_the_file_is_read_in_either_order_of_bytes(order):
    points, triangles = read_mesh(bms(order=order))
    assert points.tolist() == [list(corner) for corner in CORNERS]
    assert triangles.tolist() == [list(three) for three in TRIANGLES]


def test_a_mesh_lies_where_its_document_places_it(tmp_path):
    source = opened(
        tmp_path,
        {
            "Cube": item("Part::Box", Shape=kept("Part", "cube.brp")),
            "Mesh": mesh(Placement=placement(100, 0, 0, turn=90)),
            "Group": item("App::Part", Group=links("In"), Placement=placement(0, 50, 0)),
            "In": mesh(Placement=placement(0, 0, 7)),
            "Link": item("App::Link", LinkedObject=xlink("Mesh"), LinkPlacement=placement(0, 0, -20)),
            "Large": item("App::Link", LinkedObject=xlink("Mesh"), ScaleVector=vector(2, 2, 2)),
        },
    )
    assert (source.kind, source.names()) == ("mixed", ["Cube", "Mesh", "Group/In", "Link", "Large"])
    assert box_of(source, "Mesh") == [94, 0, 0, 100, 4, 8]
    assert box_of(source, "Group/In") == [0, 50, 7, 4, 56, 15]
    assert box_of(source, "Link") == [0, 0, -20, 4, 6, -12]
    assert box_of(source, "Large") == [0, 0, 0, 8, 12, 16]
    assert source.notes == []


def test_a_mesh_beside_a_shape_is_drawn_and_cut_as_a_shape_is(tmp_path):
    """The block as a mesh, and as a box of the same size in the same place."""
    other = item("Part::Box", Shape=kept("Part", "block.brp"), Placement=placement(3, -6, 5))
    block = mesh(Placement=placement(3, -6, 5))
    cube = item("Part::Box", Shape=kept("Part", "cube.brp"))
    for options in ({"view": "iso", "hidden": True}, {"view": "front", "section": -3.0}):
        inks = []
        for name, thing in (("mesh", block), ("shape", other)):
            folder = tmp_path / f"{name}{options['view']}"
            folder.mkdir()
            files = {"m.bms": bms(), "cube.brp": fc.box(10, 20, 30), "block.brp": fc.box(4, 6, 8, at=(3, -6, 5))}
            document = write(folder / "made.FCStd", {"Cube": cube, "Block": thing}, files)
            drawing = hlr.draw(document, **options)
            assert drawing.notes == ()
            inks.append(
                sorted(
                    (drawing.parts[line.part].name, line.visible, *np.sort(line.points.round(3), axis=0).ravel())
                    for line in drawing.lines
                )
            )
        assert inks[0] == inks[1]


def test_meshes_alone_are_drawn_without_opencascade(tmp_path):
    document = write(tmp_path / "made.FCStd", {"Mesh": mesh()}, {"m.bms": bms()})
    code = (
        "import sys, hlr; drawing = hlr.draw(sys.argv[1], view='iso')\n"
        "print(len(drawing.lines), *sorted({m.split('.')[0] for m in sys.modules} & {'OCP', 'cadquery', 'trimesh'}))"
    )
    run = subprocess.run([sys.executable, "-P", "-c", code, document], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["9"]


def test_colours_and_hidden_meshes(tmp_path):
    look = {"ShapeColor": '<PropertyColor value="4278190335"/>', "Transparency": '<Integer value="50"/>'}
    shown, hidden = (
        item("Mesh::Feature", Mesh=kept("Mesh", "m.bms"), view=look),
        mesh(Visibility=flag(False)),
    )
    source = opened(tmp_path, {"Shown": shown, "Hidden": hidden})
    assert source.names() == ["Shown"]
    assert source.appearances()["Shown"].whole == (1.0, 0.0, 0.0, 0.5)
    assert "1 object that the document hides" in source.notes[0].text
    assert opened(tmp_path, {"Shown": shown, "Hidden": hidden}, hidden_objects=True).names() == ["Shown", "Hidden"]


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"nonsense", "is damaged: it does not begin as a mesh does"),
        (bms()[:264], "is damaged: it does not begin as a mesh does"),
        (bms()[:300], "is damaged: it holds fewer than its 8 points and 12 triangles"),
        (bms()[:264] + struct.pack("<2I", 2**32 - 1, 2**32 - 1), "is damaged: it holds fewer than its 4294967295"),
        (bms(triangles=[(0, 1, 8)]), "is damaged: a triangle has a corner that does not exist"),
    ],
)
def test_a_broken_mesh_is_left_out_and_named(tmp_path, data, why):
    cube = item("Part::Box", Shape=kept("Part", "cube.brp"))
    source = opened(tmp_path, {"Cube": cube, "Bad": mesh()}, {"m.bms": data})
    assert source.names() == ["Cube"]
    assert [note.text for note in source.notes if why in note.text and note.text.startswith('"Bad" was left out')]
    with pytest.raises(SourceError, match=why):
        opened(tmp_path, {"Bad": mesh()}, {"m.bms": data})


def test_a_mesh_without_triangles_is_left_out(tmp_path):
    cube = item("Part::Box", Shape=kept("Part", "cube.brp"))
    source = opened(tmp_path, {"Cube": cube, "Empty": mesh("none.bms")}, {"none.bms": b""})
    assert source.names() == ["Cube"]
    assert any("meshes were left out" in note.text for note in source.notes)


def test_any_bytes_are_a_mesh_or_an_error_in_words():
    draw, whole = random.Random(1), bms()
    for _ in range(2000):
        data = bytearray(whole[: draw.randrange(len(whole) + 1)])
        for _ in range(draw.randrange(4)):
            if data:
                data[draw.randrange(len(data))] = draw.randrange(256)
        try:
            points, triangles = read_mesh(bytes(data))
        except ValueError as error:
            assert "damaged" in str(error)
        else:
            assert points.shape[1] == triangles.shape[1] == 3
            assert len(triangles) == 0 or 0 <= triangles.min() <= triangles.max() < len(points)


def test_a_document_with_meshes_is_not_kept_in_the_cache(tmp_path):
    document = write(tmp_path / "made.FCStd", {"Mesh": mesh()}, {"m.bms": bms()})
    first, second = (open_source(document).reading for _ in range(2))
    assert "not kept in the cache (it holds meshes)" in first or "the cache is off" in first
    assert first.split(" was read")[0] == second.split(" was read")[0]
