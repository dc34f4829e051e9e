"""A PDF file of one page, read by PDFium: its stroked paths. Texts, pictures and filled areas are counted.

A file of ours names the layer of each line: its class, and whether it is visible. In others dashed lines are hidden and
those without dashes visible; where none is dashed, nothing is known. FreeCAD's pages, which Qt writes, have the edges
of views with another join than all else.
"""

from __future__ import annotations

import re
import zlib
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

from hlr.compare.lines.sketch import About, Sketch, Trait
from hlr.compare.reading.dashes import CENTRE, HIDDEN, UNKNOWN, VISIBLE, by_dashes
from hlr.compare.reading.pdf_paths import Matrix, after, paths_of
from hlr.compare.reading.pdf_paths import Path as Drawn
from hlr.compare.reading.stated_view import stated_as_text, views_in_text
from hlr.errors import SourceError
from hlr.tables.line_classes import LINE_CLASSES

MOST_BYTES = 1 << 26
"""Of a file."""

MOST_EXPANDED = 1 << 28
"""Bytes that the streams of a file may unpack to."""

_STREAM = re.compile(rb"stream\r?\n")

_TO_MM: Matrix = (25.4 / 72.0, 0.0, 0.0, 25.4 / 72.0, 0.0, 0.0)
_AS_IT_IS: Matrix = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)

_LAYER = re.compile(rf"(Visible|Hidden) ({'|'.join(LINE_CLASSES)})")
"""Name of a layer of ours, as `hlr.writers.pdf.layer_name` makes it."""

_ROUND, _BEVEL = 1, 2


def read_pdf(path: Path, sketch: Sketch) -> About:
    """Add the lines of a file to a sketch. Returns what else the file says.

    Raises SourceError, in one sentence, for a file that is no PDF, or encrypted, damaged, too large, or of many pages.
    """
    import pypdfium2

    _check(path)
    try:
        document = pypdfium2.PdfDocument(path)
    except pypdfium2.PdfiumError as error:
        raise SourceError(f"{path.name} cannot be read as PDF: it is damaged or encrypted ({error})") from None
    try:
        if len(document) != 1:
            raise SourceError(f"{path.name} has {len(document)} pages: give a file for each page")
        page = document[0]
        left_out: Counter[str] = Counter()
        paths = paths_of(page, left_out, path.name)
        if _told(document, "Creator") == "hlr":
            view = _told(document, "View")
            stated, scale = stated_as_text(view)
            about = _read_ours(paths, left_out, sketch)
            about = replace(about, stated=stated, scale=scale, several=views_in_text(view))
        else:
            about = _read_other(paths, left_out, sketch, _told(document, "Producer").startswith("Qt "))
        page.close()
    except pypdfium2.PdfiumError as error:
        raise SourceError(f"{path.name} cannot be read as PDF: {error}") from None
    finally:
        document.close()
    if about.foreign and not len(sketch):
        raise SourceError(f"{path.name} has no lines: give the PDF of a drawing, not a picture of one")
    return about


def _told(document: Any, key: str) -> str:
    """What a file says of itself; nothing where that is damaged."""
    try:
        return str(document.get_metadata_value(key))
    except UnicodeDecodeError:
        return ""


def _check(path: Path) -> None:
    """Refuse what would unpack to more than memory holds."""
    too_much = SourceError(f"{path.name} would take too much memory: it is refused")
    if path.stat().st_size > MOST_BYTES:
        raise too_much
    content, total = path.read_bytes(), 0
    for mark in _STREAM.finditer(content):
        if content[mark.end() : mark.end() + 1] != b"x":  # as zlib begins
            continue
        try:
            total += len(zlib.decompressobj().decompress(content[mark.end() :], MOST_EXPANDED))
        except zlib.error:
            continue
        if total >= MOST_EXPANDED:
            raise too_much


def _read_ours(paths: Any, left_out: Counter[str], sketch: Sketch) -> About:
    """Its coordinates are millimetres of the drawing, before they are mapped to the page."""
    parts: dict[str, int] = {}
    for path in paths:
        layers = path.layers()
        found = _LAYER.fullmatch(layers[-1]) if layers else None
        if found is None:
            left_out["template and filled areas"] += 1
            continue
        part = parts.setdefault(layers[0], len(parts)) if len(layers) > 1 else -1
        path.draw(sketch, Trait(LINE_CLASSES[found[2]].number, int(found[1] == "Visible"), part), _AS_IT_IS)
    return About(tuple(parts), left_out=dict(sorted(left_out.items())))


def _read_other(paths: Any, left_out: Counter[str], sketch: Sketch, by_qt: bool) -> About:
    lines: list[Drawn] = []
    for path in paths:
        if path.stroked and not path.filled:
            lines.append(path)
        else:
            left_out["filled areas"] += 1
    edges = [line for line in lines if _is_edge_of_freecad(line)] if by_qt else []
    # Without a window FreeCAD gives edges no width. Section lines and leaders, drawn by the same kind of pen, have one.
    edges = [line for line in edges if line.width == 0.0] or edges
    if edges:
        left_out["lines of template and dimensions"] += len(lines) - len(edges)
        lines = edges
    seen = [by_dashes(line.dashes[::2]) for line in lines]
    left_out["centre lines"] += seen.count(CENTRE)
    usual = VISIBLE if HIDDEN in seen else UNKNOWN
    for line, visible in zip(lines, seen, strict=True):
        if visible != CENTRE:
            trait = Trait(-1, usual if visible == UNKNOWN else visible)
            line.draw(sketch, trait, after(_TO_MM, line.to_page))
    return About((), foreign=True, left_out={word: count for word, count in sorted(left_out.items()) if count})


def _is_edge_of_freecad(line: Drawn) -> bool:
    return (line.cap, line.join) == (_ROUND, _BEVEL)
