"""OpenCASCADE's BREP files, text and binary: one shape, without names."""

from __future__ import annotations

import re
from pathlib import Path

from hlr.errors import SourceError
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.occt_import import load_occt, silence_stdout
from hlr.source.cad.parts import Leaf
from hlr.source.cad.source_builder import build_source

_ROOT_RECORD = re.compile(rb"\*\s+[-+ie]\d+ \d+\s*(?:\d+\s*)?\0?\s*$")
"""The end of the last list of sub-shapes, and the root shape: orientation and number, then its location."""


def open_brep(path: Path) -> BrepSource:
    """A BREP file.

    Raises:
        SourceError: not a BREP file, broken, or holding nothing to draw.
    """
    with path.open("rb") as file:
        head = file.read(200)
    binary = b"Open CASCADE Topology V" in head
    if not binary and b"DBRep_DrawableShape" not in head and b"CASCADE Topology V" not in head:
        raise SourceError(f"{path.name} is not a BREP file (it does not begin with its header): check the file.")
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 200))
        # OpenCASCADE's text reader never returns from a file whose last line, the root shape, is missing.
        if not binary and _ROOT_RECORD.search(file.read()) is None:
            raise SourceError(f"{path.name} cannot be read as BREP: it is cut short; export or download it again.")
    load_occt()
    from OCP.BinTools import BinTools
    from OCP.BRep import BRep_Builder
    from OCP.BRepTools import BRepTools
    from OCP.TopoDS import TopoDS_Shape

    shape = TopoDS_Shape()
    try:
        with silence_stdout():
            if binary:
                BinTools.Read_s(shape, str(path))
            else:
                BRepTools.Read_s(shape, str(path), BRep_Builder())
    except Exception as error:  # OpenCASCADE's exceptions derive from Exception alone
        raise SourceError(f"{path.name} cannot be read as BREP ({type(error).__name__}): the file is broken.") from None
    if shape.IsNull():
        raise SourceError(f"{path.name} cannot be read as BREP: the file is broken or incomplete.")
    return build_source(path.name, "brep", [Leaf(shape, path.stem)])
