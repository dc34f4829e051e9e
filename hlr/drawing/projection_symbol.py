"""The symbol of the method by which the views of a page are arranged (ISO 5456-2): a cut cone in two views.

First-angle has the cone on the left, third-angle on the right; its thin end is on the left in both.
"""

from __future__ import annotations

from hlr.tables.sheets import MARGIN

LARGE = 4.0
"""Millimetres: the thick end of the cone, and its length; the thin end is half as thick."""

BEYOND = 0.5
"""Millimetres by which centre lines go beyond what they divide."""

UP = 6.0
"""Millimetres from the lower side of the page to the middle of the symbol: printers leave the last ones white."""

WIDEST = 0.35
"""Millimetres: the symbol has no wider lines."""

NARROWEST = 50.0
"""Millimetres: a narrower page has no symbol."""


def projection_symbol(method: str, width: float, height: float, color: str, pen_mm: float) -> str:
    """The symbol as SVG, in the lower right corner of a page of this width and height, in millimetres.

    Empty where the page has no room for it.
    """
    if width < NARROWEST:
        return ""
    y, right = height - UP, width - MARGIN
    middles = (right - 0.5 * LARGE, right - 2.2 * LARGE)
    circles, cone = middles if method == "first-angle" else middles[::-1]
    thin, thick, half = 0.25 * LARGE, 0.5 * LARGE, 0.5 * LARGE
    outline = f"M{cone - half:g} {y - thin:g}L{cone + half:g} {y - thick:g}V{y + thick:g}L{cone - half:g} {y + thin:g}Z"
    reach = half + BEYOND
    centre = f"M{circles - reach:g} {y:g}H{circles + reach:g}M{circles:g} {y - reach:g}V{y + reach:g}"
    centre += f"M{cone - reach:g} {y:g}H{cone + reach:g}"
    return (
        f'<g fill="none" stroke="{color}" stroke-width="{min(pen_mm, WIDEST):g}">'
        f'<path d="{outline}"/><circle cx="{circles:g}" cy="{y:g}" r="{thick:g}"/>'
        f'<circle cx="{circles:g}" cy="{y:g}" r="{thin:g}"/>'
        f'<path stroke-dasharray="1.5 .5 .5 .5" d="{centre}"/></g>\n'
    )
