"""A model beside a page of views by a method of projection: it is drawn in each view as the page states it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import cast

import numpy as np

from hlr.common.types import Progress
from hlr.compare.lines.pieces import Pieces, joined
from hlr.compare.lines.sketch import About, PlacedView, Sketch, StatedView
from hlr.compare.reading.sides import Behind, Side, side_of
from hlr.compare.reading.stated_view import as_stated
from hlr.drawing.drawing import Drawing, DrawnView
from hlr.pipeline.draw import draw_views
from hlr.request.directions import NAMED
from hlr.request.options import Options, View
from hlr.source.model import Source

_ROUNDED = 1e-6
"""How far a direction in a file may be off, of length 1."""


def page_of_model(
    source: Source,
    other: Side,
    options: Callable[[Side], Options],
    tolerance_mm: float,
    progress: Progress | None = None,
) -> Side:
    """The model in the views of the other side, each at its place there.

    options: what a view of that side is drawn with
    """
    names, placed = other.about.views, other.about.placed
    wishes = [
        replace(options(_view_of(other, number)), scale=placed_view.scale) for number, placed_view in enumerate(placed)
    ]
    parts, views, behind = list[str](), list[Pieces](), dict[str, Behind]()
    for number, drawing in enumerate(_drawings(source, placed, wishes, progress)):
        shift = np.array(drawing.origin) - np.array(placed[number].origin)
        pieces = side_of(drawing, tolerance_mm).pieces.shifted(shift)
        # Parts are called by their view on a page.
        views.append(replace(pieces, view=np.full_like(pieces.view, number), part=pieces.part + len(parts)))
        parts += [f"{names[number]}/{part.name}" for part in drawing.parts]
        behind[names[number]] = Behind(source, drawing, shift=shift, to_suit=True)
    about = About(tuple(parts), other.about.scale, names)
    return Side(source.name, joined(views), about, Sketch(), behind_views=behind)


def _view_of(page: Side, number: int) -> Side:
    return replace(page, pieces=page.pieces.take(page.pieces.view == number))


def _drawings(
    source: Source, placed: tuple[PlacedView, ...], wishes: list[Options], progress: Progress | None
) -> list[Drawing]:
    """Each view with its own wishes. Whole views are drawn together, as on the page: all see one mesh of the model."""
    whole = [k for k, each in enumerate(placed) if each.view.section is None and each.view.name in NAMED]
    found: dict[int, Drawing] = {}
    for first in whole:
        if first in found:
            continue
        named = cast("list[View]", [placed[k].view.name for k in whole])
        drawn = draw_views(source, named, wishes[first], progress)
        alike = [(k, drawing) for k, drawing in zip(whole, drawn, strict=True) if wishes[k] == wishes[first]]
        found.update((k, drawing) for k, drawing in alike if _shows(drawing.view, placed[k].view))
    for k, each in enumerate(placed):
        if k not in found:
            direction, options = as_stated(each.view, source.frame, wishes[k])
            (found[k],) = draw_views(source, [direction], options, progress)
    return [found[k] for k in range(len(placed))]


def _shows(drawn: DrawnView, stated: StatedView) -> bool:
    """Whether a drawing by the name of a view shows what is stated."""
    pairs = (drawn.direction, stated.direction), (drawn.up, stated.up)
    return all(np.allclose(own, other, rtol=0.0, atol=_ROUNDED) for own, other in pairs)
