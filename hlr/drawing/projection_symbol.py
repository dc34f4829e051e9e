"""The symbol of the method by which the views of a page are arranged (ISO 5456-2): a cut cone in two views.

First-angle has the cone on the left, third-angle on the right; its thin end is on the left in both.
"""

from __future__ import annotations

from hlr.drawing.pens import PenSet
from hlr.tables.sheets import MARGIN

LARGE = 5.0
"""Millimetres: the thick end of the cone, and its length; the thin end is half as thick."""

BEYOND = 1.0
"""Millimetres by which centre lines go beyond what they divide."""


def projection_symbol(method: str, width: float, height: float, pens: PenSet) -> str:
    """The symbol as SVG, in the lower right corner of a page of this width and height, in millimetres."""
    pen = pens.pen("smooth", True)
    y, right = height - 0.5 * MARGIN, width - MARGIN
    middles = (right - 0.5 * LARGE, right - 2.2 * LARGE)
    circles, cone = middles if method == "first-angle" else middles[::-1]
    thin, thick, half = 0.25 * LARGE, 0.5 * LARGE, 0.5 * LARGE
    outline = f"M{cone - half:g} {y - thin:g}L{cone + half:g} {y - thick:g}V{y + thick:g}L{cone - half:g} {y + thin:g}Z"
    reach = half + BEYOND
    centre = f"M{circles - reach:g} {y:g}H{circles + reach:g}M{circles:g} {y - reach:g}V{y + reach:g}"
    centre += f"M{cone - reach:g} {y:g}H{cone + reach:g}"
    return (
        f'<g fill="none" stroke="{pen.solid}" stroke-width="{pen.width:g}">'
        f'<path d="{outline}"/><circle cx="{circles:g}" cy="{y:g}" r="{thick:g}"/>'
        f'<circle cx="{circles:g}" cy="{y:g}" r="{thin:g}"/>'
        f'<path stroke-dasharray="1.5 .5 .5 .5" d="{centre}"/></g>\n'
    )
