"""Line types and the page: ISO 128 widths and dashes, and the frame around the lines."""

from __future__ import annotations

WIDE = 0.5
"""Width of visible lines in millimetres (line group 0.5)."""

NARROW = 0.25
"""Width of hidden lines, tangent edges and seams: half of WIDE."""

DASH = (12.0, 3.0)
"""Dash and gap of hidden lines, in multiples of the line width."""

MARGIN = 5.0
"""Empty border around the drawing in millimetres; the width of a line is added."""

KINDS = ("smooth", "seam", "boundary", "intersection", "sharp", "outline")
"""Line classes in the order of drawing: the narrow ones first, so that wide lines end on top."""


def width(kind: str, visible: bool) -> float:
    """Line width in millimetres."""
    return WIDE if visible and kind not in ("smooth", "seam") else NARROW


def group_width(visible: bool) -> float:
    """Line width in millimetres of most classes: what a group of them states once."""
    return WIDE if visible else NARROW


def dash(kind: str, visible: bool) -> tuple[float, float] | None:
    """Dash and gap in millimetres; None for a continuous line."""
    if visible:
        return None
    wide = width(kind, visible)
    return DASH[0] * wide, DASH[1] * wide
