"""Objects of a running FreeCAD: its shapes, the objects of its documents, and whole documents.

Two OpenCASCADEs lie in one process then, FreeCAD's and hlr's. They share nothing: shapes go over as BREP text, and
documents as a copy that FreeCAD saves to a temporary folder.
"""

from __future__ import annotations

import io
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.source.cad.brep_file import read_brep, read_lean
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.kernel_shapes import without_opencascade
from hlr.source.cad.parts import Leaf
from hlr.source.cad.source_builder import build_source
from hlr.source.freecad.fcstd import read_document


def is_freecad(thing: Any) -> bool:
    """Whether `open_freecad` opens it; nothing is imported."""
    if isinstance(thing, list | tuple):
        return len(thing) > 0 and all(is_freecad(item) for item in thing)
    return any(is_a(thing, name) for name in _KINDS)


def is_a(thing: Any, name: str) -> bool:
    """Whether an object is of one of FreeCAD's classes: "Part.Shape"."""
    return any(f"{cls.__module__}.{cls.__name__.rpartition('.')[2]}" == name for cls in type(thing).__mro__)


_KINDS = ("Part.Shape", "App.DocumentObject", "App.Document")


def open_freecad(thing: Any) -> BrepSource:
    """A shape, an object of a document, a document, or a list of shapes and objects.

    An object lies where it lies in its document, and is drawn whether it is shown or not; of what is in it, only what
    is shown. A document is what it shows.

    Raises:
        SourceError: there is nothing to draw.
    """
    items = list(thing) if isinstance(thing, list | tuple) else [thing]
    leaves, notes = without_opencascade(lambda opencascade: _leaves(items, opencascade))
    (first, *others) = items
    name = "part" if others or is_a(first, "Part.Shape") else " ".join(str(first.Label).split()) or "part"
    return build_source(name, "object", leaves, notes)


def _leaves(items: list[Any], opencascade: bool) -> tuple[list[Leaf], list[Note]]:
    leaves = [leaf for item in items if is_a(item, "Part.Shape") for leaf in _of_shape(item, opencascade)]
    notes: list[Note] = []
    documents = [item for item in items if is_a(item, "App.Document")]
    for document, names in _by_document(item for item in items if is_a(item, "App.DocumentObject")):
        _add(document, names, opencascade, leaves, notes)
    for document in documents:
        _add(document, None, opencascade, leaves, notes)
    return leaves, notes


def _of_shape(shape: Any, opencascade: bool) -> list[Leaf]:
    if shape.isNull():
        return []
    try:
        data = shape.exportBrepToString().encode()
        return [Leaf((read_brep if opencascade else read_lean)(data), "part")]
    except ValueError as error:
        raise SourceError(f"The shape {error}.") from None


def _by_document(objects: Iterable[Any]) -> list[tuple[Any, list[str]]]:
    """Documents, and the names of those of their objects that are wanted."""
    found: dict[str, tuple[Any, list[str]]] = {}
    for thing in objects:
        found.setdefault(str(thing.Document.Name), (thing.Document, []))[1].append(str(thing.Name))
    return list(found.values())


def _add(document: Any, names: Sequence[str] | None, opencascade: bool, leaves: list[Leaf], notes: list[Note]) -> None:
    with tempfile.TemporaryDirectory(prefix="hlr-freecad-") as folder:
        path = Path(folder) / f"{document.Name}.FCStd"
        document.saveCopy(str(path))
        more, said = read_document(path, opencascade, only=names)
    leaves += more
    notes += said


def to_freecad(shape: Any) -> Any:
    """A TopoDS_Shape as FreeCAD's Part.Shape."""
    import Part
    from OCP.BRepTools import BRepTools
    from OCP.Message import Message_ProgressRange
    from OCP.TopTools import TopTools_FormatVersion

    # The first version of BREP: that of OpenCASCADE's under any FreeCAD.
    version = TopTools_FormatVersion.TopTools_FormatVersion_VERSION_1
    stream = io.BytesIO()
    BRepTools.Write_s(shape, stream, False, False, version, Message_ProgressRange())
    result = Part.Shape()
    result.importBrepFromString(stream.getvalue().decode())
    return result
