"""STEP files: products with names, colours and placements, without their annotation."""

from __future__ import annotations

from pathlib import Path

from hlr.source.cad.annotation import may_contain_annotation
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.xcaf import read_document
from hlr.source.file_checks import check_signature


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
    return read_document(path, "step", reader, filter_annotation=not annotations and may_contain_annotation(path))
