"""The elements of a page's template that show something, as svgelements has them."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Mapping
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

_REFERENCE = re.compile(r"""url\(\s*["']?#([^)"']+?)["']?\s*\)""")
_STOP_COLOR = re.compile(r"(?:^|;)\s*stop-color\s*:\s*([^;]+)")


def shown_elements(template: str) -> Iterator[Any]:
    """Each Shape and Text that is to be seen, in their order. template: as of `hlr.drawing.sheet.Sheet`.

    A template that is no SVG raises whatever the library does.
    """
    from svgelements import SVG, Shape, Text

    whole = _without_gradients(f"<svg>{template}</svg>")
    for element in SVG.parse(io.StringIO(whole), reify=False).elements():
        if element.values.get("visibility") == "hidden" or element.values.get("display") == "none":
            continue
        if isinstance(element, Text | Shape):
            yield element


def dashes_of(shape: Any, scale: float) -> list[float]:
    """Lengths of dashes and gaps, times the scale; empty: the stroke is continuous."""
    given = str(shape.values.get("stroke-dasharray") or "none")
    if given == "none":
        return []
    lengths = [float(part.removesuffix("px").removesuffix("mm")) * scale for part in given.replace(",", " ").split()]
    return lengths if sum(lengths) > 0.0 else []


def _without_gradients(svg: str) -> str:
    """Gradients become the mean of their colours: what PDF fills here has one."""
    if "Gradient" not in svg:
        return svg
    elements = ElementTree.fromstring(svg).iter()
    gradients = {each.get("id"): each for each in elements if each.tag in ("linearGradient", "radialGradient")}
    return _REFERENCE.sub(lambda found: _mean(gradients, found[1]) if found[1] in gradients else found[0], svg)


def _mean(gradients: Mapping[str | None, Element], name: str) -> str:
    """#rrggbb, or none for a gradient without colours, which paints nothing."""
    from svgelements import Color

    own, left = gradients.get(name), len(gradients)
    # A gradient may take its colours from another one; those that refer to one another have none.
    while own is not None and own.find("stop") is None and left > 0:
        own, left = gradients.get(own.get("href", "").removeprefix("#")), left - 1
    stops = [] if own is None else own.findall("stop")
    told = [_STOP_COLOR.search(stop.get("style", "")) for stop in stops]
    colors = [
        Color(found[1] if found else stop.get("stop-color", "black")) for stop, found in zip(stops, told, strict=True)
    ]
    if not colors:
        return "none"
    channels = zip(*((each.red, each.green, each.blue) for each in colors), strict=True)
    return "#" + "".join(f"{round(sum(channel) / len(colors)):02x}" for channel in channels)
