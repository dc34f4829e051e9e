"""STEP and IGES documents (OpenCASCADE's XCAF): the assembly tree with names, colours and placements, as leaves."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from hlr.common.types import Rgba
from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.source.cad.annotation import AnnotationFilter, label_entry, left_out_note
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.colors import srgb
from hlr.source.cad.loose_faces import JoinedLeaves, is_loose
from hlr.source.cad.occt_collections import new_collection
from hlr.source.cad.occt_import import silence_stdout
from hlr.source.cad.overriding_colors import OverridingColors
from hlr.source.cad.parts import Leaf
from hlr.source.cad.shapes import sub_shapes, with_location
from hlr.source.cad.source_builder import build_source
from hlr.source.cad.sub_shape_colors import SubShapeColors, of_solids_and_faces
from hlr.source.file_checks import without_mark

MAX_DEPTH = 200
"""Levels of an assembly that are followed: a file that refers to itself would have no end."""


def read_document(
    path: Path,
    kind: str,
    reader: Any,
    notes: Sequence[Note] = (),
    *,
    filter_annotation: bool = False,
    repair_leaf: Callable[[Leaf], Leaf] | None = None,
) -> BrepSource:
    """The source that a document reader of OpenCASCADE makes of a file.

    Args:
        path: the file.
        kind: step or iges.
        reader: a STEPCAFControl_Reader or IGESCAFControl_Reader.
        notes: what has been noted already.
        filter_annotation: leave out faces of annotation.
        repair_leaf: applied to each leaf of the assembly.

    Raises:
        SourceError: the file is broken or empty, or holds nothing to draw.
    """
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    reader.SetNameMode(True)
    reader.SetColorMode(True)
    reader.SetLayerMode(filter_annotation)
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    try:
        with silence_stdout():
            if kind == "step" and (data := _marked(path)) is not None:
                status = reader.ReadStream(str(path), io.BytesIO(data))
            else:
                status = reader.ReadFile(str(path))
            read = status == IFSelect_ReturnStatus.IFSelect_RetDone and reader.Transfer(document)
    except Exception as error:  # OpenCASCADE's exceptions derive from Exception alone
        raise SourceError(f"{path.name} cannot be read as {kind.upper()} ({type(error).__name__}).") from None
    if not read:
        raise SourceError(f"{path.name} cannot be read as {kind.upper()}: the file is broken or incomplete.")
    tree = _AssemblyTree(
        XCAFDoc_DocumentTool.ShapeTool_s(document.Main()), XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    )
    tree.walk(path.stem, AnnotationFilter(reader, document) if filter_annotation else None)
    if repair_leaf is not None:
        tree.leaves = _repaired(tree.leaves, repair_leaf)
    if not tree.leaves:
        raise SourceError(f"{path.name} holds no shapes: the assembly is empty, there is nothing to draw.")
    return build_source(path.name, kind, tree.leaves, [*notes, *tree.notes])


def _marked(path: Path) -> bytes | None:
    """The content of a file that begins with a byte order mark, which OpenCASCADE does not take, without it."""
    with path.open("rb") as file:
        if without_mark(head := file.read(8)) == head:
            return None
    return without_mark(path.read_bytes())


def _repaired(leaves: list[Leaf], repair: Callable[[Leaf], Leaf]) -> list[Leaf]:
    """The leaves repaired; those of one product once."""
    known: dict[Any, Leaf] = {}
    made = []
    for leaf in leaves:
        key = leaf.shape.TShape(), leaf.shape.Orientation(), id(leaf.colors)
        if key not in known:
            known[key] = repair(leaf)
        same = known[key]
        placed = with_location(same.shape, None).Moved(leaf.shape.Location(), False)
        made.append(replace(leaf, shape=placed, colors=same.colors, opacities=same.opacities))
    return made


class _AssemblyTree:
    """The assembly tree of a document, flattened into leaves."""

    def __init__(self, shapes: Any, colors: Any) -> None:
        self.shapes, self.colors = shapes, colors
        self.leaves: list[Leaf] = []
        self.notes: list[Note] = []
        self._annotation: AnnotationFilter | None = None
        self._left_out = 0
        # Which leaves are faces without a name, by index: several of one assembly become one leaf.
        self._nameless: set[int] = set()
        self._known_colors: dict[str, SubShapeColors] = {}
        self._joined = JoinedLeaves()
        self._overriding = OverridingColors(shapes, self._color)

    def walk(self, fallback: str, annotation: AnnotationFilter | None = None) -> None:
        """Collect the leaves. annotation: removed from them, unless nothing else would be left."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopLoc import TopLoc_Location

        free = new_collection("labels")
        self.shapes.GetFreeShapes(free)
        self._annotation, self._left_out = annotation, 0
        self.leaves, self.notes, self._nameless = [], [], set()
        for i in range(1, free.Length() + 1):
            self._visit(free.Value(i), TopLoc_Location(), None, fallback, [], ())
        self._join_nameless(0, fallback, (), TopLoc_Location())
        if not self._left_out:
            return
        if any(sub_shapes(leaf.shape, Kind.TopAbs_FACE) for leaf in self.leaves):
            self.notes.append(left_out_note(self._left_out))
        else:
            self.walk(fallback)

    def _visit(
        self,
        label: Any,
        place: Any,
        inherited: Rgba | None,
        fallback: str,
        above: list[Any],
        assemblies: tuple[str, ...],
    ) -> None:
        """Collect the leaves of a label. above: labels on the way to it; assemblies: their names."""
        from OCP.TDF import TDF_Label

        product, path = label, [*above, label]
        color = self._overriding.of(path) or self._color(label)
        if self.shapes.IsReference_s(label):
            product = TDF_Label()
            self.shapes.GetReferredShape_s(label, product)
            place = place.Multiplied(self.shapes.GetLocation_s(label))
        # A colour of this place deep in the assembly wins, then the instance's, the assembly's, the product's own.
        color = color or inherited or (self._color(product) if product is not label else None)
        name = _name(product) or _name(label) or fallback
        if self.shapes.IsAssembly_s(product) and len(above) < MAX_DEPTH:
            children = new_collection("labels")
            self.shapes.GetComponents_s(product, children)
            # The product may be known by its own name, or by that of this place in the assembly.
            names = tuple(dict.fromkeys((*assemblies, *filter(None, (_name(product), _name(label))))))
            before = len(self.leaves)
            for i in range(1, children.Length() + 1):
                self._visit(children.Value(i), place, color, name, path, names)
            self._join_nameless(before, name, assemblies, place)
            if not _is_nameless(product, label):
                self._nameless = {index for index in self._nameless if index < before}
            return
        shape = self.shapes.GetShape_s(product)
        if shape is None or shape.IsNull():
            self.notes.append(Note("part-left-out", f'Part "{name}" is empty and was left out.'))
            return
        if self._annotation is not None:
            shape, faces = self._annotation.filtered(product, path)
            self._left_out += faces
            if shape is None:
                return
        # A free shape has its own placement; that of a product is in the reference to it.
        colors, opacities = self._sub_shape_colors(product)
        # It may be known by the name of this place in the assembly as well.
        of_place = _name(label)
        known = (*assemblies, of_place) if of_place and of_place != name else assemblies
        leaf = Leaf(shape.Moved(place, False), name, colors=colors, opacities=opacities, above=known)
        if color is not None:
            leaf.color, leaf.opacity = color[:3], color[3]
        if _is_nameless(product, label) and is_loose(leaf):
            self._nameless.add(len(self.leaves))
        self.leaves.append(leaf)

    def _join_nameless(self, before: int, name: str, assemblies: tuple[str, ...], place: Any) -> None:
        """Make one leaf, called `name`, of the faces without a name among the leaves behind the first `before`.

        assemblies, place: those that it is in, and where the innermost stands
        """
        found = sorted(index for index in self._nameless if index >= before)
        if len(found) < 2:
            return
        self._nameless.difference_update(found)
        self.leaves[found[0]] = self._joined.as_one([self.leaves[index] for index in found], name, assemblies, place)
        for index in reversed(found[1:]):
            del self.leaves[index]

    def _sub_shape_colors(self, product: Any) -> SubShapeColors:
        """Colours, and opacities below one, of the solids and faces of a product, by TShape."""
        key = label_entry(product)
        if key not in self._known_colors:
            children = new_collection("labels")
            self.shapes.GetSubShapes_s(product, children)
            labels = [children.Value(i) for i in range(1, children.Length() + 1)]
            colored = [(self.shapes.GetShape_s(label), self._color(label)) for label in labels]
            self._known_colors[key] = of_solids_and_faces(colored)
        return self._known_colors[key]

    def _color(self, label: Any) -> Rgba | None:
        from OCP.Quantity import Quantity_ColorRGBA
        from OCP.XCAFDoc import XCAFDoc_ColorType

        color = Quantity_ColorRGBA()
        for kind in (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen):
            if self.colors.GetColor_s(label, kind, color):
                return (*srgb(color.GetRGB()), round(color.Alpha(), 6))
        return None


