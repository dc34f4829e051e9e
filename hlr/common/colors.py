"""Colours as people write them: CSS names, #rrggbb, transparent."""

from __future__ import annotations

import re
from typing import Any

from hlr.errors import OptionError, WriteError

Rgb = tuple[int, int, int]
"""sRGB, 0 to 255."""

READABLE = 3.0
"""Least contrast of a line to its background, as WCAG 2 asks of graphics."""

_HEX = re.compile(r"#(?:[0-9a-f]{3}|[0-9a-f]{6})")


def parse_color(text: str) -> tuple[int, int, int, int]:
    """Red, green, blue, opacity, 0 to 255, of a CSS colour name, #rrggbb or transparent; raises OptionError."""
    word = text.strip().lower()
    if word in ("transparent", "none"):
        return (0, 0, 0, 0)
    if _HEX.fullmatch(word):
        return (*rgb_of(word), 255)
    try:
        red, green, blue, opacity = _names().getcolor(word, "RGBA")
        if not all(0 <= channel <= 255 for channel in (red, green, blue, opacity)):
            raise ValueError  # Pillow lets rgb(300,0,0) pass
    except ValueError:
        raise OptionError(f"{text!r} is no colour: give a CSS name such as white, #rrggbb, or transparent") from None
    return (int(red), int(green), int(blue), int(opacity))


def hex_of(rgb: tuple[int, ...]) -> str:
    """#rrggbb."""
    return "#" + "".join(f"{channel:02x}" for channel in rgb[:3])


def rgb_of(color: str) -> Rgb:
    """The channels of #rgb or #rrggbb."""
    digits = color[1:] if len(color) == 7 else "".join(2 * digit for digit in color[1:])
    return (int(digits[:2], 16), int(digits[2:4], 16), int(digits[4:], 16))


def readable(color: str, background: str) -> str:
    """The colour, darkened or lightened until it can be told from the background; both #rrggbb."""
    ground = _luminance(rgb_of(background))
    toward = 255 if is_dark(rgb_of(background)) else 0
    for step in range(21):
        mixed = tuple(round(c + (toward - c) * step / 20) for c in rgb_of(color))
        light = _luminance(mixed)
        if (max(light, ground) + 0.05) / (min(light, ground) + 0.05) >= READABLE:
            return hex_of(mixed)
    return hex_of((toward,) * 3)


def is_dark(rgb: tuple[int, ...]) -> bool:
    """Whether white differs more from the colour than black does."""
    return _luminance(rgb) <= 0.179


def _luminance(rgb: tuple[int, ...]) -> float:
    """Relative luminance, 0 to 1 (WCAG 2)."""
    red, green, blue = (c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in rgb)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def _names() -> Any:
    from importlib import import_module

    try:
        return import_module("PIL.ImageColor")
    except ImportError:
        raise WriteError("names of colours need Pillow: pip install pillow") from None
