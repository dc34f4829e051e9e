"""What a format leaves out of a page: letters of its texts."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from hlr.drawing.drawing import Drawing
from hlr.drawing.notes import Note
from hlr.tables.entry import listed
from hlr.writers.page_fonts import missing_letters

MOST_LETTERS = 5
"""Letters that are named one by one."""


def left_out(drawing: Drawing, format: str, file: str) -> list[Note]:
    """Notes on what is on the page, but not in a file of this format. file: what the notes call it."""
    template = "" if drawing.sheet is None else drawing.sheet.template
    page = f'Page "{drawing.view.name}":'
    if template and format in ("pdf", "png"):
        letters = _missing_letters(template)
        if letters:
            named = [f'"{letter}"' for letter in letters[:MOST_LETTERS]]
            if len(letters) > MOST_LETTERS:
                named.append(f"{len(letters) - MOST_LETTERS} more")
            text = f"{page} {listed(named, 'and')} not drawn in {file}, but ? instead: SVG has all letters."
            return [Note("page-items-left-out", text)]
    return []


def _missing_letters(template: str) -> list[str]:
    """The letters of a template's texts that PDF has no font for, each once."""
    try:
        whole = ElementTree.fromstring(f"<svg>{template}</svg>")
    except ElementTree.ParseError:
        return []  # the writer says so
    return missing_letters("".join(_texts(whole, False)))


def _texts(element: Element, inside: bool) -> Iterator[str]:
    """What is to be read in an element. inside: it is part of a text."""
    if element.get("display") == "none" or element.get("visibility") == "hidden":
        return
    inside = inside or element.tag.rpartition("}")[2] == "text"
    if inside:
        yield element.text or ""
    for child in element:
        yield from _texts(child, inside)
        if inside:
            yield child.tail or ""
