"""Colours of pieces of products in STEP files, against what OpenCASCADE's own viewer gives each face."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from OCP.BRep import BRep_Builder
from OCP.BRepGProp import BRepGProp
from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
from OCP.gp import gp_Pnt, gp_Trsf, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.Quantity import Quantity_Color, Quantity_ColorRGBA, Quantity_TypeOfColor
from OCP.STEPCAFControl import STEPCAFControl_Reader, STEPCAFControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum as Kind
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Compound, TopoDS_Iterator
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_GraphNode
from OCP.XCAFPrs import XCAFPrs

import hlr
from hlr.source.cad.colors import srgb
from hlr.source.cad.occt_collections import new_collection
from hlr.source.cad.shapes import sub_shapes
from hlr.source.cad.step import open_step

try:
    from OCP.collections import IndexedDataMap_TopoDS_Shape_XCAFPrs_Style_TopTools_ShapeMapHasher as StyleMap
except ModuleNotFoundError:
    from OCP.XCAFPrs import XCAFPrs_IndexedDataMapOfShapeStyle as StyleMap

RED, GREEN, BLUE, GLASS = (1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1), (1, 0, 1, 0.5)

FaceColor = tuple[tuple[float, ...], tuple[float, ...] | None]
"""Middle of a face, and its colour."""


def box(x: float = 0.0) -> Any:
    return BRepPrimAPI_MakeBox(gp_Pnt(x, 0, 0), 10, 10, 10).Solid()


def together(*shapes: Any) -> Any:
    whole, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(whole)
    for shape in shapes:
        builder.Add(whole, shape)
    return whole


def shells(shape: Any) -> list[Any]:
    return sub_shapes(shape, Kind.TopAbs_SHELL)


def faces(shape: Any) -> list[Any]:
    return sub_shapes(shape, Kind.TopAbs_FACE)


class Document:
    def __init__(self) -> None:
        self.document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
        self.shapes = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())
        self.colors = XCAFDoc_DocumentTool.ColorTool_s(self.document.Main())

    def paint(self, label: Any, color: tuple[float, ...]) -> None:
        opaque = Quantity_Color(*color[:3], Quantity_TypeOfColor.Quantity_TOC_sRGB)
        self.colors.SetColor(label, Quantity_ColorRGBA(opaque, color[3]), XCAFDoc_ColorType.XCAFDoc_ColorSurf)

    def product(self, shape: Any, *pieces: tuple[Any, tuple[float, ...]], own: Any = None) -> Any:
        label = self.shapes.AddShape(shape, False)
        if own is not None:
            self.paint(label, own)
        for piece, color in pieces:
            self.paint(self.shapes.AddSubShape(label, piece), color)
        return label

    def placed_twice(self, product: Any, color_of_second: tuple[float, ...]) -> None:
        assembly = self.shapes.NewShape()
        self.shapes.AddComponent(assembly, product, TopLoc_Location())
        shift = gp_Trsf()
        shift.SetTranslation(gp_Vec(0, 50, 0))
        self.paint(self.shapes.AddComponent(assembly, product, TopLoc_Location(shift)), color_of_second)
        self.shapes.UpdateAssemblies()

    def deep_place(self, product: Any, color: tuple[float, ...]) -> None:
        """An assembly of two assemblies of two: the first of the second has a colour of its own."""
        places = [TopLoc_Location(), _along_x(30)]
        inner, outer = self.shapes.NewShape(), self.shapes.NewShape()
        parts = [self.shapes.AddComponent(inner, product, place) for place in places]
        halves = [self.shapes.AddComponent(outer, inner, place) for place in [TopLoc_Location(), _along_x(100)]]
        self.shapes.UpdateAssemblies()
        way, nodes = new_collection("labels"), new_collection("attributes")
        way.Append(halves[1])
        way.Append(parts[0])
        assert self.shapes.SetSHUO(way, XCAFDoc_GraphNode())
        self.shapes.GetAllComponentSHUO_s(halves[1], nodes)
        self.paint(nodes.Value(1).Label(), color)

    def write(self, path: Path) -> Path:
        writer = STEPCAFControl_Writer()
        writer.SetColorMode(True)
        writer.Transfer(self.document)
        writer.Write(str(path))
        return path


def _along_x(shift: float) -> TopLoc_Location:
    move = gp_Trsf()
    move.SetTranslation(gp_Vec(shift, 0, 0))
    return TopLoc_Location(move)


def shells_of_their_own(document: Document) -> None:
    whole = together(*shells(box()), *shells(box(20)))
    document.product(whole, (shells(whole)[0], RED), (shells(whole)[1], BLUE))


def one_shell_of_two(document: Document) -> None:
    whole = together(*shells(box()), *shells(box(20)))
    document.product(whole, (shells(whole)[0], RED), (faces(whole)[2], BLUE), own=GREEN)


def glass_shell(document: Document) -> None:
    whole = together(*shells(box()), *shells(box(20)))
    document.product(whole, (shells(whole)[0], GLASS))


def shell_of_a_solid(document: Document) -> None:
    solid = box()
    document.product(solid, (shells(solid)[0], RED))


def shell_of_a_solid_with_a_face(document: Document) -> None:
    whole = together(box(), box(20))
    solid = sub_shapes(whole, Kind.TopAbs_SOLID)[1]
    document.product(whole, (shells(solid)[0], RED), (solid, GREEN), (faces(solid)[3], BLUE))


def shells_placed_twice(document: Document) -> None:
    whole = together(*shells(box()), *shells(box(20)))
    document.placed_twice(document.product(whole, (shells(whole)[0], RED)), BLUE)


def solids_placed_twice(document: Document) -> None:
    solid = box()
    document.placed_twice(document.product(solid, (faces(solid)[1], RED), own=GREEN), BLUE)


def one_place_deep_in_an_assembly(document: Document) -> None:
    document.deep_place(document.product(box(), own=GREEN), RED)


DOCUMENTS = (
    shells_of_their_own,
    one_shell_of_two,
    glass_shell,
    shell_of_a_solid,
    shell_of_a_solid_with_a_face,
    shells_placed_twice,
    solids_placed_twice,
    one_place_deep_in_an_assembly,
)


def middle(face: Any) -> tuple[float, ...]:
    found = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face, found)
    point = found.CentreOfMass()
    return tuple(round(value, 3) + 0.0 for value in (point.X(), point.Y(), point.Z()))


def of_viewer(path: Path) -> Counter[FaceColor]:
    """What OpenCASCADE's viewer shows."""
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    reader = STEPCAFControl_Reader()
    reader.SetColorMode(True)
    reader.SetSHUOMode(True)
    reader.ReadFile(str(path))
    reader.Transfer(document)
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    free = new_collection("labels")
    tool.GetFreeShapes(free)
    found: Counter[FaceColor] = Counter()
    for i in range(1, free.Length() + 1):
        styles = StyleMap()
        XCAFPrs.CollectStyleSettings_s(free.Value(i), TopLoc_Location(), styles)
        _look_up(tool.GetShape_s(free.Value(i)), None, styles, found)
    return found


