"""What counts as a number in options, manifests and styles, and how messages write numbers."""

from __future__ import annotations

import math
from decimal import Decimal
from numbers import Real
from typing import Any


def is_real(value: Any) -> bool:
    """Whether it is a number that a float can hold; NaN and infinities are. True and False are no numbers."""
    if type(value) is float:
        return True
    if not isinstance(value, Real) or isinstance(value, bool):
        return False
    try:
        float(value)
    except (OverflowError, ValueError):
        return False
    return True


def is_finite(value: Any) -> bool:
    """Whether it is a number that a float can hold, neither NaN nor infinite."""
    return is_real(value) and math.isfinite(value)


def typed(value: float, digits: int = 6, places: int = 9) -> str:
    """A number in a message, as a person would type it: without exponent, and 0 without a sign.

    digits: at most so many that say something; places: at most so many decimals, so what rounding leaves of 0 is 0.
    Numbers of 1e15 and more, which nobody types, have an exponent.
    """
    if not abs(value) < _LONGEST:
        return f"{value:.{digits}g}"
    rounded = float(f"{round(value, places):.{digits}g}") + 0.0
    text = format(Decimal(repr(rounded)), "f")
    return text.rstrip("0").rstrip(".") if "." in text else text


def typed_below(value: float, digits: int) -> str:
    """The same of a limit that is not to be exceeded: rounded toward 0, so that the number that is named is allowed."""
    if not 0.0 < value < _LONGEST:
        return typed(value, digits)
    step = 10.0 ** (math.floor(math.log10(value)) + 1 - digits)
    return typed(math.floor(value / step) * step, digits)


def typed_value(value: Any, between: str = ",") -> str:
    """What an option was given, in a message that refuses it.

    A number, or a tuple or list of numbers, as the command line takes it, with this between them; anything else as
    Python writes it. A number that is not 0 is not shown as 0.
    """
    if isinstance(value, tuple | list) and value and all(map(is_real, value)):
        return between.join(map(typed_value, value))
    if not is_real(value):
        return repr(value)
    number = float(value)
    shown = typed(number, 12, 15)
    return f"{number:g}" if shown == "0" and number else shown


_LONGEST = 1e15
