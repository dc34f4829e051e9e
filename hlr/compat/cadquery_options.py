"""The options of CadQuery's getSVG, with its names and defaults, and their check."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from hlr.compat.viewport import check_number, check_positive, check_vector
from hlr.errors import OptionError

DEFAULT_DIRECTION = (-1.75, 1.1, 5.0)
"""CadQuery's default direction; its picture of the axes is right for this one only."""

FILL_SHARE = 0.75
"""Share of the width or height that the drawing fills at most, where both are given."""

Number = int | float
Color = tuple[Number, Number, Number]


@dataclass(frozen=True, slots=True)
class PictureOptions:
    """Names and defaults are CadQuery's. Lengths are pixels, but strokeWidth, which is in model units."""

    width: float | None = 800.0
    height: float | None = 240.0
    marginLeft: float = 200.0  # noqa: N815
    marginTop: float = 20.0  # noqa: N815
    projectionDir: tuple[float, float, float] = DEFAULT_DIRECTION  # noqa: N815
    showAxes: bool = True  # noqa: N815
    strokeWidth: float = -1.0  # noqa: N815
    strokeColor: Color = (0, 0, 0)  # noqa: N815
    hiddenColor: Color = (160, 160, 160)  # noqa: N815
    showHidden: bool = True  # noqa: N815
    focus: float | None = None
    up: tuple[float, float, float] | None = None

    def unit_scale(self, width: float, height: float) -> float:
        """Pixels per model unit for a drawing of this width and height in model units; at least one is not 0."""
        if self.width is None:
            assert self.height is not None
            ratios = [(self.height - 2.0 * self.marginTop, height)]
        elif self.height is None:
            ratios = [(self.width - 2.0 * self.marginLeft, width)]
        else:
            ratios = [(FILL_SHARE * self.width, width), (FILL_SHARE * self.height, height)]
        return min([pixels / length for pixels, length in ratios if length > 0.0], default=1.0)

    def size(self, width: float, height: float, scale: float) -> tuple[float, float]:
        """Width and height of the picture, for a drawing of this width and height in model units.

        scale: what `unit_scale` gives for it.
        """
        return (
            width * scale + 2.0 * self.marginLeft if self.width is None else self.width,
            height * scale + 2.0 * self.marginTop if self.height is None else self.height,
        )


def check_options(given: Mapping[str, Any]) -> PictureOptions:
    """Options by name; raises OptionError with what is allowed."""
    for key in given:
        if key not in _CHECKS:
            raise OptionError(f"{key!r} is no option of getSVG: use {', '.join(_CHECKS)}")
    values = {key: _CHECKS[key](value, key) for key, value in given.items()}
    options = PictureOptions(**values)
    if options.width is None and options.height is None:
        raise OptionError("width and height are both None: give at least one of them in pixels")
    if options.width is None and options.height is not None and options.height <= 2.0 * options.marginTop:
        raise OptionError(f"a height of {options.height:g} leaves nothing between two margins of {options.marginTop:g}")
    if options.height is None and options.width is not None and options.width <= 2.0 * options.marginLeft:
        raise OptionError(f"a width of {options.width:g} leaves nothing between two margins of {options.marginLeft:g}")
    return options


def _length(value: Any, what: str) -> float | None:
    return None if value is None else check_positive(value, what)


def _focus(value: Any, what: str) -> float | None:
    # As in CadQuery: 0 is none.
    return check_positive(value, what) if value else None


def _up(value: Any, what: str) -> tuple[float, float, float] | None:
    return None if value is None else check_vector(value, what)


def _stroke(value: Any, what: str) -> float:
    number = check_number(value, what)
    if number < 0.0 and number != -1.0:
        raise OptionError(f"{what} needs a width in model units, or -1 for one pixel, not {value!r}")
    return number


def _color(value: Any, what: str) -> Color:
    try:
        red, green, blue = value
        if all(0.0 <= check_number(channel, what) <= 255.0 for channel in (red, green, blue)):
            return (red, green, blue)
    except (TypeError, ValueError, OptionError):
        pass
    raise OptionError(f"{what} needs red, green and blue from 0 to 255, such as (160, 160, 160), not {value!r}")


def _yes_or_no(value: Any, what: str) -> bool:
    try:
        return bool(value)
    except (TypeError, ValueError):
        raise OptionError(f"{what} is yes or no: give True or False, not {value!r}") from None


_CHECKS: dict[str, Callable[[Any, str], Any]] = {
    "width": _length,
    "height": _length,
    "marginLeft": check_number,
    "marginTop": check_number,
    "projectionDir": check_vector,
    "showAxes": _yes_or_no,
    "strokeWidth": _stroke,
    "strokeColor": _color,
    "hiddenColor": _color,
    "showHidden": _yes_or_no,
    "focus": _focus,
    "up": _up,
}
