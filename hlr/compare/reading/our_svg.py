"""An SVG file of ours: its groups say what each line is, as `hlr/writers/svg.py` writes them."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import TYPE_CHECKING

from hlr.compare.lines.sketch import About, Sketch, Trait
from hlr.compare.reading.path_data import add_path
from hlr.errors import SourceError
from hlr.request.scale import scale_of
from hlr.source.archive import xml_tree
from hlr.tables.line_classes import LINE_CLASSES

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

_SVG = "{http://www.w3.org/2000/svg}"
_OURS = "{urn:hlr:drawing:1}"
_SHAPES = ("path", "circle", "ellipse")
_TURN = re.compile(r"rotate\((\S+) \S+ \S+\)")


def read_svg(path: Path, sketch: Sketch) -> About:
    """Add the lines of a file to a sketch. Returns what else the file says.

    Raises SourceError, in one sentence, for a file that is no SVG, or none of ours, or damaged.
    """
    root = xml_tree(path.read_bytes(), path, "the file", "SVG")
    ours = root.find(f"{_SVG}metadata/{_OURS}drawing")
    if root.tag != f"{_SVG}svg" or ours is None:
        raise SourceError(f"{path.name} is no drawing of hlr: draw the model as SVG or JSON and compare that")
    try:
        _read(root, sketch)
    except ValueError as error:
        raise SourceError(f"{path.name} is damaged: {error}") from None
    names = tuple(part.get("name", "") for part in ours.iter(f"{_OURS}part"))
    return About(names, scale_of(ours.get("scale", "")))


def _read(root: Element, sketch: Sketch) -> None:
    """Walk through the groups, in the order of the file; what holds in a group holds for all inside it."""
    open_groups: list[tuple[Element, int | None, int | None, int]] = [(root, None, None, -1)]
    while open_groups:
        element, kind, visible, part = open_groups.pop()
        name = element.tag.removeprefix(_SVG)
        if name in _SHAPES:
            if kind is not None and visible is not None:
                sketch.begin(Trait(kind, visible, part, _whole(element.get("data-edge", "-1"))))
                _add(sketch, name, element)
            continue
        if name not in ("svg", "g"):
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
