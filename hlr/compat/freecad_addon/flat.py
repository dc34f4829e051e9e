"""A drawing's SVG as FreeCAD's Qt reads it: no SVG within the SVG, and the page's corner at zero."""

from __future__ import annotations

from xml.etree import ElementTree
from xml.etree.ElementTree import Element

SVG = "{http://www.w3.org/2000/svg}"

_PLACES = ("x", "y", "width", "height", "viewBox", "preserveAspectRatio", "overflow", "version")


def flat_svg(svg: str) -> bytes:
    """The same picture: what is nested becomes groups that are moved and scaled. svg: of a drawing on a page."""
    ElementTree.register_namespace("", SVG[1:-1])
    root = ElementTree.fromstring(svg)
    size = {name: root.get(name, "") for name in ("width", "height")}
    box = [float(number) for number in root.get("viewBox", "").split()]
    out = Element(f"{SVG}svg", {**size, "viewBox": f"0 0 {box[2]:g} {box[3]:g}"})
    kept = {name: value for name, value in root.items() if name not in (*_PLACES, "style")}
    content = ElementTree.SubElement(
        out, f"{SVG}g", {**kept, "transform": f"translate({0.0 - box[0]:g} {0.0 - box[1]:g})"}
    )
    content.extend(root)
    for parent in reversed(list(out.iter())):  # what is inside first
        for number, child in enumerate(parent):
            if child.tag == f"{SVG}svg":
                parent[number] = _group(child)
    return ElementTree.tostring(out, encoding="unicode").encode()


def _group(nested: Element) -> Element:
    x, y = (float(nested.get(name, "0")) for name in ("x", "y"))
    wide, high = (float(nested.get(name, "0")) for name in ("width", "height"))
    left, top, width, height = (float(number) for number in nested.get("viewBox", f"0 0 {wide} {high}").split())
    across, down = wide / width, high / height
    if nested.get("preserveAspectRatio") != "none":
        even = min(across, down)
        x, y = x + 0.5 * (wide - even * width), y + 0.5 * (high - even * height)
        across = down = even
    place = f"translate({x:.6g} {y:.6g}) scale({across:.8g} {down:.8g}) translate({0.0 - left:g} {0.0 - top:g})"
    group = Element(f"{SVG}g", {name: value for name, value in nested.items() if name not in _PLACES})
    group.set("transform", place)
    group.extend(nested)
    return group
