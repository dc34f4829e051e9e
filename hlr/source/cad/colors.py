"""Colours of CAD objects, and of `show_object(shape, options={"color": ..., "alpha": ...})` in scripts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hlr.common.types import Color

ColorOpacity = tuple[Color | None, float]
"""Red, green and blue as screens show them, 0 to 1, or None; and opacity."""


def color_from_options(options: Mapping[str, Any]) -> ColorOpacity:
    """Colour and opacity; what cannot be understood is no colour.

    color: a name, "#rrggbb", a triple or quadruple, or an object of CadQuery or build123d. alpha: transparency, as in
    CQ-editor: 0 is opaque. rgba: red, green, blue and transparency.
    """
    given, alpha = options.get("color"), options.get("alpha")
    if isinstance(rgba := options.get("rgba"), list | tuple) and len(rgba) == 4:
        given, alpha = rgba[:3], rgba[3]
    color, opacity = _color(given)
    if isinstance(alpha, int | float) and 0.0 <= alpha <= 1.0:
        opacity = round(1.0 - alpha, 6)
    return color, opacity


def color_of_wrapper(color: Any) -> ColorOpacity:
    """Colour and opacity of an object of CadQuery or build123d that wraps a Quantity_ColorRGBA."""
    return srgb(color.wrapped.GetRGB()), round(color.wrapped.Alpha(), 6)


def _color(given: Any) -> ColorOpacity:
    if hasattr(given, "wrapped"):
        return color_of_wrapper(given)
    if isinstance(given, str):
        return _named(given)
    if (
        isinstance(given, list | tuple)
        and len(given) in (3, 4)
        and all(isinstance(v, int | float) and 0.0 <= v <= 255.0 for v in given)
    ):
        scale = 255.0 if max(given[:3]) > 1 else 1.0
        red, green, blue = (v / scale for v in given[:3])
        last = given[3] if len(given) == 4 else 1.0
        return (red, green, blue), round(last if last <= 1.0 else last / 255.0, 6)
    return None, 1.0


def _named(text: str) -> ColorOpacity:
    """A CSS colour, else a name of OpenCASCADE's."""
    from PIL import ImageColor

    try:
        found = ImageColor.getrgb(text.strip())
        if not all(0 <= channel <= 255 for channel in found):
            return None, 1.0  # Pillow lets rgb(300,0,0) pass
    except ValueError:
        from OCP.Quantity import Quantity_ColorRGBA

        named = Quantity_ColorRGBA()
        if not Quantity_ColorRGBA.ColorFromName_s(text.strip(), named):
            return None, 1.0
        return srgb(named.GetRGB()), 1.0
    red, green, blue, *opacity = (round(v / 255.0, 6) for v in found)
    return (red, green, blue), (opacity or [1.0])[0]


def srgb(color: Any) -> Color:
    """(red, green, blue) from 0 to 1, as screens show them, of a Quantity_Color."""
    from OCP.Quantity import Quantity_TypeOfColor

    red, green, blue = color.Values(Quantity_TypeOfColor.Quantity_TOC_sRGB)
    return round(red, 6), round(green, 6), round(blue, 6)
