"""The TechDraw pages of a FreeCAD document, as records: the page, its template, its views, and what else is on it."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from hlr.errors import counted
from hlr.source.freecad.added_lines import added_lines
from hlr.source.freecad.document import Document, Object
from hlr.source.freecad.page_items import Around, printed
from hlr.source.freecad.properties import Properties, Vector
from hlr.source.freecad.template import filled_template


@dataclass(frozen=True, slots=True)
class PageView:
    """A view of a model on a page. Millimetres on paper, degrees.

    sources      names of the objects that it shows
    direction    toward the viewer; right: to the right on paper, perpendicular to it
    place        of its middle, from the page's lower left corner
    rotation     anticlockwise
    focus        distance of the eye on paper, of a perspective; None: a parallel projection
    lines        of which classes lines are drawn, visible and hidden ones: ("sharp", True)
    widths       of visible and hidden lines; None where the document does not say it
    window       left, bottom, right and top of the rectangle on the page that a clip leaves of it; None: all of it
    """

    name: str
    label: str
    sources: tuple[str, ...]
    direction: Vector
    right: Vector
    scale: float
    place: tuple[float, float]
    rotation: float
    focus: float | None
    lines: frozenset[tuple[str, bool]]
    widths: tuple[float, float] | None
    window: tuple[float, float, float, float] | None = None


@dataclass(frozen=True, slots=True)
class DocumentPage:
    """A page.

    size      width and height, millimetres; None where it has no template
    template  that and its texts, as SVG elements in millimetres from the upper left corner
    left_out  what of it is not drawn, for people
    """

    name: str
    label: str
    size: tuple[float, float] | None
    template: str
    views: tuple[PageView, ...]
    left_out: tuple[str, ...] = field(default=())


def pages_of(document: Document, path: Path) -> list[DocumentPage]:
    """All pages of a document, in its order.

    Raises:
        SourceError, DamagedError: something on a page is broken.
    """
    return [_page(thing, document, path) for thing in document.objects.values() if thing.type in _PAGES]


def _page(page: Object, document: Document, path: Path) -> DocumentPage:
    size, svg = _template(page, document, path)
    items = list(_items(page, document))
    clips = {name: thing for thing, _ in items if thing.type in _CLIPS for name in thing.values.links("Views")}
    shown = [(thing, group) for thing, group in items if thing.type in _VIEWS]
    views = {thing.name: _clipped(_view(thing, group, page), clips.get(thing.name)) for thing, group in shown}
    others: Counter[str] = Counter()
    for thing, _ in shown:
        svg += _added(thing, views[thing.name], size, others)
    around = Around({view.name: (view.place, view.scale) for view in views.values()}, size[1] if size else 0.0, path)
    for thing, _ in items:
        if thing.type not in _VIEWS | _GROUPS:
            drawn = printed(thing, around) if size and thing.name not in clips else ""
            svg += drawn
            if not drawn or thing.type in _LINES_OF:
                noun = _NOUNS.get(thing.type, thing.type.rpartition("::")[2])
                others[_LINES_OF[thing.type] if drawn else noun] += 1
    # Hatches are on no page, but on the faces of a view.
    others["hatch"] = sum(
        thing.values.link("Source") in views for thing in document.objects.values() if thing.type in _HATCHES
    )
    left_out = [counted(count, noun, _SEVERAL.get(noun, "")) for noun, count in sorted(others.items()) if count]
    return DocumentPage(page.name, page.label, size, svg, tuple(views.values()), tuple(left_out))


def _template(page: Object, document: Document, path: Path) -> tuple[tuple[float, float] | None, str]:
    """The size of a page, None where it has no template, and its template as SVG."""
    template = document.objects.get(page.values.link("Template"))
    if template is None:
        return None, ""
    size = template.values.number("Width", 0.0), template.values.number("Height", 0.0)
    if min(size) <= 0.0:
        return None, ""
    data = template.values.content("PageResult")
    return size, filled_template(data, template.values.texts("EditableTexts"), size, path) if data else ""


def _added(thing: Object, view: PageView, size: tuple[float, float] | None, others: Counter[str]) -> str:
    """The lines that a user has added to a view, as SVG; those that are not drawn are counted in `others`."""
    svg = ""
    for name, noun in _ADDED.items():
        lines = thing.values.records(name)
        drawn, unknown = (
            added_lines(lines, view.place, view.scale, view.rotation, size[1]) if size else ("", len(lines))
        )
        svg += drawn
        others[noun] += unknown
    if thing.values.count("IsoCount"):
        others[_ISO] += any(thing.values.flag(name, False) for name in ("IsoVisible", "IsoHidden"))
    return svg


def _items(page: Object, document: Document) -> Iterator[tuple[Object, Object | None]]:
    """What is on a page, and for each the group of projections that it is in."""
    for name in page.values.links("Views"):
        thing = document.objects.get(name)
        if thing is None or not thing.visible:
            continue
        yield thing, None
        if thing.type in _GROUPS:
            members = (document.objects.get(each) for each in thing.values.links("Views"))
            yield from ((member, thing) for member in members if member is not None and member.visible)


def _view(view: Object, group: Object | None, page: Object) -> PageView:
    values = view.values
    scaled = (group or view).values
    # Of the page, automatic, or its own: an automatic scale is kept where the own one is.
    from_page = scaled.count("ScaleType") == 0 and "ScaleType" in scaled
    scale = (page.values if from_page else scaled).number("Scale", 1.0)
    x, y = values.number("X", 0.0), values.number("Y", 0.0)
    if group is not None:
        x, y = x + group.values.number("X", 0.0), y + group.values.number("Y", 0.0)
    direction = values.vector("Direction", (0.0, -1.0, 0.0))
    return PageView(
        view.name,
        view.label,
        tuple(dict.fromkeys([*values.links("Source"), *values.links("XSource")])),
        direction,
        _right(values, direction),
        scale if scale > 0.0 else 1.0,
        (x, y),
        values.number("Rotation", 0.0),
        values.number("Focus", 100.0) if values.flag("Perspective", False) else None,
        frozenset(_lines(values)),
        _widths(view.view),
    )


def _clipped(view: PageView, clip: Object | None) -> PageView:
    """A view in a clip: its place counts from the middle of that, and what lies outside is cut off."""
    if clip is None:
        return view
    x, y = clip.values.number("X", 0.0), clip.values.number("Y", 0.0)
    right, up = 0.5 * clip.values.number("Width", 0.0), 0.5 * clip.values.number("Height", 0.0)
    return replace(view, place=(x + view.place[0], y + view.place[1]), window=(x - right, y - up, x + right, y + up))


def _lines(values: Properties) -> Iterator[tuple[str, bool]]:
    for kind, switch in _SWITCHES.items():
        if switch == "Hard" or values.flag(f"{switch}Visible", True):
            yield kind, True
        if values.flag(f"{switch}Hidden", False):
            yield kind, False


def _widths(view: Properties) -> tuple[float, float] | None:
    if "LineWidth" not in view:
        return None
    return view.number("LineWidth", 0.7), view.number("HiddenWidth", 0.35)


def _right(values: Properties, direction: Vector) -> Vector:
    """The direction to the right: the one that is kept, made perpendicular; else the one that keeps z up."""
    toward = np.array(direction)
    toward /= math.sqrt(float(toward @ toward)) or 1.0
    for name in ("XDirection", "RotationVector"):
        kept = np.array(values.vector(name, (0.0, 0.0, 0.0)))
        kept -= (kept @ toward) * toward
        if float(kept @ kept) > 1e-12:
            x, y, z = (kept / math.sqrt(float(kept @ kept))).tolist()
            return x, y, z
    around = (0.0, 1.0, 0.0) if abs(toward[2]) > 1.0 - 1e-9 else (0.0, 0.0, 1.0)
    x, y, z = np.cross(around, toward).tolist()
    return x, y, z


_PAGES = {"TechDraw::DrawPage", "TechDraw::DrawPagePython"}
_VIEWS = {"TechDraw::DrawViewPart", "TechDraw::DrawViewPartPython", "TechDraw::DrawProjGroupItem"}
_GROUPS = {"TechDraw::DrawProjGroup"}

_SWITCHES = {
    "sharp": "Hard",
    "outline": "Hard",
    "boundary": "Hard",
    "intersection": "Hard",
    "smooth": "Smooth",
    "seam": "Seam",
}
"""Which of a view's switches decides on each class of lines."""

