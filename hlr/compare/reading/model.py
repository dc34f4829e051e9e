"""A model as a side: it is drawn as the other side shows it."""

from __future__ import annotations

import math
import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hlr.compare.lines.pieces import Pieces
from hlr.compare.matching.match import Rule, divided_by
from hlr.compare.reading.choice import ACCURACY_SHARE, Choice
from hlr.compare.reading.page_of_model import page_of_model
from hlr.compare.reading.sides import Behind, Side, is_drawing, side_of
from hlr.compare.reading.stated_view import as_stated
from hlr.compare.reading.view import Fit, found_view
from hlr.errors import OptionError
from hlr.pipeline.draw import draw_views
from hlr.public.pages import page_names
from hlr.request.options import Options, View
from hlr.source.selection import open_selected
from hlr.tables.entry import listed
from hlr.tables.line_classes import LINE_CLASSES, by_number, optional

if TYPE_CHECKING:
    from hlr.common.types import Progress
    from hlr.source.model import Source

_FINEST = 1e-5
"""Of the size of the other side: a model is drawn no finer, whatever a file says of its size."""

_NICE = 0.01
"""A scale this close to a whole number, or to one over a whole number, is meant to be that."""

_DRAWN = 0.5
"""Share of the lines of one sort that the other drawing has, where it has such lines at all."""


def sides_of(
    a: Any,
    b: Any,
    tolerance_mm: float,
    view: View | None,
    scale: float | None = None,
    choice: Choice | None = None,
    progress: Progress | None = None,
) -> tuple[Side, Side]:
    """Read both sides. A model is drawn in this view, or, where none is said, in the one that the other side shows.

    scale   of a drawing that does not say it itself
    choice  of a model

    Raises SourceError where a side cannot be read, OptionError for a view or a choice where no side is a model, and for
    a scale where no side is a drawing that does not say its own.
    """
    choice = choice or Choice()
    drawn = is_drawing(a), is_drawing(b)
    choice.check_of_models(drawn)
    if view is not None and all(drawn):
        raise OptionError(
            "a view is for a model, and both sides are drawings: leave it out, or name a model in place of one"
        )
    if scale is not None and not (math.isfinite(scale) and scale > 0.0):
        raise OptionError(f"the scale is {scale!r}: give a positive number, paper to model")
    if all(drawn):
        one, other = side_of(a, tolerance_mm), side_of(b, tolerance_mm)
        return _with_scale((one, other), scale)  # type: ignore[return-value]
    if not any(drawn):
        _with_scale((), scale)
        one = side_of_model(a, None, tolerance_mm, view, choice.of(a, b), progress)
        return one, side_of_model(b, None, tolerance_mm, view, choice.of(b, a), progress)
    (other,) = _with_scale((side_of(a if drawn[0] else b, tolerance_mm),), scale)
    model = side_of_model(b if drawn[0] else a, other, tolerance_mm, view, choice, progress)
    return (other, model) if drawn[0] else (model, other)


def _with_scale(sides: tuple[Side, ...], scale: float | None) -> tuple[Side, ...]:
    """The drawings, with this scale where they do not say theirs."""
    if scale is None:
        return sides
    silent = [side.about.scale is None and not side.about.views for side in sides]
    if not any(silent):
        raise OptionError(
            "a scale is for a drawing of another program, which does not say its own, and no side is one: leave it out"
        )
    return tuple(
        replace(side, about=replace(side.about, scale=scale)) if here else side
        for side, here in zip(sides, silent, strict=True)
    )


def side_of_model(
    given: Any,
    other: Side | None,
    tolerance_mm: float,
    view: View | None,
    choice: Choice,
    progress: Progress | None = None,
) -> Side:
    """Draw a model as the other side shows it: its view, its scale, and all classes of line that it may have.

    The view is the one that the other side states, or else the named one that fits its lines best.
    """
    name = Path(given).name if isinstance(given, str | os.PathLike) else None
    if other is not None and (several := len(other.about.views) or other.about.several):
        title = f"{other.title} is a page of {several} views"
        page = other.about.page
        if page is None:
            raise OptionError(f"{title}, {_no_page(given)}")
        if view is not None:
            raise OptionError(f"{title} and says itself how they are seen: leave out the view")
        source = _opened(given, choice, progress)
        wanted = _options(other, tolerance_mm, choice)
        side = page_of_model(source, page, other.pieces, wanted, tolerance_mm, progress)
        return replace(side, title=name or source.name)
    if other is not None and view is None:
        _check_section(other)
    options = _options(other, tolerance_mm, choice)
    source = _opened(given, choice, progress)
    fit = Fit(view or "iso", 1.0)
    stated = other.about.stated if other is not None and view is None else None
    if stated is not None:
        direction, options = as_stated(stated, source.frame, options)
        fit = Fit(direction, 1.0)
    elif other is not None and (view is None or other.about.scale is None):
        fit = found_view(source, options, other, [] if view is None else [view], progress)
    scale = other.about.scale if other is not None and other.about.scale is not None else _nice(fit.scale)
    drawing = draw_views(source, [fit.view], replace(options, scale=scale), progress)[0]
    side = side_of(drawing, tolerance_mm)
    shown = drawing.view.name if stated is None else stated.name
    about = replace(side.about, view_found=shown if view is None else None)
    return replace(
        side, title=f"{name or source.name}, {shown}", about=about, behind=Behind(source, drawing, to_suit=True)
    )


