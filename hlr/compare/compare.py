"""Compare two drawings: read both, register them, and judge what does not match."""

from __future__ import annotations

import math
import os
from dataclasses import replace
from typing import Literal, get_args

import numpy as np

from hlr.compare.comparison import Comparison
from hlr.compare.matching.judge import judged
from hlr.compare.matching.register import translation
from hlr.compare.reading.sides import Side, side_of
from hlr.drawing.drawing import Drawing
from hlr.errors import OptionError

Registration = Literal["off", "translation"]

SMALLEST_TOLERANCE_MM, LARGEST_TOLERANCE_MM = 0.001, 10.0

_MOST_PIECES = 400_000
"""Pieces of both sides together, about, into which long lines are divided."""

_SAME_SCALE = 1e-5
"""Scales that differ by less are the same: files state six digits."""

Compared = Drawing | str | os.PathLike[str]


def compare(a: Compared, b: Compared, *, tolerance_mm: float = 0.1, register: Registration = "off") -> Comparison:
    """What differs from drawing a to drawing b.

    a, b          each a `Drawing`, or the path of an SVG or JSON file of hlr
    tolerance_mm  how far apart on paper two lines may lie that count as the same; 0.001 to 10
    register      "off": as they lie; "translation": b is first moved to where most of its lines match those of a

    Drawings at different scales differ; their lines are compared at the scale of the first.

    Raises SourceError for a file that cannot be read, and OptionError for an option that does not exist.

    >>> import hlr
    >>> old = hlr.draw("part.step", view="top", scale=1)
    >>> hlr.compare.compare(old, old).summary
    'same: 112.6 mm of lines'
    """
    number = isinstance(tolerance_mm, int | float) and not isinstance(tolerance_mm, bool)
    if not number or not SMALLEST_TOLERANCE_MM <= tolerance_mm <= LARGEST_TOLERANCE_MM:
        limits = f"{SMALLEST_TOLERANCE_MM:g} to {LARGEST_TOLERANCE_MM:g}"
        raise OptionError(f"the tolerance is {tolerance_mm!r}: give {limits} millimetres on paper")
    if register not in get_args(Registration):
        raise OptionError(f"register is {register!r}: give {' or '.join(get_args(Registration))}")
    before, after = side_of(a, tolerance_mm), side_of(b, tolerance_mm)
    scales = _scales(before, after)
    if scales is not None:
        after = replace(after, pieces=after.pieces.scaled(scales[0] / scales[1]))
    before, after = _divided(before, after, tolerance_mm)
    shift = None
    if register == "translation":
        shift = translation(after.pieces, before.pieces, tolerance_mm)
        after = replace(after, pieces=after.pieces.shifted(np.array(shift)))
    return Comparison.of(before, after, judged(before, after, tolerance_mm), tolerance_mm, shift, scales)


def _scales(before: Side, after: Side) -> tuple[float, float] | None:
    """The scales of two drawings, where both are known and differ."""
    one, other = before.about.scale, after.about.scale
    if one is None or other is None or math.isclose(one, other, rel_tol=_SAME_SCALE):
        return None
    return one, other


def _divided(before: Side, after: Side, tolerance_mm: float) -> tuple[Side, Side]:
    """Both with long lines in pieces, so that few lie near one another."""
    total = float(before.pieces.lengths.sum() + after.pieces.lengths.sum())
    longest = max(5.0 * tolerance_mm, total / _MOST_PIECES)
    return tuple(replace(side, pieces=side.pieces.divided(longest)) for side in (before, after))  # type: ignore[return-value]
