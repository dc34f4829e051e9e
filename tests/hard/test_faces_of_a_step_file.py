"""Faces without a solid in STEP files: with borders of their own, in shells of their own, or as products of their own.

They are one surface, which is drawn, cut and hatched as the solid is that they enclose. That is the oracle.
"""

from __future__ import annotations

from pathlib import Path

import cadquery as cq
import pytest
from hard.brep import same
from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.STEPControl import STEPControl_StepModelType as Mode
from OCP.STEPControl import STEPControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDocStd import TDocStd_Document
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

import hlr
from hlr.source.cad.step import open_step
from support.at_size import AT_SIZE
from support.expected import differences, ink


def block() -> cq.Shape:
    return cq.Workplane().box(40, 30, 20).edges("|Z").fillet(5).faces(">Z").workplane().hole(10).val()


def loose(shape: cq.Shape) -> list[cq.Face]:
    """Its faces, each with edges and vertices of its own."""
    return [cq.Face(BRepBuilderAPI_Copy(face.wrapped).Shape()) for face in shape.Faces()]


def shells(shape: cq.Shape) -> list[cq.Shell]:
    return [cq.Shell.makeShell([face]) for face in loose(shape)]


def as_roots(shape: cq.Shape, path: str) -> None:
    """Each face a product without a name."""
    writer = STEPControl_Writer()
    for face in loose(shape):
        writer.Transfer(face.wrapped, Mode.STEPControl_AsIs)
    writer.Write(path)


def as_assembly(shape: cq.Shape, path: str) -> None:
    """An assembly without a name, of faces without a name."""
    writer = STEPControl_Writer()
    writer.Transfer(cq.Compound.makeCompound(loose(shape)).wrapped, Mode.STEPControl_AsIs)
    writer.Write(path)


def as_product(shapes: list[cq.Shape], path: str) -> None:
    """All of them in one product."""
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    tool.AddShape(cq.Compound.makeCompound(shapes).wrapped, False)
    writer = STEPCAFControl_Writer()
    writer.Transfer(document, Mode.STEPControl_AsIs)
    writer.Write(path)


WAYS = {
    "faces": lambda shape, path: as_product(loose(shape), path),
    "shells": lambda shape, path: as_product(shells(shape), path),
    "roots": as_roots,
    "assembly": as_assembly,
}


@pytest.fixture
def path(tmp_path) -> str:
    return str(tmp_path / "faces.step")


@pytest.mark.parametrize("view", ["front", "iso", (1.0, 2.0, -0.5)])
@pytest.mark.parametrize("way", WAYS)
def test_they_are_drawn_as_the_solid(path, way, view):
    WAYS[way](block(), path)
    drawing = hlr.draw(path, view, **AT_SIZE)
    assert [part.name for part in drawing.parts] == ["faces"]
    assert drawing.notes == ()
    same(drawing, hlr.draw(block(), view, **AT_SIZE))


@pytest.mark.parametrize("way", WAYS)
def test_they_are_cut_and_hatched_as_the_solid(path, way):
    WAYS[way](block(), path)
    found = [hlr.draw(each, "front", section=True, **AT_SIZE) for each in (path, block())]
    assert found[0].notes == found[1].notes == ()
    same(*found)
    assert any(line.kind == "hatch" for line in found[0].lines)
    drawn, wanted = (ink(drawing, ["hatch"]) for drawing in found)
    assert not differences(wanted, drawn, 2.0 * max(drawing.accuracy.used for drawing in found))
    assert not differences(drawn, wanted, 2.0 * max(drawing.accuracy.used for drawing in found))


def test_faces_beside_a_solid_are_joined_and_the_solid_stays(path):
    beside = block().moved(cq.Location(cq.Vector(60, 0, 0)))
    as_product([*loose(block()), beside], path)
    drawing = hlr.draw(path, "iso", **AT_SIZE)
    assert [part.name for part in drawing.parts] == ["faces", "faces:loose"]
    assert drawing.notes == ()
    same(drawing, hlr.draw(cq.Compound.makeCompound([beside, block()]), "iso", **AT_SIZE))


