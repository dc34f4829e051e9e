"""Widths and dashes of lines (ISO 128), and the margin of the page."""

from __future__ import annotations

from hlr.tables.line_classes import NARROW_MM, WIDE_MM, LineClass

MARGIN = 5.0
"""Empty border around the drawing in millimetres; the width of a line is added."""


def width(row: LineClass, visible: bool) -> float:
    """Line width in millimetres."""
    return row.width_mm if visible else row.hidden_width_mm


def group_width(visible: bool) -> float:
    """Line width in millimetres of most classes, which the SVG group of all of them states."""
    return WIDE_MM if visible else NARROW_MM


def dash(row: LineClass, visible: bool) -> tuple[float, float] | None:
    """Dash and gap in millimetres; None for a continuous line."""
    if visible:
        return None
    dash, gap = row.dash
    return dash * row.hidden_width_mm, gap * row.hidden_width_mm
