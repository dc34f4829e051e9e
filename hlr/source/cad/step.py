"""STEP files: products with names, colours and placements, without their annotation."""

from __future__ import annotations

from pathlib import Path

from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.source.cad.annotation import may_contain_annotation
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.sewing import sewn
from hlr.source.cad.xcaf import read_document
from hlr.source.file_checks import check_signature
from hlr.source.step_references import references

MOST_NAMED = 5
"""Missing files that a message names."""


def open_step(path: Path, annotations: bool = False) -> BrepSource:
    """A STEP file. `annotations`: faces of annotation are read as well.

    Raises:
        SourceError: not a STEP file, broken, empty, or holding nothing to draw.
    """
    check_signature(path, b"ISO-10303-21", "a STEP file (they begin with ISO-10303-21)")
    load_occt()
    from OCP.STEPCAFControl import STEPCAFControl_Reader

    reader = STEPCAFControl_Reader()
    reader.SetGDTMode(False)
    reader.SetMatMode(False)
    reader.SetPropsMode(False)
    reader.SetViewMode(False)
    reader.SetMetaMode(False)
    reader.SetSHUOMode(True)
    missing = [other.name for other in references(path) if not other.is_file()]
    notes = []
    if missing:
        text = (
            f"{path.name} refers to files that are not beside it, and what they hold is not drawn: {_listed(missing)}."
        )
        notes.append(Note("references-missing", text))
    filter_annotation = not annotations and may_contain_annotation(path)
    try:
        return read_document(path, "step", reader, notes, filter_annotation=filter_annotation, repair_leaf=sewn)
    except SourceError as error:
        if not missing:
            raise
        why = str(error).removesuffix(".")
        raise SourceError(
            f"{why}; it refers to files that are not beside it, {_listed(missing)}: put them there."
        ) from None


def _listed(names: list[str]) -> str:
    more = len(names) - MOST_NAMED
    return ", ".join(names[:MOST_NAMED]) + (f" and {more:,} more" if more > 0 else "")