def test_an_open_surface_has_borders_where_it_ends_and_nowhere_else(path):
    as_product(loose(block())[:-1], path)
    (note,) = hlr.draw(path, "iso", **AT_SIZE).notes
    assert "it is open, at 2 edges" in note.text


@pytest.mark.parametrize("way", [(10.0, 7.0, 5.0), (60.0, 0.0, 0.0)])
def test_closed_bodies_without_a_name_are_parts(path, way):
    bodies = [block(), block().moved(cq.Location(cq.Vector(*way)))]
    writer = STEPControl_Writer()
    for body in bodies:
        writer.Transfer(body.Shells()[0].wrapped, Mode.STEPControl_AsIs)
    writer.Write(path)
    drawing = hlr.draw(path, "iso", **AT_SIZE)
    assert [part.name for part in drawing.parts] == ["faces", "faces:2"]
    same(drawing, hlr.draw(cq.Compound.makeCompound(bodies), "iso", **AT_SIZE))


def test_faces_with_names_are_parts(path):
    assembly = cq.Assembly(name="surface")
    for number, face in enumerate(loose(block())):
        assembly.add(face, name=f"face {number}")
    assembly.export(path)
    drawing = hlr.draw(path, "iso", **AT_SIZE)
    assert sorted(part.name for part in drawing.parts) == sorted(f"face {number}" for number in range(11))


@pytest.fixture
def sewn_times(monkeypatch) -> list[object]:
    """One entry for each time that faces are sewn."""
    from OCP import BRepBuilderAPI

    asked: list[object] = []

    class Counted(BRepBuilderAPI.BRepBuilderAPI_Sewing):
        def Perform(self, *args):  # noqa: N802
            asked.append(self)
            super().Perform(*args)

    monkeypatch.setattr(BRepBuilderAPI, "BRepBuilderAPI_Sewing", Counted)
    return asked


def test_a_surface_that_is_there_twice_is_joined_once(path, sewn_times):
    whole = cq.Compound.makeCompound(shells(block()))
    assembly = cq.Assembly(name="two")
    for x in (0, 60):
        assembly.add(whole, name=f"at {x}", loc=cq.Location(cq.Vector(x, 0, 0)))
    assembly.export(path)
    source = open_step(Path(path))
    assert len({part.prototype for part in source.parts}) == 1
    assert len(sewn_times) == 1


def test_a_surface_of_products_without_a_name_that_is_there_thrice_is_joined_once(path, sewn_times):
    surface = cq.Compound.makeCompound(loose(block()))
    places = [cq.Location(cq.Vector(60 * k, 5 * k, 0), cq.Vector(1, 2, 3), 20 * k) for k in range(3)]
    writer = STEPControl_Writer()
    whole = cq.Compound.makeCompound([surface.moved(place) for place in places])
    writer.Transfer(whole.wrapped, Mode.STEPControl_AsIs)
    writer.Write(path)
    source = open_step(Path(path))
    assert len(source.parts) == 3
    assert len({part.prototype for part in source.parts}) == 1
    assert len(sewn_times) == 1
    same(
        hlr.draw(path, "iso", **AT_SIZE),
        hlr.draw(cq.Compound.makeCompound([block().moved(place) for place in places]), "iso", **AT_SIZE),
    )


def test_faces_keep_the_colours_of_their_products(path):
    from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor

    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    for number, face in enumerate(loose(block())):
        color = Quantity_Color(0.05 * (number + 1), 0.2, 0.9, Quantity_TypeOfColor.Quantity_TOC_sRGB)
        colors.SetColor(tool.AddShape(face.wrapped, False), color, XCAFDoc_ColorType.XCAFDoc_ColorSurf)
    writer = STEPCAFControl_Writer()
    writer.SetColorMode(True)
    writer.Transfer(document, Mode.STEPControl_AsIs)
    writer.Write(path)
    (look,) = open_step(Path(path)).appearances().values()
    assert [round(20 * look.faces[face][0]) for face in range(11)] == list(range(1, 12))


def test_picture(picture, path):
    as_roots(block(), path)
    picture(hlr.draw(path, "front", section=True, **AT_SIZE))
