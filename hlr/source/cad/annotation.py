"""Faces of a STEP file that are no part of the product: what the file hides, and its supplemental geometry.

Arrows, frames and planes of annotation (PMI) come as shells among the solids. They stand under an INVISIBILITY, or in a
CONSTRUCTIVE_GEOMETRY_REPRESENTATION.
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

_WORDS = (b"INVISIBILITY", b"CONSTRUCTIVE_GEOMETRY_REPRESENTATION")

MAX_ENTITY_LOOKUPS = 1000
"""Shells and faces whose entity is looked up, each among all that the file has: the others are taken as drawn."""


def may_contain_annotation(path: Path) -> bool:
    """Whether the file knows of anything hidden or supplemental; most files do not, and are not searched further."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        return any(data.find(word) >= 0 for word in _WORDS)


class AnnotationFilter:
    """Leaves out of a document's products the shells and faces that are hidden or supplemental, solids never."""

    def __init__(self, reader: Any, document: Any) -> None:
        """`reader`: the STEPCAFControl_Reader that has filled the document."""
        from OCP.XCAFDoc import XCAFDoc_DocumentTool

        self._shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
        self._layers = XCAFDoc_DocumentTool.LayerTool_s(document.Main())
        self._supplemental = _supplemental(reader)
        self._asked = 0
        self._known: dict[tuple[str, bool], tuple[Any, int]] = {}

    def without(self, product: Any, instances: list[Any]) -> tuple[Any, int]:
        """The shape of a product without its annotation (None: it is nothing else), and how many faces are left out.

        instances: labels under which it stands here, from the root on; one that is hidden hides the product.
        """
        key = label_entry(product), any(self._is_hidden(label) for label in (product, *instances))
        if key not in self._known:
            self._known[key] = self._split(product, key[1])
        return self._known[key]

    def _split(self, product: Any, whole: bool) -> tuple[Any, int]:
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind

        shape = self._shapes.GetShape_s(product)
        bare = with_location(shape, None)
        loose = [
            *sub_shapes(bare, Kind.TopAbs_SHELL, Kind.TopAbs_SOLID),
            *sub_shapes(bare, Kind.TopAbs_FACE, Kind.TopAbs_SHELL),
        ]
        children = new_collection("labels")
        self._shapes.GetSubShapes_s(product, children)
        labels = [children.Value(i) for i in range(1, children.Length() + 1)] if loose and not whole else []
        hidden = {self._shapes.GetShape_s(label).TShape() for label in labels if self._is_hidden(label)}

        def aside(piece: Any) -> bool:
            if whole or piece.TShape() in hidden:
                return True
            faces = sub_shapes(piece, Kind.TopAbs_FACE)
            return (bool(faces) and all(f.TShape() in hidden for f in faces)) or self._is_supplemental(piece)

        kept = [piece for piece in loose if not aside(piece)]
        if len(kept) == len(loose):
            return shape, 0
        solids = sub_shapes(bare, Kind.TopAbs_SOLID)
        count = sum(len(sub_shapes(piece, Kind.TopAbs_FACE)) for piece in loose)
        count -= sum(len(sub_shapes(piece, Kind.TopAbs_FACE)) for piece in kept)
        if not (solids or kept):
            return None, count
        edges = sub_shapes(bare, Kind.TopAbs_EDGE, Kind.TopAbs_FACE)
        return with_location(make_compound(solids + kept + edges), shape.Location()), count

    def _is_hidden(self, label: Any) -> bool:
        """Whether a label, or a layer that it is on, is invisible."""
        from OCP.XCAFDoc import XCAFDoc_ColorTool

        if not XCAFDoc_ColorTool.IsVisible_s(label):
            return True
        layers = new_collection("labels")
        self._layers.GetLayers(label, layers)
        return any(not self._layers.IsVisible(layers.Value(i)) for i in range(1, layers.Length() + 1))

    def _is_supplemental(self, piece: Any) -> bool:
        if self._supplemental is None or self._asked >= MAX_ENTITY_LOOKUPS:
            return False
        self._asked += 1
        return self._supplemental(piece)


def label_entry(label: Any) -> str:
    """Where a label stands in its document, as "0:1:1:3"."""
    from OCP.TCollection import TCollection_AsciiString
    from OCP.TDF import TDF_Tool

    text = TCollection_AsciiString()
    TDF_Tool.Entry_s(label, text)
    return str(text.ToCString())


def left_out_note(faces: int) -> Note:
    """Says that so many faces were left out."""
    what = f"{counted(faces, 'face')} of annotation, hidden or supplemental in the file, left out"
    return Note("annotation-left-out", f"{what}: --annotations draws them (in Python, annotations=True).")


def _supplemental(reader: Any) -> Callable[[Any], bool] | None:
    """Tells of a shape whether it was made of an item of supplemental geometry; None: there is no such item."""
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

    def made_of(shape: Any) -> bool:
        try:
            entity = transfer.EntityFromShapeResult(shape, 1)  # among all that was read, not only among roots
        except Exception:  # OpenCASCADE's exceptions derive from Exception alone
            return False
        return any(entity is item for item in items)

    faces = [item for item in items if type(item).__name__.endswith(("Shell", "SurfaceModel", "Face", "FaceSet"))]
    return made_of if faces else None
