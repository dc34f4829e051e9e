"""The template of a FreeCAD page: an SVG whose fields are filled in, and that is safe to put into another."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from hlr.source.archive import xml_tree
from hlr.source.freecad.properties import DamagedError

SVG = "{http://www.w3.org/2000/svg}"


def filled_template(data: bytes, texts: Mapping[str, str], size: tuple[float, float], path: Path) -> str:
    """A template as an SVG element of this width and height in millimetres, with these texts in its fields.

    What could run, or lead out of the file, is left out: scripts, foreign elements, references.

    Raises:
        SourceError: it is no sound XML. DamagedError: it is no SVG.
    """
    root = safe_svg(data, lambda _, key: texts.get(key), path, "a template")
    out = Element("svg", {"width": f"{size[0]:g}", "height": f"{size[1]:g}", "overflow": "hidden"})
    for name in ("viewBox", "preserveAspectRatio", "style"):
        if (value := root.get(name)) is not None:
            out.set(name, value)
    out.extend(root)
    out.tail = "\n"
    return ElementTree.tostring(out, encoding="unicode")


def field_texts(data: bytes, texts: Mapping[str, str], path: Path) -> dict[str, str]:
    """The text of each field of a template that was filled in with these texts; the others keep their own.

    Raises SourceError where it is no sound XML.
    """
    found: dict[str, str] = {}
    for field in xml_tree(data, path, "a template", "FreeCAD").iter(f"{SVG}text"):
        if key := editable(field):
            found.setdefault(key, texts.get(key, "".join(field.itertext()).strip()))
    return found


def safe_svg(data: bytes, text_of: Callable[[int, str], str | None], path: Path, title: str) -> Element:
    """An SVG without what could run, or leads out of the file. title: for errors.

    text_of: the text of a field, by its number and its key; None: it keeps its own.

    Raises:
        SourceError: it is no sound XML. DamagedError: it is no SVG.
    """
    root = xml_tree(data, path, title, "FreeCAD")
    if root.tag != f"{SVG}svg":
        raise DamagedError(f"{title} is no SVG")
    fields = [(field, key) for field in root.iter(f"{SVG}text") if (key := editable(field))]
    for number, (field, key) in enumerate(fields):
        if (text := text_of(number, key)) is not None:
            _fill(field, text)
    out = Element("svg")
    out.attrib.update(_attributes(root))
    out.extend(_cleaned(root))
    return out


def is_safe(elements: str, path: Path) -> bool:
    """Whether SVG elements hold nothing that could run, or leads out of the file. path: for errors.

    Raises SourceError where they are no sound XML.
    """
    root = xml_tree(f'<svg xmlns="{SVG[1:-1]}">{elements}</svg>'.encode(), path, "its template", "a page")
    known = {f"{SVG}{name}" for name in (*_DRAWN, "svg")}
    return all(each.tag in known and len(dict(_attributes(each))) == len(each.attrib) for each in root.iter())


def editable(field: Element) -> str:
    """The key of a field; empty where it is none."""
    return next((value for name, value in field.items() if _local(name) == "editable"), "")


def _fill(field: Element, text: str) -> None:
    """Put a text in the place of a field's own."""
    spans = field.findall(f"{SVG}tspan")
    target = spans[0] if spans else field
    for child in list(target):
        target.remove(child)
    target.text = text


def _cleaned(parent: Element) -> Iterator[Element]:
    """The children of an element, without what is not drawn; names without their namespace."""
    for child in parent:
        if not isinstance(child.tag, str) or not child.tag.startswith(SVG) or _local(child.tag) not in _DRAWN:
            continue
        own = Element(_local(child.tag))
        own.attrib.update(_attributes(child))
        own.text, own.tail = child.text, child.tail
        own.extend(_cleaned(child))
        yield own


def _attributes(element: Element) -> Iterator[tuple[str, str]]:
    """The attributes that are kept: those of SVG itself that neither run anything nor lead out of the file."""
    for name, value in element.items():
        plain = _local(name)
        if name == _SPACE:
            yield "xml:space", value
        elif plain == "href":
            if value.startswith(("#", "data:image/")):
                yield "href", value
        elif "}" not in name and not plain.startswith("on") and _harmless(value):
            yield name, value


def _harmless(value: str) -> bool:
    """Whether the value of an attribute refers to nothing outside the file."""
    low = "".join(value.split()).lower()
    return "url(" not in low.replace("url(#", "") and "javascript:" not in low and "@import" not in low


def _local(name: str) -> str:
    return name.rpartition("}")[2]


_SPACE = "{http://www.w3.org/XML/1998/namespace}space"

_DRAWN = frozenset(
    (
        *("g", "defs", "switch", "title", "desc"),
        *("path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "image", "text", "tspan"),
        *("linearGradient", "radialGradient", "stop"),
    )
)
"""Elements that are kept. Those that repeat others are not: a few of them could stand for billions."""
