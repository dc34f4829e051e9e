"""STEP and IGES: products with names, colours and placements, read through OpenCASCADE's document (XCAF)."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hlr.common.types import Color, Rgba
from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.source.cad.annotation import Annotation, entry, may_hold
from hlr.source.cad.annotation import note as left_out
from hlr.source.cad.bindings import collection
from hlr.source.cad.brep import BrepSource
from hlr.source.cad.leaves import source_of
from hlr.source.cad.occt import quiet, ready
from hlr.source.cad.parts import Leaf, explored, located
from hlr.source.files import check_head

_DEPTH = 200
"""Assemblies nest no deeper than this; a file that refers to itself would never end."""


def open_step(path: Path, annotations: bool = False) -> BrepSource:
    """A STEP file; annotations: with its faces of annotation.

    Raises:
        SourceError: not a STEP file, broken, empty, or holding nothing to draw.
    """
    check_head(path, b"ISO-10303-21", "a STEP file (they begin with ISO-10303-21)")
    ready()
    from OCP.STEPCAFControl import STEPCAFControl_Reader

    reader = STEPCAFControl_Reader()
    reader.SetGDTMode(False)
    reader.SetMatMode(False)
    reader.SetPropsMode(False)
    reader.SetViewMode(False)
    reader.SetMetaMode(False)
    return _read(path, "step", reader, annotated=not annotations and may_hold(path))


def open_iges(path: Path) -> BrepSource:
    """An IGES file.

    Raises:
        SourceError: not an IGES file, broken, empty, or holding nothing to draw.
    """
    head = path.open("rb").read(240)
    if len(head) < 80 or head[72:73] not in b"SBC":
        raise SourceError(f"{path.name} is not an IGES file (column 73 of its first line is not S): check the file.")
    ready()
    from OCP.IGESCAFControl import IGESCAFControl_Reader

    notes = []
    if head[72:73] != b"B" and not _is_whole(path):
        text = f"{path.name} is cut short (its last record, T, is missing): some of it may be missing; export it again."
        notes.append(Note("cut-short", text))
    return _read(path, "iges", IGESCAFControl_Reader(), notes)


def _is_whole(path: Path) -> bool:
    """Whether the last record of an IGES file in text is that of its end."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 400))
        return _LAST.search(file.read()) is not None


_LAST = re.compile(rb"T[ 0]*1[\s\x00\x1a]*$")


def _read(path: Path, kind: str, reader: Any, notes: Sequence[Note] = (), annotated: bool = False) -> BrepSource:
    """annotated: there may be annotation, which is left out."""
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    reader.SetNameMode(True)
    reader.SetColorMode(True)
    reader.SetLayerMode(annotated)
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    try:
        with quiet():
            status = reader.ReadFile(str(path))
            read = status == IFSelect_ReturnStatus.IFSelect_RetDone and reader.Transfer(document)
    except Exception as error:  # OpenCASCADE's exceptions derive from Exception alone
        raise SourceError(f"{path.name} cannot be read as {kind.upper()} ({type(error).__name__}).") from None
    if not read:
        raise SourceError(f"{path.name} cannot be read as {kind.upper()}: the file is broken or incomplete.")
    tree = _Tree(XCAFDoc_DocumentTool.ShapeTool_s(document.Main()), XCAFDoc_DocumentTool.ColorTool_s(document.Main()))
    tree.walk(path.stem, Annotation(reader, document) if annotated else None)
    if kind == "iges":
        tree.leaves = [_sewn(leaf) for leaf in tree.leaves]
    if not tree.leaves:
        raise SourceError(f"{path.name} holds no shapes: the assembly is empty, there is nothing to draw.")
    return source_of(path.name, kind, tree.leaves, [*notes, *tree.notes])


