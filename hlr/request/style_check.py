"""Checks of a style: each gives a value in its one form, or raises OptionError that says what is allowed."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Integral
from typing import Any

from hlr.common.colors import hex_of, parse_color
from hlr.common.numbers import is_finite, typed_value
from hlr.errors import OptionError
from hlr.tables.entry import listed

CURRENT = "currentColor"
"""In place of a colour: in SVG the colour of the text around the drawing, elsewhere black."""

WIDTHS = (0.01, 100.0)
"""Least and greatest width of a line, millimetres."""

DASHES = (0.1, 1000.0)
"""Shortest and longest dash or gap, in multiples of the line's width."""

MOST_DPI = 10_000.0
MOST_PIXELS_A_SIDE = 16384
MOST_PIXELS = 100_000_000
"""Of one picture: shaded, it takes 400 MB while it is made, as a drawing in PNG 800 MB."""


def checked_color(name: str, value: Any) -> str | None:
    """The colour of lines in its one form; None stays. Raises OptionError for what is none."""
    if value is None:
        return None
    if isinstance(value, str) and value.strip().lower() == CURRENT.lower():
        return CURRENT
    found = _color(value)
    if found is None:
        raise OptionError(f"`{name}` needs a colour such as black, #1a2b3c or currentColor, not {value!r}")
    return found


def checked_background(value: Any) -> str | None:
    """A colour; None for none and transparent."""
    if value is None or (isinstance(value, str) and value.strip().lower() in ("none", "transparent")):
        return None
    found = _color(value)
    if found is None:
        raise OptionError(f"`background` needs a colour such as white or #1a2b3c, or none, not {value!r}")
    return found


def _color(value: Any) -> str | None:
    """#rrggbb; None for what is no opaque colour."""
    if not isinstance(value, str):
        return None
    try:
        found = parse_color(value)
    except OptionError:
        return None
    return hex_of(found) if found[3] == 255 else None


def checked_width(name: str, value: Any, or_else: str = "") -> float:
    """Millimetres. or_else: what else the error says is allowed."""
    low, high = WIDTHS
    if not is_finite(value) or not low <= value <= high:
        raise OptionError(f"{name} needs millimetres, {low:g} to {high:g}{or_else}, not {value!r}")
    return float(value)


def checked_dash(value: Any) -> tuple[float, float] | tuple[()] | None:
    """Dash and gap, or no dashes; None stays."""
    if value is None:
        return None
    low, high = DASHES
    match list(value) if isinstance(value, Sequence) and not isinstance(value, str) else None:
        case []:
            return ()
        case [dash, gap] if all(is_finite(v) and low <= v <= high for v in (dash, gap)) and dash >= 2 * gap:
            return (float(dash), float(gap))
    raise OptionError(
        "dash needs a dash and a gap in multiples of the line's width, such as [12, 3], the dash at least twice the "
        f"gap, or [] for a continuous line, not {value!r}"
    )


def checked_dpi(value: Any) -> float | None:
    """Pixels per inch; None stays."""
    if value is not None and (not is_finite(value) or not 1.0 <= value <= MOST_DPI):
        raise OptionError(f"`dpi` needs pixels per inch, 1 to {MOST_DPI:g}, not {value!r}")
    return None if value is None else float(value)


def checked_size(value: Any) -> tuple[int, int] | None:
    """Width and height in pixels; None stays."""
    if value is None:
        return None
    match list(value) if isinstance(value, Sequence) and not isinstance(value, str) else None:
        case [wide, high] if all(
            isinstance(v, Integral) and not isinstance(v, bool) and 1 <= int(v) <= MOST_PIXELS_A_SIDE
            for v in (wide, high)
        ):
            return (int(wide), int(high))
    shown = typed_value(value, "x")
    raise OptionError(f"`size` needs a width and height in pixels, each 1 to {MOST_PIXELS_A_SIDE}, not {shown}")


def check_one_of(name: str, value: Any, allowed: tuple[Any, ...]) -> None:
    """Raises OptionError for what is not among the values that are allowed."""
    if not any(value is each or (isinstance(each, str) and value == each) for each in allowed):
        shown = listed((str(each) for each in allowed if each is not None), "or")
        raise OptionError(f"{name} is {shown}, not {value!r}")
