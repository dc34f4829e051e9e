"""BREP files, text and binary: one shape, no names."""

from __future__ import annotations

import re
from pathlib import Path

from hlr.errors import SourceError
from hlr.source.cad.brep import BrepSource
from hlr.source.cad.leaves import source_of
from hlr.source.cad.occt import quiet, ready
from hlr.source.cad.parts import Leaf

_ROOT = re.compile(rb"\*\s+[-+ie]\d+ \d+\s*(?:\d+\s*)?\0?\s*$")
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
        if not binary and _ROOT.search(file.read()) is None:
            raise SourceError(f"{path.name} cannot be read as BREP: it is cut short; export or download it again.")
    ready()
    from OCP.BinTools import BinTools
    from OCP.BRep import BRep_Builder
    from OCP.BRepTools import BRepTools
    from OCP.TopoDS import TopoDS_Shape

    shape = TopoDS_Shape()
    try:
        with quiet():
            if binary:
                BinTools.Read_s(shape, str(path))
            else:
                BRepTools.Read_s(shape, str(path), BRep_Builder())
    except Exception as error:  # OpenCASCADE's exceptions derive from Exception alone
        raise SourceError(f"{path.name} cannot be read as BREP ({type(error).__name__}): the file is broken.") from None
    if shape.IsNull():
        raise SourceError(f"{path.name} cannot be read as BREP: the file is broken or incomplete.")
    return source_of(path.name, "brep", [Leaf(shape, path.stem)])
