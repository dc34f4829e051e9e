"""The TechDraw pages of a FreeCAD document, as records: the page, its template, its views, and what else is on it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from hlr.errors import counted
from hlr.source.freecad.added_lines import added_lines
from hlr.source.freecad.document import Document, Object
from hlr.source.freecad.page_items import Around, printed
from hlr.source.freecad.page_views import VIEWS, PageView, clipped, view_of
from hlr.source.freecad.template import field_texts, filled_template


@dataclass(frozen=True, slots=True)
class DocumentPage:
    """A page.

    size      width and height, millimetres; None where it has no template
    template  that and its texts, as SVG elements in millimetres from the upper left corner
    left_out  what of it is not drawn, for people
    texts     in the fields of the template, by their keys
    """

    name: str
    label: str
    size: tuple[float, float] | None
    template: str
    views: tuple[PageView, ...]
    left_out: tuple[str, ...] = field(default=())
    texts: Mapping[str, str] = field(default_factory=dict)


def pages_of(document: Document, path: Path) -> list[DocumentPage]:
    """All pages of a document, in its order.

    Raises:
        SourceError, DamagedError: something on a page is broken.
    """
    return [_page(thing, document, path) for thing in document.objects.values() if thing.type in _PAGES]


def _page(page: Object, document: Document, path: Path) -> DocumentPage:
    size, svg, texts = _template(page, document, path)
    items = list(_items(page, document))
    clips = {name: thing for thing, _ in items if thing.type in _CLIPS for name in thing.values.links("Views")}
    made = {thing.name: view_of(thing, group, page, document.objects) for thing, group in items if thing.type in VIEWS}
    views = {name: clipped(view, clips.get(name)) for name, view in made.items() if view is not None}
    others: Counter[str] = Counter()
    for name, view in views.items():
        svg += _added(document.objects[name], view, size, others)
    around = Around({view.name: (view.place, view.scale) for view in views.values()}, size[1] if size else 0.0, path)
    for thing, _ in items:
        if thing.name not in views and thing.type not in _GROUPS:
            drawn = printed(thing, around) if size and thing.name not in clips else ""
            svg += drawn
            if not drawn or thing.type in _LINES_OF:
                noun = _NOUNS.get(thing.type, thing.type.rpartition("::")[2])
                others[_LINES_OF[thing.type] if drawn else noun] += 1
    # Hatches are on no page, but on the faces of a view.
    others["hatch"] = sum(
        thing.values.link("Source") in views for thing in document.objects.values() if thing.type in _HATCHES
    ) + sum(view.cut_faces.unknown for view in views.values())
    left_out = [counted(count, noun, _SEVERAL.get(noun, "")) for noun, count in sorted(others.items()) if count]
    return DocumentPage(page.name, page.label, size, svg, tuple(views.values()), tuple(left_out), texts)


def _template(
    page: Object, document: Document, path: Path
) -> tuple[tuple[float, float] | None, str, Mapping[str, str]]:
    """The size of a page, None where it has no template, its template as SVG, and the texts of its fields."""
    template = document.objects.get(page.values.link("Template"))
    if template is None:
        return None, "", {}
    size = template.values.number("Width", 0.0), template.values.number("Height", 0.0)
    if min(size) <= 0.0:
        return None, "", {}
    data = template.values.content("PageResult")
    if not data:
        return size, "", {}
    texts = template.values.texts("EditableTexts")
    return size, filled_template(data, texts, size, path), field_texts(data, texts, path)


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


_PAGES = {"TechDraw::DrawPage", "TechDraw::DrawPagePython"}
_GROUPS = {"TechDraw::DrawProjGroup"}

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
