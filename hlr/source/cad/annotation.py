"""Annotation (PMI) in STEP files: faces that are hidden or supplemental, and no part of the product.

Arrows, frames and planes of annotation come as shells among the solids. The file lists them under an INVISIBILITY, or
in a CONSTRUCTIVE_GEOMETRY_REPRESENTATION.
"""

from __future__ import annotations

import mmap
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hlr.drawing.notes import Note
from hlr.errors import counted
from hlr.source.cad.occt_collections import new_collection
from hlr.source.cad.shapes import make_compound, sub_shapes, with_location

_KEYWORDS = (b"INVISIBILITY", b"CONSTRUCTIVE_GEOMETRY_REPRESENTATION")

MAX_ENTITY_LOOKUPS = 1000
"""Shells and faces whose STEP entity is looked up, each among all of the file; any further one is drawn."""


def may_contain_annotation(path: Path) -> bool:
    """Whether the file names hidden or supplemental geometry at all; most files do not."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        return any(data.find(word) >= 0 for word in _KEYWORDS)


class AnnotationFilter:
    """Removes hidden and supplemental shells and faces from the products of a document; solids always stay."""

    def __init__(self, reader: Any, document: Any) -> None:
        """Args: `reader`, the STEPCAFControl_Reader that filled `document`."""
        from OCP.XCAFDoc import XCAFDoc_DocumentTool

        self._shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
        self._layers = XCAFDoc_DocumentTool.LayerTool_s(document.Main())
        self._supplemental = _supplemental(reader)
        self._lookups = 0
        self._results: dict[tuple[str, bool], tuple[Any, int]] = {}

    def filtered(self, product: Any, instances: list[Any]) -> tuple[Any, int]:
        """The shape of a product without annotation, None where nothing else is in it; and how many faces are removed.

        instances: labels of the path to it, from the top of the assembly. A hidden label hides the product.
        """
        key = label_entry(product), any(self._is_hidden(label) for label in (product, *instances))
        if key not in self._results:
            self._results[key] = self._split(product, key[1])
        return self._results[key]

    def _split(self, product: Any, product_hidden: bool) -> tuple[Any, int]:
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind

        shape = self._shapes.GetShape_s(product)
        unplaced = with_location(shape, None)
        loose = [
            *sub_shapes(unplaced, Kind.TopAbs_SHELL, Kind.TopAbs_SOLID),
            *sub_shapes(unplaced, Kind.TopAbs_FACE, Kind.TopAbs_SHELL),
        ]
        children = new_collection("labels")
        self._shapes.GetSubShapes_s(product, children)
        labels = [children.Value(i) for i in range(1, children.Length() + 1)] if loose and not product_hidden else []
        hidden = {self._shapes.GetShape_s(label).TShape() for label in labels if self._is_hidden(label)}

        def is_annotation(piece: Any) -> bool:
            if product_hidden or piece.TShape() in hidden:
                return True
            faces = sub_shapes(piece, Kind.TopAbs_FACE)
            return (bool(faces) and all(f.TShape() in hidden for f in faces)) or self._is_supplemental(piece)

        kept = [piece for piece in loose if not is_annotation(piece)]
        if len(kept) == len(loose):
            return shape, 0
        solids = sub_shapes(unplaced, Kind.TopAbs_SOLID)
        count = sum(len(sub_shapes(piece, Kind.TopAbs_FACE)) for piece in loose)
        count -= sum(len(sub_shapes(piece, Kind.TopAbs_FACE)) for piece in kept)
        if not (solids or kept):
            return None, count
        edges = sub_shapes(unplaced, Kind.TopAbs_EDGE, Kind.TopAbs_FACE)
        return with_location(make_compound(solids + kept + edges), shape.Location()), count

    def _is_hidden(self, label: Any) -> bool:
        """Whether a label or its layer is invisible."""
        from OCP.XCAFDoc import XCAFDoc_ColorTool

        if not XCAFDoc_ColorTool.IsVisible_s(label):
            return True
        layers = new_collection("labels")
        self._layers.GetLayers(label, layers)
        return any(not self._layers.IsVisible(layers.Value(i)) for i in range(1, layers.Length() + 1))

    def _is_supplemental(self, piece: Any) -> bool:
        if self._supplemental is None or self._lookups >= MAX_ENTITY_LOOKUPS:
            return False
        self._lookups += 1
        return self._supplemental(piece)


def label_entry(label: Any) -> str:
    """The path of a label in its document, such as "0:1:1:3"."""
    from OCP.TCollection import TCollection_AsciiString
    from OCP.TDF import TDF_Tool

    text = TCollection_AsciiString()
    TDF_Tool.Entry_s(label, text)
    return str(text.ToCString())


def left_out_note(faces: int) -> Note:
    """The note that this number of faces was left out."""
    what = f"{counted(faces, 'face')} of annotation, hidden or supplemental in the file, left out"
    return Note("annotation-left-out", f"{what}: --annotations draws them (in Python, annotations=True).")


def _supplemental(reader: Any) -> Callable[[Any], bool] | None:
    """A test whether a shape was made from supplemental geometry; None where the file has none."""
    from OCP.StepRepr import StepRepr_ConstructiveGeometryRepresentation
    from OCP.StepShape import StepShape_ShellBasedSurfaceModel

    model = reader.Reader().StepModel()
    items: list[Any] = []
    for i in range(1, model.NbEntities() + 1):
        entity = model.Value(i)
        if isinstance(entity, StepRepr_ConstructiveGeometryRepresentation):
            items += [entity.ItemsValue(k) for k in range(1, entity.NbItems() + 1)]
    for item in [item for item in items if isinstance(item, StepShape_ShellBasedSurfaceModel)]:
        for k in range(1, item.NbSbsmBoundary() + 1):
            shell = item.SbsmBoundaryValue(k)
            items.append(shell.OpenShell() or shell.ClosedShell())
    transfer = reader.Reader().WS().TransferReader()

    def is_made_from_item(shape: Any) -> bool:
        try:
            entity = transfer.EntityFromShapeResult(
                shape, 1
            )  # 1: among all entities, not the roots of the transfer alone
        except Exception:  # OpenCASCADE's exceptions derive from Exception alone
            return False
        return any(entity is item for item in items)

    faces = [item for item in items if type(item).__name__.endswith(("Shell", "SurfaceModel", "Face", "FaceSet"))]
    return is_made_from_item if faces else None
