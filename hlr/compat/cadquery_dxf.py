"""CadQuery's projection as DXF: the visible lines in model units, in the projector's plane."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from hlr.compat import viewport
from hlr.drawing import files
from hlr.drawing.curve import Arc, Curve
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Points
from hlr.errors import OptionError
from hlr.writers.dxf import MILLIMETRES, dxf

MOST_UNITS = 24
"""The last number that DXF has for a unit."""


def exportDXFProjection(
    w: Any, fname: str, projectionDir: Any, *, up: Any = None, doc_units: int = MILLIMETRES
) -> None:
    """The visible lines of a projection as a DXF file, in place of the function of CadQuery's development version.

    Args:
        w: a Workplane or a shape, or whatever else `hlr.draw` takes.
        fname: the file.
        projectionDir: from the model toward the viewer.
        up: what points up in the drawing; None: OpenCASCADE's choice.
        doc_units: the unit that the file names, as DXF counts them; 4 is millimetres. Lengths stay what they are.

    Raises:
        HlrError: it cannot be drawn or written; the message says why.
    """
    if not isinstance(doc_units, int) or not 0 <= doc_units <= MOST_UNITS:
        raise OptionError(f"doc_units needs a number of DXF from 0 to {MOST_UNITS} (4: mm), not {doc_units!r}")
    path = Path(fname)
    files.check_writable(path)
    view = viewport.viewport_along(projectionDir, "projectionDir", up=up)
    picture = viewport.draw_viewport(w, view, hidden=False)
    files.write_all({path: dxf(_moved(picture.drawing, picture.shift), int(doc_units))})


def _moved(drawing: Drawing, shift: Points) -> Drawing:
    """The drawing with all lines moved by a vector (2,)."""
    lines = [
        replace(line, points=line.points + shift, curve=None if line.curve is None else _curve(line.curve, shift))
        for line in drawing.lines
    ]
    return replace(drawing, lines=tuple(lines), fill=None)


def _curve(curve: Curve, shift: Points) -> Curve:
    if isinstance(curve, Arc):
        return replace(curve, centre=curve.centre + shift)
    return replace(curve, points=curve.points + shift)
