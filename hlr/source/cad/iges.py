"""IGES files: faces joined along their borders, for the format knows faces only."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.parts import Leaf
from hlr.source.cad.prototypes import binary_dump
from hlr.source.cad.sewing import sewn, with_shape
from hlr.source.cad.shapes import sub_shapes, with_location
from hlr.source.cad.xcaf import read_document
from hlr.source.file_checks import without_mark, wrong_format


def open_iges(path: Path) -> BrepSource:
    """An IGES file.

    Raises:
        SourceError: not an IGES file, broken, empty, or holding nothing to draw.
    """
    head = path.open("rb").read(240)
    if without_mark(head) != head:
        why = "a text editor has put a byte order mark before its first line"
        raise SourceError(f"{path.name} cannot be read as IGES: {why}; save it without one, or export it again.")
    if len(head) < 80 or head[72:73] not in b"SBC":
        raise wrong_format(path, "an IGES file (column 73 of its first line is not S)", head)
    load_occt()
    from OCP.IGESCAFControl import IGESCAFControl_Reader

    notes = []
    if head[72:73] != b"B" and not _has_last_record(path):
        text = f"{path.name} is cut short (its last record, T, is missing): some of it may be missing; export it again."
        notes.append(Note("cut-short", text))
    return read_document(path, "iges", IGESCAFControl_Reader(), notes, repair_leaf=_repaired)


def _has_last_record(path: Path) -> bool:
    """Whether an IGES file in text ends with its terminate record, T."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 400))
        return _LAST_RECORD.search(file.read()) is not None


_LAST_RECORD = re.compile(rb"T[ 0]*1[\s\x00\x1a]*$")


def _repaired(leaf: Leaf) -> Leaf:
    # In this order: a face that is rebuilt has edges of its own, which sewing joins with those of its neighbours.
    return sewn(_without_mirrors(leaf))


def _without_mirrors(leaf: Leaf) -> Leaf:
    """The leaf with faces of their own where some are placed as mirror images.

    OpenCASCADE takes such a face for turned the other way than the faces beside it, so that the body is no solid.
    """
    from OCP.BRepTools import BRepTools_PurgeLocations
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    shape = with_location(leaf.shape, None)
    faces = sub_shapes(shape, Kind.TopAbs_FACE)
    if not any(face.Location().Transformation().VectorialPart().Determinant() < 0.0 for face in faces):
        return leaf
    # The reader makes matrices that mirror and do not say so; read once more, they do.
    again = _read_again(shape)
    purge = BRepTools_PurgeLocations()
    if not purge.Perform(again):
        return leaf
    copies = [face.TShape() for face in faces], sub_shapes(again, Kind.TopAbs_FACE)
    copy_of = dict(zip(*copies, strict=True))
    return with_shape(leaf, purge.GetResult(), faces, lambda face: purge.ModifiedShape(copy_of[face.TShape()]))


def _read_again(shape: Any) -> Any:
    """The shape as OpenCASCADE writes and reads it."""
    from OCP.BinTools import BinTools
    from OCP.TopoDS import TopoDS_Iterator, TopoDS_Shape

    whole = TopoDS_Shape()
    BinTools.Read_s(whole, io.BytesIO(binary_dump([shape])))
    return TopoDS_Iterator(whole).Value()
