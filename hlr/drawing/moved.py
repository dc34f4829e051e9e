"""Lines turned and shifted on paper: views that are put at their places on a page."""

from __future__ import annotations

from dataclasses import replace

from hlr.drawing.curve import Arc, Bezier, Curve
from hlr.drawing.line import Line, Points


def moved(line: Line, matrix: Points, shift: Points, first_part: int) -> Line:
    """A line turned by matrix (2, 2), then shifted by (2,) mm; first_part is added to the numbers of its parts."""
    return replace(
        line,
        part=line.part + first_part,
        other=None if line.other is None else line.other + first_part,
        points=line.points @ matrix.T + shift,
        curve=_moved_curve(line.curve, matrix, shift),
    )


def _moved_curve(curve: Curve | None, matrix: Points, shift: Points) -> Curve | None:
    match curve:
        case Arc():
            return Arc(curve.centre @ matrix.T + shift, curve.axes @ matrix.T, curve.angles)
        case Bezier():
            return Bezier(curve.degree, curve.points @ matrix.T + shift)
    return None