_DIMENSION = "TechDraw::DrawViewDimension"

_NOUNS = {
    _DIMENSION: "dimension",
    "TechDraw::DrawViewBalloon": "balloon",
    "TechDraw::DrawViewAnnotation": "annotation",
    "TechDraw::DrawRichAnno": "rich text",
    "TechDraw::DrawLeaderLine": "leader",
    "TechDraw::DrawViewSection": "section",
    "TechDraw::DrawComplexSection": "section",
    "TechDraw::DrawViewDetail": "detail",
    "TechDraw::DrawViewSpreadsheet": "table",
    "TechDraw::DrawViewSymbol": "symbol",
    "TechDraw::DrawViewImage": "picture",
    "TechDraw::DrawViewClip": "clip",
    "TechDraw::DrawWeldSymbol": "weld symbol",
    "TechDraw::DrawViewDraft": "Draft view",
    "TechDraw::DrawViewArch": "Arch view",
}
"""What else may be on a page, for people."""

_CLIPS = {"TechDraw::DrawViewClip"}
_HATCHES = {"TechDraw::DrawHatch", "TechDraw::DrawGeomHatch"}
_ADDED = {"CosmeticEdges": "cosmetic line", "CenterLines": "centre line"}
"""What a user has added to a view by hand. Points that are added are help for dimensions, and never printed."""

_LINES_OF = {_DIMENSION: "set of dimension lines"}
"""What of an item is not drawn where its text is."""

_ISO = "set of isoparametric lines"

_SEVERAL = {
    _ISO: "sets of isoparametric lines",
    "set of dimension lines": "sets of dimension lines",
    "hatch": "hatches",
    "rich text": "rich texts",
}