def _is_nameless(product: Any, label: Any) -> bool:
    """Whether neither a product nor its place has a name. OpenCASCADE's writer numbers places without one."""
    of_place = _name(label)
    return not _name(product) and (not of_place or of_place.isdecimal())


def _name(label: Any) -> str:
    from OCP.TDataStd import TDataStd_Name

    # FindAttribute alone crashes the interpreter where there is no such attribute.
    if not label.IsAttribute(TDataStd_Name.GetID_s()):
        return ""
    name = TDataStd_Name()
    label.FindAttribute(TDataStd_Name.GetID_s(), name)
    text = " ".join(_once_encoded(str(name.Get().ToExtString())).split())
    # OpenCASCADE's own writers give such names to nameless shapes.
    return "" if text.startswith(("Open CASCADE", "=>[")) or text in _GENERIC_NAMES else text


def _once_encoded(text: str) -> str:
    """A name without the second encoding that CadQuery and build123d give it in their STEP files: UTF-8 of UTF-8.

    Where its characters are no bytes of UTF-8 it is a name as it stands: single letters with accents never are.
    """
    try:
        return text.encode("latin-1").decode("utf-8")
    except UnicodeError:
        return text


_GENERIC_NAMES = {"SOLID", "COMPOUND", "COMPSOLID", "SHELL", "FACE", "SHAPE", "ASSEMBLY", "NAUO"}
