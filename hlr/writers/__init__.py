"""Drawings as files: SVG, PDF and the JSON exchange format."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

from hlr.errors import WriteError

if TYPE_CHECKING:
    from hlr.drawing import Drawing

__all__ = ["FORMATS", "format_of", "note_time", "render", "write"]

FORMATS = ("svg", "pdf", "json")


def format_of(path: str | Path) -> str:
    """The format that the ending of `path` names. Raises WriteError for any other ending."""
    ending = Path(path).suffix.lower().removeprefix(".")
    if ending not in FORMATS:
        has = f"the ending .{ending} is unknown" if ending else "the name has no ending"
        raise WriteError(f"cannot tell the format of {path}: {has}; use .svg, .pdf or .json")
    return ending


def render(drawing: Drawing, format: str) -> bytes:
    """The drawing as a file's content; format is one of FORMATS. Raises WriteError for any other."""
    # Each writer is imported only when it is used: PDF needs a library that the others do not.
    if format == "svg":
        from hlr.writers.svg import svg

        return svg(drawing)
    if format == "pdf":
        from hlr.writers.pdf import pdf

        return pdf(drawing)
    if format == "json":
        from hlr.writers.json import document

        return document(drawing)
    raise WriteError(f"unknown format {format!r}; use svg, pdf or json")


def write(drawing: Drawing, path: str | Path) -> Path:
    """Write a drawing in the format that the ending of `path` names, and return the path.

    The file appears whole or not at all; what was there before stays if anything fails. The time goes into
    `drawing.timings["write"]`, and into its "total". Raises WriteError, in one sentence, for an unknown ending, a
    missing folder, a lack of permission or a full disk.
    """
    from hlr.writers import files

    begin = time.perf_counter()
    path = Path(path)
    kind = format_of(path)
    files.check(path)
    files.place({path: render(drawing, kind)})
    note_time(drawing, time.perf_counter() - begin)
    return path


def note_time(drawing: Drawing, seconds: float) -> None:
    """Put the time of writing into a drawing's timings, and into their total; a later one replaces it."""
    timings = drawing.timings
    timings["total"] = timings.get("total", 0.0) - timings.get("write", 0.0) + seconds
    timings["write"] = seconds
