"""What is printed on a FreeCAD page beside the lines of its views: texts, balloons, leaders, symbols, tables."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from hlr.drawing.view_marks import Point
from hlr.source.freecad.annotations import annotation, balloon, dimension_text, frame, leader
from hlr.source.freecad.document import Object
from hlr.source.freecad.rich_text import rich_text
from hlr.source.freecad.symbols import symbol


@dataclass(frozen=True, slots=True)
class Around:
    """What an item is drawn with.

    views   place and scale of each view that is drawn, by its name
    height  of the page
    path    of the document, for errors
    """

    views: Mapping[str, tuple[Point, float]]
    height: float
    path: Path


def printed(thing: Object, around: Around) -> str:
    """An item as SVG in millimetres from the page's upper left corner.

    Empty where it is of a kind that is not drawn, belongs to a view that is not, or the document keeps nothing of it.

    Raises:
        SourceError, DamagedError: it is broken.
    """
    found = _ITEMS.get(thing.type)
    return "" if found is None else found(thing, around)


def _annotation(thing: Object, around: Around) -> str:
    return annotation(thing, around.height)


def _symbol(thing: Object, around: Around) -> str:
    return symbol(thing, around.height, around.path)


def _balloon(thing: Object, around: Around) -> str:
    view = around.views.get(thing.values.link("SourceView"))
    return "" if view is None else balloon(thing, *view, around.height)


def _leader(thing: Object, around: Around) -> str:
    view = around.views.get(thing.values.link("LeaderParent"))
    return "" if view is None else leader(thing, *view, around.height)


def _rich_text(thing: Object, around: Around) -> str:
    parent = thing.values.link("AnnoParent")
    if parent and parent not in around.views:
        return ""
    (x, y), _ = around.views[parent] if parent else ((0.0, 0.0), 1.0)
    place = x + thing.values.number("X", 0.0), y + thing.values.number("Y", 0.0)
    return rich_text(thing, place, around.height)


def _clip(thing: Object, around: Around) -> str:
    return frame(thing, around.height)


def _dimension_text(thing: Object, around: Around) -> str:
    view = around.views.get(thing.values.link("References2D"))
    return "" if view is None else dimension_text(thing, view[0], around.height)


_ITEMS: dict[str, Callable[[Object, Around], str]] = {
    "TechDraw::DrawViewAnnotation": _annotation,
    "TechDraw::DrawViewBalloon": _balloon,
    "TechDraw::DrawLeaderLine": _leader,
    "TechDraw::DrawRichAnno": _rich_text,
    "TechDraw::DrawViewDimension": _dimension_text,
    "TechDraw::DrawViewClip": _clip,
    "TechDraw::DrawViewSymbol": _symbol,
    "TechDraw::DrawViewSpreadsheet": _symbol,
    "TechDraw::DrawViewDraft": _symbol,
    "TechDraw::DrawViewArch": _symbol,
}
"""What draws an item of each type."""
