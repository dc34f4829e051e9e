"""Symbols and tables of a FreeCAD page: the SVG that the document keeps of each, as large as FreeCAD draws it."""

from __future__ import annotations

import io
import re
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from hlr.source.freecad.document import Object
from hlr.source.freecad.template import safe_svg

MM_PER_PIXEL = 1.0 / 3.78
"""As FreeCAD puts pixels on paper: 96 to the inch, rounded."""

PIXELS = {"": 1.0, "px": 1.0, "mm": 90.0 / 25.4, "cm": 90.0 / 2.54, "in": 90.0, "pt": 1.25, "pc": 15.0}
"""Of one unit. Qt, with which FreeCAD reads symbols, has 90 pixels to the inch; so 20 mm are 18.5 mm on its paper."""


def symbol(thing: Object, height: float, path: Path) -> str:
    """A symbol or a table about its place; empty where the document keeps no picture of it. height: of the page.

    Raises:
        SourceError: it is no sound XML. DamagedError: it is no SVG.
    """
    values = thing.values
    data = values.text("Symbol").encode()
    if not data:
        return ""
    texts = dict(enumerate(values.strings("EditableTexts")))
    root = safe_svg(data, lambda number, _: texts.get(number), path, "a symbol")
    box = _size(root)
    if box is None:
        return ""
    (x0, y0, width, deep), (right, down) = box
    scale = MM_PER_PIXEL * values.number("Scale", 1.0)
    root.attrib.update(x=f"{-0.5 * right * scale:.4f}", y=f"{-0.5 * down * scale:.4f}")
    root.attrib.update(width=f"{right * scale:.4f}", height=f"{down * scale:.4f}")
    root.attrib.update(viewBox=f"{x0:g} {y0:g} {width:g} {deep:g}", preserveAspectRatio="none", overflow="visible")
    x, y, turn = values.number("X", 0.0), height - values.number("Y", 0.0), values.number("Rotation", 0.0)
    group = Element("g", {"transform": f"translate({x:g} {y:g}) rotate({0.0 - turn:g})"})
    group.append(root)
    return ElementTree.tostring(group, encoding="unicode") + "\n"


def _size(root: Element) -> tuple[tuple[float, float, float, float], tuple[float, float]] | None:
    """The box of an SVG in its own units, and its width and height in pixels; None where it has neither."""
    numbers = re.findall(_NUMBER, root.get("viewBox", ""))
    box = tuple(float(number) for number in numbers) if len(numbers) == 4 else None
    width, height = (_pixels(root.get(name, "")) for name in ("width", "height"))
    if box is None and width and height:
        box = (0.0, 0.0, width, height)
    if box is None:
        box = _around(root)
    if box is None or min(box[2:]) <= 0.0:
        return None
    # Qt counts whole pixels.
    return (box[0], box[1], box[2], box[3]), (float(int(width) or box[2]), float(int(height) or box[3]))


def _pixels(length: str) -> float:
    """A length in pixels; 0 where there is none, or it is a share of something."""
    found = re.fullmatch(rf"\s*({_NUMBER})\s*([a-z]*)\s*", length)
    return float(found[1]) * PIXELS.get(found[2], 0.0) if found else 0.0


def _around(root: Element) -> tuple[float, float, float, float] | None:
    """The box around all lines of an SVG, left, top, width and height."""
    from svgelements import SVG, Shape

    text = ElementTree.tostring(root, encoding="unicode")
    try:
        shapes = [each for each in SVG.parse(io.StringIO(text)).elements() if isinstance(each, Shape)]
        boxes = [box for shape in shapes if (box := shape.bbox()) is not None]
    except Exception:  # whatever a broken file makes the library raise
        return None
    if not boxes:
        return None
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return min(x0), min(y0), max(x1) - min(x0), max(y1) - min(y0)


_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
