"""The views of a FreeCAD page, also sections and details, as records: what each shows, from where, and its place."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from hlr.drawing.view_marks import Mark
from hlr.source.freecad.document import Object
from hlr.source.freecad.hatch import CutFaces, cut_faces
from hlr.source.freecad.properties import Properties, Vector
from hlr.source.freecad.view_marks import detail_mark, section_mark


@dataclass(frozen=True, slots=True)
class Cut:
    """A plane that takes away what lies on the side of its normal. origin, normal: in the model's coordinates."""

    origin: Vector
    normal: Vector


@dataclass(frozen=True, slots=True)
class Detail:
    """The circle of a view that a detail shows. Model units on the plane of the view, from the middle of the view."""

    middle: tuple[float, float]
    radius: float


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
    cuts         of a section, and of what it is made of, the last one last
    cut_faces    how the faces are filled that the last cut makes
    detail       None: it shows all of the model. Of a detail, `place` is that of the circle's middle
    mark         how a section or a detail is marked in the view that it is made of; None: it is not
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
    cuts: tuple[Cut, ...] = ()
    cut_faces: CutFaces = field(default_factory=CutFaces)
    detail: Detail | None = None
    mark: Mark | None = None


VIEWS = {
    "TechDraw::DrawViewPart",
    "TechDraw::DrawViewPartPython",
    "TechDraw::DrawProjGroupItem",
    "TechDraw::DrawViewSection",
    "TechDraw::DrawViewDetail",
}
"""Types of views that are drawn."""

_SECTION, _DETAIL = "TechDraw::DrawViewSection", "TechDraw::DrawViewDetail"

DEEPEST = 100
"""How many sections and details may be made one of the other."""


def view_of(
    thing: Object, group: Object | None, page: Object, objects: Mapping[str, Object], depth: int = 0
) -> PageView | None:
    """A view, also a section or a detail. None: what it is made of is missing, of another kind, or itself.

    group: the group of projections that it is in; objects: all of the document
    """
    view = _plain(thing, group, page)
    if thing.type not in (_SECTION, _DETAIL):
        return view
    found = objects.get(thing.values.link("BaseView"))
    base = None if found is None or found.type not in VIEWS or depth == DEEPEST else found
    if base is None:
        return None
    shown = view_of(base, None, page, objects, depth + 1)
    if shown is None:
        return None
    view = replace(view, sources=view.sources or shown.sources)
    return _section(view, thing, base, shown) if thing.type == _SECTION else _detail(view, thing, base, shown)


def _section(view: PageView, thing: Object, base: Object, shown: PageView) -> PageView | None:
    values = thing.values
    normal = values.vector("SectionNormal", view.direction)
    if not any(normal):
        return None
    cut = Cut(values.vector("SectionOrigin", (0.0, 0.0, 0.0)), normal)
    mark = section_mark(base, values.text("SectionSymbol"))
    # A section of a section cuts the whole model again, but where the document says otherwise.
    earlier = shown.cuts if values.flag("UsePreviousCut", False) else ()
    return replace(view, cuts=(*earlier, cut), cut_faces=cut_faces(thing), mark=mark)


def _detail(view: PageView, thing: Object, base: Object, shown: PageView) -> PageView | None:
    x, y, _ = thing.values.vector("AnchorPoint", (0.0, 0.0, 0.0))
    radius = thing.values.number("Radius", 10.0)
    if radius <= 0.0:
        return None
    if shown.detail is not None:
        x, y = x + shown.detail.middle[0], y + shown.detail.middle[1]
    mark = detail_mark(base, thing.values.text("Reference"))
    detail = Detail((x, y), radius)
    return replace(view, direction=shown.direction, right=shown.right, cuts=shown.cuts, detail=detail, mark=mark)


def _plain(view: Object, group: Object | None, page: Object) -> PageView:
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


def clipped(view: PageView, clip: Object | None) -> PageView:
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


_SWITCHES = {
    "sharp": "Hard",
    "outline": "Hard",
    "boundary": "Hard",
    "intersection": "Hard",
    "smooth": "Smooth",
    "seam": "Seam",
}
"""Which of a view's switches decides on each class of lines."""
