"""Lines that a user has added to a view by hand, cosmetic and centre lines, as SVG from their stored geometry."""

from __future__ import annotations

import math
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from hlr.drawing.view_marks import Point
from hlr.source.freecad.properties import child_number, child_points, child_text

DASHES = {2: (4.0, 2.0), 3: (1.0, 2.0), 4: (4.0, 2.0, 1.0, 2.0), 5: (4.0, 2.0, 1.0, 2.0, 1.0, 2.0)}
"""Dashes and gaps of a line's style, in its width; 1 is a full line, 0 none."""


def added_lines(lines: list[Element], place: Point, scale: float, rotation: float, height: float) -> tuple[str, int]:
    """The lines as SVG, and how many of them are of a form that is not drawn.

    place, scale, rotation: of the view, the middle of which is their origin; height: of the page
    """
    group = Element("g", {"fill": "none", "stroke-linecap": "round"})
    group.set("transform", f"translate({place[0]:g} {height - place[1]:g}) rotate({0.0 - rotation:g}) scale({scale:g})")
    unknown = 0
    for line in lines:
        style = int(child_number(line, "Style", 1.0))
        if style == 0 or child_number(line, "Visible", 1.0) == 0.0:
            continue
        drawn = _path(line)
        if drawn is None:
            unknown += 1
            continue
        width = child_number(line, "Weight", 0.5) / scale
        path = ElementTree.SubElement(group, "path", {"d": drawn, "stroke": child_text(line, "Color", "#000000")[:7]})
        path.set("stroke-width", f"{width:g}")
        if style in DASHES:
            path.set("stroke-dasharray", " ".join(f"{width * each:g}" for each in DASHES[style]))
    return (ElementTree.tostring(group, encoding="unicode") + "\n" if len(group) else ""), unknown


def _path(line: Element) -> str | None:
    """The data of a path; y is down, as it is stored. None: a form that is not drawn."""
    match int(child_number(line, "GeometryType", 0.0)):
        case 1:
            ((x, y),), radius = child_points(line, "Center"), child_number(line, "Radius", 0.0)
            half = f"A {radius:g} {radius:g} 0 0 1"
            return f"M {x - radius:g} {y:g} {half} {x + radius:g} {y:g} {half} {x - radius:g} {y:g} Z"
        case 2:
            ((x, y),), radius = child_points(line, "Center"), child_number(line, "Radius", 0.0)
            first, last = child_number(line, "StartAngle", 0.0), child_number(line, "EndAngle", 0.0)
            a, b = ((x + radius * math.cos(t), y + radius * math.sin(t)) for t in (first, last))
            large = int((last - first) % math.tau > math.pi)
            return f"M {a[0]:g} {a[1]:g} A {radius:g} {radius:g} 0 {large} 1 {b[0]:g} {b[1]:g}"
        case 7:
            points = child_points(line, "Points/Point")
            return "M " + " L ".join(f"{x:g} {y:g}" for x, y in points) if len(points) > 1 else None
    return None
