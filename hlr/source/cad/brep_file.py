"""OpenCASCADE's BREP files, text and binary: one shape, without names.

The kernel reads them. What it does not take is left to OpenCASCADE, which is loaded for that alone.
"""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

from hlr.errors import SourceError
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.kernel_shapes import KernelShape, read_shape, without_opencascade
from hlr.source.cad.occt_import import load_occt, silence_stdout
from hlr.source.cad.parts import Leaf
from hlr.source.cad.source_builder import build_source

_ROOT_RECORD = re.compile(rb"\*\s+[-+ie]\d+ \d+\s*(?:\d+\s*)?\0?\s*$")
"""The end of the last list of sub-shapes, and the root shape: orientation and number, then its location."""


def is_binary(data: bytes) -> bool:
    """Whether the content of a BREP file is binary."""
    return b"Open CASCADE Topology V" in data[:200]


def open_brep(path: Path) -> BrepSource:
    """A BREP file.

    Raises:
        SourceError: not a BREP file, broken, or holding nothing to draw.
    """
    data = path.read_bytes()
    try:
        shape = without_opencascade(lambda opencascade: (read_brep if opencascade else read_lean)(data))
    except ValueError as error:
        raise SourceError(f"{path.name} {error}.") from None
    return build_source(path.name, "brep", [Leaf(shape, path.stem)])


def read_lean(data: bytes) -> KernelShape:
    """The shape of a BREP file's content, text or binary, as the kernel reads it.

    Raises:
        ValueError: it is none, or broken; the message says why, after the file's name.
        NeedsOpenCascadeError: it has what only OpenCASCADE may read.
    """
    _check_ends(data)
    try:
        return read_shape(data)
    except ValueError as error:
        raise ValueError(f"cannot be read as BREP: the file is broken ({error}); export it again") from None


def _check_ends(data: bytes) -> None:
    """Raise ValueError where the first or the last lines of a text are not those of BREP."""
    head = data[:200]
    if is_binary(data):
        return
    if b"DBRep_DrawableShape" not in head and b"CASCADE Topology V" not in head:
        raise ValueError("is not a BREP file (it does not begin with its header): check the file")
    # OpenCASCADE's text reader never returns from a file whose last line, the root shape, is missing.
    if _ROOT_RECORD.search(data[-200:]) is None:
        raise ValueError("cannot be read as BREP: it is cut short; export or download it again")


def read_brep(data: bytes) -> Any:
    """The TopoDS_Shape of a BREP file's content, text or binary.

    Raises:
        ValueError: it is none, or broken; the message says why, after the file's name.
        SourceError: OpenCASCADE is missing.
    """
    _check_ends(data)
    load_occt()
    from OCP.BinTools import BinTools
    from OCP.BRep import BRep_Builder
    from OCP.BRepTools import BRepTools
    from OCP.TopoDS import TopoDS_Shape

    shape = TopoDS_Shape()
    try:
        with silence_stdout():
            if is_binary(data):
                BinTools.Read_s(shape, io.BytesIO(data))
            else:
                BRepTools.Read_s(shape, io.BytesIO(data), BRep_Builder())
    except Exception as error:  # OpenCASCADE's exceptions derive from Exception alone
        raise ValueError(f"cannot be read as BREP ({type(error).__name__}): the file is broken") from None
    if shape.IsNull():
        raise ValueError("cannot be read as BREP: the file is broken or incomplete")
    return shape