def _look_up(shape: Any, color: Any, styles: Any, found: Counter[FaceColor]) -> None:
    number = styles.FindIndex(shape)
    if number and styles.FindFromIndex(number).IsSetColorSurf():
        own = styles.FindFromIndex(number).GetColorSurfRGBA()
        color = (*srgb(own.GetRGB()), round(own.Alpha(), 6))
    if shape.ShapeType() == Kind.TopAbs_FACE:
        found[middle(shape), color] += 1
        return
    inside = TopoDS_Iterator(shape)
    while inside.More():
        _look_up(inside.Value(), color, styles, found)
        inside.Next()


def of_source(path: Path) -> Counter[FaceColor]:
    """What the source says."""
    source = open_step(path)
    found: Counter[FaceColor] = Counter()
    for part in source.parts:
        looks, place = part.appearance(), gp_Trsf()
        place.SetValues(*part.transform[:3].ravel().tolist())
        shape = source.prototypes.shapes[part.prototype].Moved(TopLoc_Location(place), False)
        for i, face in enumerate(faces(shape)):
            found[middle(face), looks.faces.get(i, looks.whole)] += 1
    return found


@pytest.mark.parametrize("make", DOCUMENTS)
def test_each_face_has_the_colour_that_a_viewer_shows(tmp_path: Path, make: Callable[[Document], None]) -> None:
    document = Document()
    make(document)
    path = document.write(tmp_path / "painted.step")
    expected = of_viewer(path)
    assert sum(expected.values()) >= 6 and len({color for _, color in expected}) + (make is shell_of_a_solid) > 1
    assert of_source(path) == expected


def test_a_preview_shows_the_colour_of_a_shell(tmp_path: Path) -> None:
    document = Document()
    shells_of_their_own(document)
    path = document.write(tmp_path / "painted.step")
    pixels = hlr.preview(path, view="top", size=(90, 30)).pixels.astype(int)
    left, right = pixels[15, 20], pixels[15, 70]
    assert left[0] > 2 * left[2] and right[2] > 2 * right[0]
