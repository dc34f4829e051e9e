"""`hlr.load`: reads a drawing from the exchange format, which `hlr/docs/json.md` describes."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import IO, Any

from hlr.drawing.drawing import Drawing, DrawnPart, DrawnView
from hlr.drawing.fill import Fill
from hlr.drawing.line import Bounds
from hlr.drawing.section import Section
from hlr.errors import SourceError
from hlr.tables.documents import VERSIONS
from hlr.writers.json import FORMAT
from hlr.writers.json_page import PAGE_FORMAT
from hlr.writers.loaded_records import common, direction, lines_of, page_of
from hlr.writers.revive import revived

Box = tuple[float, float, float, float]


def load(file: str | os.PathLike[str] | IO[Any]) -> Drawing:
    """The drawing that a JSON file of hlr holds: equal to the one that was saved, but for what was asked for.

    A page of several views comes back as one, with its `sheet`.

    file: a path, or a file object, open for bytes or for text. `request` is None, for the file does not hold it.
    Raises SourceError, in one sentence, for a file that cannot be read or is none of hlr's.

    >>> import hlr
    >>> drawing = hlr.draw("part.step")
    >>> path = drawing.save("part.json")
    >>> hlr.load(path) == drawing
    True
    """
    if hasattr(file, "read"):
        name = str(getattr(file, "name", "") or f"the {type(file).__name__}")
        try:
            return loads(file.read(), name)
        except (OSError, ValueError) as error:
            raise SourceError(f"{name} cannot be read: {error}") from None
    from hlr.source.file_checks import check_readable

    try:
        path = Path(file)
    except TypeError:
        raise SourceError(f"{file!r} cannot be read: give a path or a file object") from None
    check_readable(path)
    try:
        return loads(path.read_bytes(), path.name)
    except OSError as error:
        raise SourceError(f"{path} cannot be read: {error.strerror}") from None


def loads(text: str | bytes, name: str = "the text") -> Drawing:
    """The drawing that the text of a JSON file holds; name: what errors call it. Raises SourceError."""
    try:
        document = json.loads(text)
    except (ValueError, RecursionError):
        raise SourceError(f"{name} is no JSON: save a drawing as .json and load that") from None
    except TypeError:
        raise SourceError(f"{name} is neither text nor bytes, but {type(text).__name__}") from None
    kind = document.get("format") if isinstance(document, dict) else None
    if kind not in (FORMAT, PAGE_FORMAT):
        raise SourceError(f"{name} is no drawing of hlr: save a drawing as .json and load that")
    version = VERSIONS[kind]
    if document.get("version") != version:
        raise SourceError(
            f"{name} has version {document.get('version')!r} of the format, not {version}: draw the model again"
        )
    try:
        return _drawing(document) if kind == FORMAT else _page(document, name)
    except KeyError as error:
        raise SourceError(f"{name} is damaged: {error} is missing") from None
    except (TypeError, ValueError) as error:
        raise SourceError(f"{name} is damaged: {error}") from None


def _page(document: dict[str, Any], name: str) -> Drawing:
    from hlr.writers.loaded_page import drawing_of_page

    return drawing_of_page(document, name)


def _drawing(document: dict[str, Any]) -> Drawing:
    view: DrawnView = revived(DrawnView, document["view"], "view")
    for name in ("direction", "right", "up"):
        direction(getattr(view, name), f"view.{name}")
    parts: tuple[DrawnPart, ...] = revived(tuple[DrawnPart, ...], document["parts"], "parts")
    return Drawing(
        **common(document),
        view=view,
        origin=revived(tuple[float, float], document["origin"], "origin"),
        parts=parts,
        lines=tuple(lines_of(document["lines"], len(parts))),
        fill=revived(Fill | None, document.get("fill"), "fill"),
        window=None if document.get("window") is None else Bounds(*revived(Box, document["window"], "window")),
        section=revived(Section | None, document.get("section"), "section"),
        page=None if document.get("page") is None else page_of(document["page"]),
    )
