"""An SVG file of ours: its groups say what each line is, as `hlr/writers/svg.py` writes them."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from hlr.compare.lines.sketch import About, Sketch, StatedPage, Trait
from hlr.compare.reading.path_data import add_path
from hlr.compare.reading.stated_view import placed_in, stated_in
from hlr.compare.reading.svg_elements import SVG
from hlr.drawing.sheet import views_of_parts
from hlr.request.scale import scale_of
from hlr.tables.line_classes import LINE_CLASSES
from hlr.tables.projection_methods import PROJECTION_METHODS

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

_OURS = "{urn:hlr:drawing:1}"
_SHAPES = ("path", "circle", "ellipse")
_SIZE = re.compile(r"([0-9]{1,6}(?:\.[0-9]{1,9})?)mm")
_TURN = re.compile(r"rotate\((\S+) \S+ \S+\)")


def about_ours(root: Element) -> About | None:
    """What the file says besides its lines; None where it is no drawing of hlr. Raises ValueError if damaged."""
    ours = root.find(f"{SVG}metadata/{_OURS}drawing")
    if ours is None:
        return None
    parts, views = (tuple(each.get("name", "") for each in ours.iter(f"{_OURS}{tag}")) for tag in ("part", "view"))
    stated = None if views else stated_in(ours.get("view"), ours.attrib)
    said = {each.get("scale", "") for each in ours.iter(f"{_OURS}view")} if views else {ours.get("scale", "")}
    return About(parts, scale_of(said.pop()) if len(said) == 1 else None, views, stated=stated, page=_page(root, ours))


def _page(root: Element, ours: Element) -> StatedPage | None:
    """A page by a method of projection; None where it does not state all views. Raises ValueError if damaged."""
    method, found = ours.get("view", ""), [placed_in(each.attrib) for each in ours.iter(f"{_OURS}view")]
    if method not in PROJECTION_METHODS or not found or None in found:
        return None
    width, height = (_SIZE.fullmatch(root.get(name, "")) for name in ("width", "height"))
    size = None if width is None or height is None else (float(width[1]), float(height[1]))
    return StatedPage(method, size, tuple(view for view in found if view is not None))


def read_ours(root: Element, about: About, sketch: Sketch) -> None:
    """Add all lines; about: what `about_ours` has found. Raises ValueError where the file is damaged.

    Walk through the groups, in the order of the file; what holds in a group holds for all inside it.
    """
    views = views_of_parts(about.parts, about.views)
    open_groups: list[tuple[Element, int | None, int | None, int]] = [(root, None, None, -1)]
    while open_groups:
        element, kind, visible, part = open_groups.pop()
        name = element.tag.removeprefix(SVG)
        if name in _SHAPES:
            if kind is not None and visible is not None:
                view = views[part] if 0 <= part < len(views) else -1
                sketch.begin(Trait(kind, visible, part, _whole(element.get("data-edge", "-1")), view))
                _add(sketch, name, element)
            continue
        if name not in ("svg", "g") or element.get("id") == "template":
            continue
        if "transform" in element.attrib:
            raise ValueError("a group is moved by another program; compare the file as it was drawn")
        word = element.get("class", "")
        kind = LINE_CLASSES[word].number if word in LINE_CLASSES else kind
        visible = {"visible": 1, "hidden": 0}.get(word, visible)
        part = _whole(element.get("data-part", str(part)))
        open_groups.extend((child, kind, visible, part) for child in reversed(element))


def _add(sketch: Sketch, name: str, element: Element) -> None:
    if name == "path":
        add_path(sketch, element.get("d", ""))
        return
    x, y = (float(element.get(key, "0")) for key in ("cx", "cy"))
    radii = ("r", "r") if name == "circle" else ("rx", "ry")
    long, short = (float(element.get(key, "0")) for key in radii)
    found = _TURN.fullmatch(element.get("transform", ""))
    turn = -math.radians(float(found[1])) if found else 0.0
    c, s = math.cos(turn), math.sin(turn)
    sketch.arc((x, -y), ((long * c, long * s), (-short * s, short * c)), (0.0, math.tau))


def _whole(text: str) -> int:
    number = int(text)
    if abs(number) > 2**31:
        raise ValueError(f"the number {text} is too large")
    return number
