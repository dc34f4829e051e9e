"""B-rep files: names, colours, placements and units; and one sentence for what cannot be read."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

from hlr.errors import SourceError
from hlr.source import open_source
from hlr.tables.readers import endings
from support.brep_shapes import bare_triangles

cq = pytest.importorskip("cadquery")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """One bracket in every B-rep format, and an assembly."""
    from OCP.BinTools import BinTools
    from OCP.IGESControl import IGESControl_Writer

    path = tmp_path_factory.mktemp("brep")
    solid = cq.Workplane().box(30, 20, 10).edges("|Z").fillet(3).val()
    cq.exporters.export(cq.Workplane(obj=solid), str(path / "block.step"))
    cq.exporters.export(cq.Workplane(obj=solid), str(path / "BLOCK.STP"), exportType="STEP")
    cq.exporters.export(cq.Workplane(obj=solid), str(path / "block.brep"), exportType="BREP")
    BinTools.Write_s(solid.wrapped, str(path / "binary.brp"))
    iges = IGESControl_Writer()
    iges.AddShape(solid.wrapped)
    iges.Write(str(path / "block.igs"))
    bolt = cq.Workplane().circle(1).extrude(5)
    inner = cq.Assembly(name="pair").add(bolt, name="bolt", color=cq.Color("red"))
    inner.add(bolt, name="bolt2", loc=cq.Location((4, 0, 0)), color=cq.Color("red"))
    outer = cq.Assembly(name="all").add(inner, name="left").add(inner, name="right", loc=cq.Location((0, 9, 0)))
    outer.add(cq.Workplane().box(1, 1, 1), name="cube", color=cq.Color(0, 0, 1))
    outer.export(str(path / "tree.step"))
    return path


@pytest.mark.parametrize("name", ["block.step", "BLOCK.STP", "block.brep", "binary.brp", "block.igs"])
def test_every_format_holds_the_same_block(folder, name, gaps, volume, classes):
    source = open_source(folder / name)
    assert source.name == name
    assert np.allclose(source.bounds(), [(-15, -10, -5), (15, 10, 5)], atol=0.1)
    (part,) = source.mesh(0.05, 0.2).parts
    assert gaps(part) == 0
    assert abs(volume(part)) == pytest.approx(30 * 20 * 10 - (4 - np.pi) * 9 * 10, rel=0.01)
    assert classes(part) == [16, 8, 0, 0]
    assert source.infos()[0].faces == 10


def test_assembly_names_colours_and_places(folder):
    source = open_source(folder / "tree.step")
    parts = source.mesh(0.05, 0.3).parts
    found = {part.name: (part.color, np.round(part.transform[:3, 3], 6).tolist()) for part in parts}
    assert len(found) == len(parts) == 5
    centres = sorted(np.round((part.points.min(axis=0) + part.points.max(axis=0)) / 2, 3).tolist() for part in parts)
    assert centres == [[0, 0, 0], [0, 0, 2.5], [0, 9, 2.5], [4, 0, 2.5], [4, 9, 2.5]]
    assert sum(color == (1, 0, 0) for color, _ in found.values()) == 4
    assert [color for name, (color, _) in found.items() if name.startswith("cube")] == [(0, 0, 1)]


def test_a_known_assembly(data):
    names = [info.name for info in open_source(data / "as1-oc-214.stp").infos()]
    assert len(names) == len(set(names)) == 18
    assert {name.split(":")[0] for name in names} == {"rod", "nut", "bolt", "l-bracket", "plate"}
    assert sum(name.split(":")[0] == "bolt" for name in names) == 6


def test_inches_become_millimetres(tmp_path):
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    writer = STEPControl_Writer()
    before = Interface_Static.CVal_s("write.step.unit")
    Interface_Static.SetCVal_s("write.step.unit", "INCH")
    try:
        writer.Transfer(cq.Workplane().box(25.4, 25.4, 50.8).val().wrapped, STEPControl_StepModelType.STEPControl_AsIs)
        assert writer.Write(str(tmp_path / "inch.step")) == IFSelect_ReturnStatus.IFSelect_RetDone
    finally:
        Interface_Static.SetCVal_s("write.step.unit", before)
    assert b"INCH" in (tmp_path / "inch.step").read_bytes()
    size = np.ptp(open_source(tmp_path / "inch.step").mesh(0.1, 0.3).parts[0].points, axis=0)
    assert np.allclose(size, (25.4, 25.4, 50.8))


def test_edges_without_faces_are_a_part(tmp_path):
    cq.exporters.export(cq.Workplane().circle(3), str(tmp_path / "ring.brep"), exportType="BREP")
    source = open_source(tmp_path / "ring.brep")
    assert [(info.name, info.faces, info.edges) for info in source.infos()] == [("ring", 0, 1)]
    assert source.notes == []


def test_wires_beside_solids_are_noted(tmp_path):
    cq.Assembly().add(cq.Workplane().box(1, 1, 1), name="cube").add(cq.Workplane().circle(3), name="axis").export(
        str(tmp_path / "mixed.step")
    )
    source = open_source(tmp_path / "mixed.step")
    assert len(source.mesh(0.1, 0.3).parts) == 1
    assert any("without faces (1 edge) left out" in note.text for note in source.notes)


def test_free_edges_of_a_drawn_part_are_a_remark(data, tmp_path):
    """Construction lines and axes: counted and named, and no error where warnings are errors."""
    cube, ring = cq.Workplane().box(1, 1, 1).val(), cq.Workplane().circle(3).val()
    cq.exporters.export(cq.Workplane(obj=cq.Compound.makeCompound([cube, ring])), str(tmp_path / "sketched.brep"))
    source = open_source(tmp_path / "sketched.brep")
    assert len(source.mesh(0.1, 0.3).parts) == 1
    (note,) = source.notes
    assert (note.code, note.is_warning) == ("free-edges-left-out", False)
    assert "sketched" in note.text and "without faces (1 edge)" in note.text
    # A part without free edges has no such note.
    assert open_source(data / "nist_ctc_01_asme1_ap242-e1.stp").notes == []
    # What a caller passes is meant.
    given = open_source([cube, ring])
    assert len(given.infos()) == 2 and given.notes == []


def test_tessellated_shapes_are_meshes(tmp_path, gaps):
    (part,) = open_source(bare_triangles(cq.Workplane().box(1, 2, 3).val().wrapped)).mesh(0.1, 0.3).parts
    assert not part.brep
    assert len(part.points) == 8
    assert gaps(part) == 0


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("empty.step", b"", "is empty"),
        ("page.step", b"<!DOCTYPE html><html>", "a web page"),
        ("pointer.stp", b"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"),
        ("cut.step", b"ISO-10303-21;\nHEADER;\nFILE_DESC", "broken or incomplete"),
        (
            "hollow.step",
            b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n",
            "broken or incomplete",
        ),
        ("text.iges", b"hello\n" * 99, "not an IGES file"),
        ("text.brep", b"hello\n" * 99, "not a BREP file"),
        ("cut.brep", b"DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 1\n", "cut short"),
        ("table.xyz", b"1 2 3", r'has the ending "\.xyz"'),
        ("README", b"1 2 3", "has no ending"),
    ],
)
def test_one_sentence_for_what_cannot_be_read(tmp_path, name, content, sentence):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(SourceError, match=sentence) as caught:
        open_source(tmp_path / name)
    assert name in str(caught.value)
    assert "\n" not in str(caught.value)


def test_paths_that_are_no_files(tmp_path):
    with pytest.raises(SourceError, match="does not exist"):
        open_source(tmp_path / "no.step")
    (tmp_path / "folder.step").mkdir()
    with pytest.raises(SourceError, match="is a folder"):
        open_source(str(tmp_path / "folder.step"))
    with pytest.raises(SourceError):
        open_source("a\0b.step")
    if os.geteuid() != 0:
        (tmp_path / "locked.stl").write_bytes(b"x")
        (tmp_path / "locked.stl").chmod(0)
        with pytest.raises(SourceError, match="permission denied"):
            open_source(tmp_path / "locked.stl")


def test_every_ending_is_dispatched(tmp_path):
    for ending in endings():
        path = tmp_path / f"thing{ending.upper()}"
        path.write_bytes(b"%PDF-1.7 nothing of the kind")
        with pytest.raises(SourceError):
            open_source(path)


@pytest.mark.slow
def test_nothing_is_printed(folder, tmp_path):
    (tmp_path / "cut.brep").write_bytes((folder / "block.brep").read_bytes()[:3000])
    code = (
        "import sys; from hlr.source import open_source\n"
        "for path in sys.argv[1:]:\n"
        "    try: open_source(path).mesh(0.1, 0.3)\n"
        "    except Exception as error: print(type(error).__name__, file=sys.stderr)\n"
    )
    names = [folder / "block.step", folder / "block.igs", folder / "block.brep", tmp_path / "cut.brep"]
    run = subprocess.run(
        [sys.executable, "-P", "-c", code, *map(str, names)], capture_output=True, text=True, check=True, timeout=60
    )
    assert run.stdout == ""
    assert run.stderr.split() == ["SourceError"]


def test_a_missing_system_library_is_named():
    from hlr.source.cad.occt_import import import_failure_message

    cause = ImportError("libGL.so.1: cannot open shared object file: No such file or directory")
    assert "apt-get install libgl1" in import_failure_message(cause)
    assert "pip install cadquery" in import_failure_message(ModuleNotFoundError("No module named 'OCP'"))
