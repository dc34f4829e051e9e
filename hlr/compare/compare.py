"""Compare two drawings: read both, register them, and judge what does not match."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, Unpack, get_args

import numpy as np

from hlr.common.keywords import record_of, shown
from hlr.common.numbers import typed
from hlr.compare.comparison import Comparison
from hlr.compare.lines.motion import Motion
from hlr.compare.matching.hatched_areas import without_hatches
from hlr.compare.matching.judge import judged
from hlr.compare.matching.pairing import of_one_view
from hlr.compare.matching.register import translation
from hlr.compare.matching.similarity import laid_share, similarity
from hlr.compare.matching.views import by_view
from hlr.compare.reading.choice import Choice
from hlr.compare.reading.document import with_pages
from hlr.compare.reading.model import sides_of, without_undrawn
from hlr.compare.reading.sides import Side
from hlr.compare.verdict.verdicts import with_verdicts
from hlr.errors import OptionError
from hlr.request.defaults import COMPARE_TOLERANCE_MM
from hlr.request.options import Chosen, View

if TYPE_CHECKING:
    from hlr.common.types import Progress

Registration = Literal["auto", "off", "translation", "similarity"]

SMALLEST_TOLERANCE_MM, LARGEST_TOLERANCE_MM = 0.001, 10.0

_MOST_PIECES = 400_000
"""Pieces of both sides together, about, into which long lines are divided."""

_SAME_SCALE = 1e-5
"""Scales that differ by less are the same: files state six digits."""

_ENLARGED = 1.2
"""A drawing that becomes so many times larger is read once more, with shorter chords."""

ENOUGH_LAID = 0.3
"""Share of the lines of both that have to lie on one another, else rays would judge lines in the wrong place."""


@shown(Choice)
def compare(
    a: Any,
    b: Any,
    *,
    tolerance_mm: float = COMPARE_TOLERANCE_MM,
    register: Registration = "auto",
    page: str | None = None,
    view: View | None = None,
    scale: float | None = None,
    progress: Progress | None = None,
    **choice: Unpack[Chosen],
) -> Comparison:
    """What differs from drawing a to drawing b.

    a, b          each a `Drawing`, or the path of an SVG, PDF, DXF or JSON file of hlr, or of an SVG, PDF or DXF of
                  another program; or a model, as anything that `hlr.draw` takes
    tolerance_mm  how far apart on paper two lines may lie that count as the same; 0.001 to 10
    register      "off": as they lie; "translation": b is first moved to where most of its lines match those of a;
                  "similarity": it is turned by quarters, mirrored and scaled as well; "auto": "off" for two drawings
                  of hlr, unless one is a page and the other a view of it by itself, else "similarity"
    page          name or label of the page of a FreeCAD document (.FCStd) that is a or b; "Page/View": one view of it
    view          of the model, as of `hlr.draw`; None: the view that the other side states, or else the named one that
                  it shows, which is found
    scale         paper to model, of the drawing of another program; None: it is found
    progress      called with the name of each stage and the fraction done, 0 to 1
    choice        only, hide, var, parameters, annotations, hidden_objects: of the model that is a or b, or of both, as
                  of `hlr.draw`. Where one of two models is a script, var and parameters are for that

    A model is drawn at the scale of the other side, with the lines that it has, hidden or smooth ones for example.
    Pages are compared view by view; unless register is "off", each view is moved onto that of the other page.
    Drawings of hlr at different scales differ; their lines are compared at the scale of the first. What a file does not
    say of its lines, such as which of them are hidden, agrees with everything.

    Raises SourceError for a file that cannot be read, and OptionError for an option that does not exist.

    >>> import hlr
    >>> old = hlr.draw("part.step", view="top", scale=1)
    >>> hlr.compare.compare(old, old).summary
    'same: 112.6 mm of lines'
    """
    number = isinstance(tolerance_mm, int | float) and not isinstance(tolerance_mm, bool)
    if not number or not SMALLEST_TOLERANCE_MM <= tolerance_mm <= LARGEST_TOLERANCE_MM:
        limits = f"{SMALLEST_TOLERANCE_MM:g} to {LARGEST_TOLERANCE_MM:g}"
        shown_mm = typed(tolerance_mm) if number else repr(tolerance_mm)
        raise OptionError(f"the tolerance is {shown_mm}: give {limits} millimetres on paper")
    if register not in get_args(Registration):
        raise OptionError(f"register is {register!r}: give {' or '.join(get_args(Registration))}")
    chosen = record_of(Choice, choice, "compare")
    a, b = with_pages((a, b), page, tolerance_mm, chosen, progress)
    before, after = sides_of(a, b, tolerance_mm, view, scale, chosen, progress)
    if progress is not None:
        progress("compare", 0.0)
    scales = _scales(before, after)
    if scales is not None:
        after = replace(after, pieces=after.pieces.mapped(np.eye(2) * (scales[0] / scales[1])))
    before, after = _divided(before, after, tolerance_mm)
    pages = len(before.about.views), len(after.about.views)
    before, after = of_one_view(before, after, tolerance_mm)
    if register == "auto":
        # A view by itself has no place on a page.
        by_itself = (len(before.about.views), len(after.about.views)) != pages
        register = "similarity" if by_itself or before.about.foreign or after.about.foreign else "off"
    if before.about.views or after.about.views:
        moving = register != "off" or scales is not None
        findings, after, views = by_view(before, after, tolerance_mm, moving)
        return Comparison.of(before, after, findings, tolerance_mm, views=views, scales=scales)
    motion = None if register == "off" else _motion(before, after, tolerance_mm, register)
    if motion is not None and motion.scale > _ENLARGED:  # its chords would be seen
        pieces = after.sketch.pieces(tolerance_mm / motion.scale, after.title)
        after = _divided(before, replace(after, pieces=pieces), tolerance_mm)[1]
        motion = _motion(before, after, tolerance_mm, register)
    if motion is not None:
        after = replace(after, pieces=motion.applied(after.pieces))
    shown = before.pieces, after.pieces
    before, after = without_undrawn(before, after, tolerance_mm), without_undrawn(after, before, tolerance_mm)
    findings, laid = judged(before, after, tolerance_mm), None
    if motion is not None and (before.about.foreign or after.about.foreign):
        laid = laid_share(before.pieces, after.pieces, tolerance_mm)
    if laid is None or laid >= ENOUGH_LAID:
        findings, laid = with_verdicts(findings, before, after, motion, tolerance_mm, shown), None
    return Comparison.of(before, after, findings, tolerance_mm, motion=motion, scales=scales, badly_laid=laid)


def _motion(before: Side, after: Side, tolerance_mm: float, register: Registration) -> Motion:
    """How the second drawing has to be moved to lie on the first."""
    moving, fixed = without_hatches(after.pieces, before.pieces)
    if register == "translation":
        found = Motion().with_shift(translation(moving, fixed, tolerance_mm)[0])
    else:
        known = before.about.scale is not None and after.about.scale is not None
        found = similarity(moving, fixed, tolerance_mm, 1.0 if known else None).motion
    x, y = found.shift
    return replace(found, shift=(round(x, 4) + 0.0, round(y, 4) + 0.0))


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