class _Tree:
    """The document's assembly tree, flattened."""

    def __init__(self, shapes: Any, colors: Any) -> None:
        self.shapes, self.colors = shapes, colors
        self.leaves: list[Leaf] = []
        self.notes: list[Note] = []
        self._annotation: Annotation | None = None
        self._left_out = 0
        self._details: dict[str, tuple[dict[Any, Color], dict[Any, float]]] = {}

    def walk(self, fallback: str, annotation: Annotation | None = None) -> None:
        """Collect the leaves; annotation: what is left out of them, unless nothing else would be left."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopLoc import TopLoc_Location

        free = collection("labels")
        self.shapes.GetFreeShapes(free)
        self._annotation, self._left_out = annotation, 0
        self.leaves, self.notes = [], []
        for i in range(1, free.Length() + 1):
            self._visit(free.Value(i), TopLoc_Location(), None, fallback, [])
        if not self._left_out:
            return
        if any(explored(leaf.shape, Kind.TopAbs_FACE) for leaf in self.leaves):
            self.notes.append(left_out(self._left_out))
        else:
            self.walk(fallback)

    def _visit(self, label: Any, place: Any, inherited: Rgba | None, fallback: str, above: list[Any]) -> None:
        from OCP.TDF import TDF_Label

        product, color = label, self._color(label)
        if self.shapes.IsReference_s(label):
            product = TDF_Label()
            self.shapes.GetReferredShape_s(label, product)
            place = place.Multiplied(self.shapes.GetLocation_s(label))
        # A colour set on the instance wins over the assembly's, which wins over the product's own.
        color = color or inherited or (self._color(product) if product is not label else None)
        under = [*above, label]
        name = _name(product) or _name(label) or fallback
        if self.shapes.IsAssembly_s(product) and len(above) < _DEPTH:
            children = collection("labels")
            self.shapes.GetComponents_s(product, children)
            for i in range(1, children.Length() + 1):
                self._visit(children.Value(i), place, color, name, under)
            return
        shape = self.shapes.GetShape_s(product)
        if shape is None or shape.IsNull():
            self.notes.append(Note("part-left-out", f'Part "{name}" is empty and was left out.'))
            return
        if self._annotation is not None:
            shape, faces = self._annotation.without(product, under)
            self._left_out += faces
            if shape is None:
                return
        # A free shape carries its own placement; a product's stands in the reference.
        colors, opacities = self._detail(product)
        leaf = Leaf(shape.Moved(place, False), name, colors=colors, opacities=opacities)
        if color is not None:
            leaf.color, leaf.opacity = color[:3], color[3]
        self.leaves.append(leaf)

    def _detail(self, product: Any) -> tuple[dict[Any, Color], dict[Any, float]]:
        """Colours, and opacities below one, of the solids and faces of a product, by underlying shape."""

        key = entry(product)
        known = self._details.get(key)
        if known is None:
            known = self._details[key] = ({}, {})
            children = collection("labels")
            self.shapes.GetSubShapes_s(product, children)
            for i in range(1, children.Length() + 1):
                color = self._color(children.Value(i))
                if color is not None:
                    shape = self.shapes.GetShape_s(children.Value(i)).TShape()
                    known[0][shape] = color[:3]
                    if color[3] < 1.0:
                        known[1][shape] = color[3]
        return known

    def _color(self, label: Any) -> Rgba | None:
        from OCP.Quantity import Quantity_ColorRGBA
        from OCP.XCAFDoc import XCAFDoc_ColorType

        color = Quantity_ColorRGBA()
        for kind in (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen):
            if self.colors.GetColor_s(label, kind, color):
                return (*srgb(color.GetRGB()), round(color.Alpha(), 6))
        return None


SEWING = 5e-6
"""Share of a leaf's diagonal up to which the rims of two loose faces count as one edge."""


def _sewn(leaf: Leaf) -> Leaf:
    """IGES knows faces only, each with rims of its own: joined, they have edges with a face on either side."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    bare = located(leaf.shape, None)
    faces = explored(bare, Kind.TopAbs_FACE)
    if len(faces) < 2 or explored(bare, Kind.TopAbs_SHELL):
        return leaf
    box = Bnd_Box()
    BRepBndLib.Add_s(bare, box)
    sewing = BRepBuilderAPI_Sewing(max(1e-7, SEWING * box.SquareExtent() ** 0.5))
    sewing.Add(bare)
    sewing.Perform()
    sewn = sewing.SewedShape()
    if sewn is None or sewn.IsNull() or len(explored(sewn, Kind.TopAbs_FACE)) != len(faces):
        return leaf
    colors, opacities = {}, {}
    for face in faces:
        key = face.TShape()
        if key in leaf.colors:
            after = sewing.ModifiedSubShape(face) if sewing.IsModifiedSubShape(face) else face
            colors[after.TShape()] = leaf.colors[key]
            if key in leaf.opacities:
                opacities[after.TShape()] = leaf.opacities[key]
    place = leaf.shape.Location()
    return Leaf(sewn.Moved(place, False), leaf.name, leaf.color, colors, leaf.opacity, opacities)


def srgb(color: Any) -> Color:
    """(red, green, blue) from 0 to 1, as screens show them, of a Quantity_Color."""
    from OCP.Quantity import Quantity_TypeOfColor

    red, green, blue = color.Values(Quantity_TypeOfColor.Quantity_TOC_sRGB)
    return round(red, 6), round(green, 6), round(blue, 6)


def _name(label: Any) -> str:
    from OCP.TDataStd import TDataStd_Name

    # FindAttribute alone crashes the interpreter where there is no such attribute.
    if not label.IsAttribute(TDataStd_Name.GetID_s()):
        return ""
    name = TDataStd_Name()
    label.FindAttribute(TDataStd_Name.GetID_s(), name)
    text = " ".join(str(name.Get().ToExtString()).split())
    # What OpenCASCADE's own writers put where nobody gave a name says nothing.
    return "" if text.startswith(("Open CASCADE", "=>[")) or text in _EMPTY_NAMES else text


_EMPTY_NAMES = {"SOLID", "COMPOUND", "COMPSOLID", "SHELL", "FACE", "SHAPE", "ASSEMBLY", "NAUO"}