def _opened(given: Any, choice: Choice, progress: Progress | None) -> Source:
    if progress is not None:
        progress("source", 0.0)
    return open_selected(given, choice)


def _check_section(other: Side) -> None:
    """Raise OptionError for a section beside which the whole model would be drawn, though nobody asked for that."""
    if not (other.pieces.kind == LINE_CLASSES["hatch"].number).any():
        return
    if other.about.stated is None or other.about.stated.section is None:
        raise OptionError(
            f"{other.title} is a section and does not say where its plane lies, as DXF and PDF files of several views, "
            "DXF files before R2004 and files of earlier versions do not: draw it anew as SVG or JSON"
        )


def _no_page(given: Any) -> str:
    """What is said of a model beside a page that does not say how it is seen. A document may have pages of its own."""
    names = []
    if isinstance(given, str | os.PathLike) and Path(given).suffix.lower() == ".fcstd":
        names = [f'"{name}"' for name, _ in page_names(given)]
    if names:
        which = f"give `page`: {listed(names, 'or')}"
        return f"and the model of {Path(given).name} is drawn in one: to compare a page of that document, {which}"
    return (
        "and does not say how the model is seen in them, as the SVG and JSON of hlr draw --arrange do: draw it anew as "
        "one of these, or compare it with another page"
    )


def _options(other: Side | None, tolerance_mm: float, choice: Choice) -> Options:
    """What a model is drawn with: whatever the other side has, or may have where it does not say."""
    if other is None:
        return choice.options()
    # A drawing of hlr was drawn with the usual accuracy, if nothing else was asked for.
    finest = _FINEST * float(other.pieces.extent.max())
    accuracy = max(ACCURACY_SHARE * tolerance_mm, finest) if other.about.foreign else None
    kinds, visible = other.pieces.kind, other.pieces.visible
    shown = {row.option: bool(np.isin(kinds, (row.number, -1)).any()) for row in optional() if row.option}
    hidden = bool((visible < 1).any())
    return choice.options(accuracy=accuracy, hidden=hidden, details=other.about.foreign, **shown)


def _nice(scale: float) -> float:
    near = float(round(scale)) if scale >= 1.0 else 1.0 / round(1.0 / scale)
    return near if abs(near / scale - 1.0) < _NICE else float(f"{scale:.6g}")


def without_undrawn(model: Side, other: Side, tolerance_mm: float) -> Side:
    """The side of a model without the sorts of lines that the other drawing has none of: hidden, smooth, seams.

    Only where the other drawing does not say what its lines are: the sorts it has are found by its lines. Any other
    side stays as it is.
    """
    if model.behind is None or not model.behind.to_suit or other.behind is not None or (other.pieces.kind >= 0).all():
        return model
    pieces, left_out = model.pieces, dict(model.about.left_out)
    choice = np.array([row.option is not None and row.occt != "sharp" for row in by_number()])[pieces.kind]
    always = pieces.take(~choice & (pieces.visible == 1))
    sorts = []
    if not (other.pieces.visible == 0).any():  # else it draws hidden lines, and may have left some out by mistake
        sorts.append(("hidden lines", ~choice & (pieces.visible == 0)))
    for row in optional():
        for before, visible in (("", 1), ("hidden ", 0)):
            sorts.append((f"{before}{row.title}", choice & (pieces.kind == row.number) & (pieces.visible == visible)))
    keep = np.ones(len(pieces), bool)
    for title, which in sorts:
        if which.any() and not _has(other.pieces, pieces.take(which), always, tolerance_mm):
            keep &= ~which
            left_out[f"{title}, of which the other drawing has none"] = len(np.unique(pieces.line[which]))
    return replace(model, pieces=pieces.take(keep), about=replace(model.about, left_out=left_out))


def _has(drawn: Pieces, some: Pieces, always: Pieces, tolerance_mm: float) -> bool:
    """Whether a drawing has lines of a sort; those that other lines cover as well say nothing."""
    alone = divided_by(some, always, Rule(tolerance_mm, tolerance_mm))[1]
    if not len(alone):
        return True
    covered = divided_by(alone, drawn, Rule(tolerance_mm, tolerance_mm, ("visible",)))[0]
    return float(covered.lengths.sum()) >= _DRAWN * float(alone.lengths.sum())
