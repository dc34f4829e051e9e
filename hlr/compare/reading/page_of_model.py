"""A model beside a page of views by a method of projection: the page is drawn anew, with the same views."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from hlr.common.types import Progress
from hlr.compare.lines.pieces import Pieces, joined
from hlr.compare.lines.sketch import PlacedView, StatedPage
from hlr.compare.reading.sides import Behind, Side, side_of
from hlr.compare.reading.stated_view import as_stated
from hlr.drawing.drawing import Drawing, DrawnView
from hlr.drawing.sheet import SheetView
from hlr.errors import ViewError
from hlr.public.arranged import Method, draw_arranged
from hlr.request.directions import NAMED, normalized, pictorial
from hlr.request.options import Options
from hlr.source.model import Source
from hlr.tables.line_classes import LINE_CLASSES

_ROUNDED = 1e-6
"""How far a direction in a file may be off, of length 1."""


def page_of_model(
    source: Source,
    page: StatedPage,
    lines: Pieces,
    options: Options,
    tolerance_mm: float,
    progress: Progress | None = None,
) -> Side:
    """The model on a page like that of the other side, each view where it lies there.

    lines: of the other side; options: with all classes of lines that it has
    """
    drawing = _drawn(source, page, _as_views_have(options, page, lines), progress)
    assert drawing.sheet is not None
    side, views, behind = side_of(drawing, tolerance_mm), [], {}
    origins = {each.name: np.array(each.origin) for each in page.views}
    for number, view in enumerate(drawing.sheet.views):
        pieces, own = side.pieces.take(side.pieces.view == number), np.array(view.origin)
        shift = own - origins.get(view.name, own)
        views.append(pieces.shifted(shift))
        if view.section is None:
            behind[view.name] = Behind(source, _alone(drawing, view), shift=shift, to_suit=True)
    return replace(side, title=source.name, pieces=joined(views), behind_views=behind)


def _drawn(source: Source, page: StatedPage, options: Options, progress: Progress | None) -> Drawing:
    """The page drawn anew: the same views and sections, in the same order, at the same scale."""
    views: list[Any] = []
    cuts, whole = list[tuple[str, Any, Any]](), list[Any]()
    for each in page.views:
        direction, wishes = as_stated(each.view, source.frame, options)
        view = _asked(each, direction)
        if view not in views:
            views.append(view)
        if each.view.section is not None:
            cuts.append((each.letter, view, wishes.section))
        else:
            whole.append(view)
    # Letters are in the order in which sections were asked for.
    cuts.sort(key=lambda cut: (len(cut[0]), cut[0]))
    sections = [(view, place) for _, view, place in cuts]
    besides = tuple(view for view in whole if any(cut == view for cut, _ in sections))
    wanted = replace(options, page=page.size, section=sections or None, whole=besides)
    method = cast(Method, page.method)
    # Most pages have the scale that suits them, and are laid out in another way where it is asked for.
    found = draw_arranged(source, method, views, wanted, progress)
    scale = page.views[0].scale
    return (
        found if found.scale == scale else draw_arranged(source, method, views, replace(wanted, scale=scale), progress)
    )


def _asked(each: PlacedView, direction: Any) -> Any:
    """The view as it was asked for: its name, which a further section has with its letter, or its direction."""
    name = each.view.name.removesuffix(f"-{each.letter}") if each.letter else each.view.name
    if name in NAMED:
        return name
    with suppress(ValueError, ViewError):
        numbers = tuple(map(float, name.split(",")))
        if len(numbers) == len(direction) and np.allclose(normalized(numbers, name), direction, atol=_ROUNDED):
            return numbers
    return direction


def _as_views_have(options: Options, page: StatedPage, lines: Pieces) -> Options:
    """The options; hidden lines and smooth edges are left to what is usual where only such views have them."""
    slanted = [k for k, each in enumerate(page.views) if pictorial(each.view.direction)]
    cut = [k for k, each in enumerate(page.views) if each.view.section is not None]
    flat = [k for k in range(len(page.views)) if k not in slanted]

    def wanted(has: npt.NDArray[np.bool_], unusual: list[int]) -> bool | None:
        """False: no view has them; True: views have them that usually do not; None: usual ones alone."""
        if not has.any():
            return False
        return True if np.isin(lines.view[has], unusual).any() else None

    smooth = lines.kind == LINE_CLASSES["smooth"].number
    return replace(options, hidden=wanted(lines.visible == 0, slanted + cut), smooth=wanted(smooth, flat))


def _alone(drawing: Drawing, view: SheetView) -> Drawing:
    """A view of a page as a drawing of its own, without lines: its camera, and where it lies."""
    up = tuple(np.cross(view.direction, view.right).tolist())
    camera = DrawnView(view.label, "orthographic", view.direction, view.right, up)
    assert view.origin is not None
    return replace(drawing, view=camera, origin=view.origin, sheet=None, page=None, lines=())
