"""Drawings as files: SVG, PDF and the JSON exchange format."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args

from hlr.errors import WriteError

if TYPE_CHECKING:
    from hlr.drawing import Drawing

__all__ = ["FORMATS", "Format", "checked_format", "format_of", "render", "timed", "write"]

Format = Literal["svg", "pdf", "json"]
"""What a drawing is written as."""

FORMATS: tuple[Format, ...] = get_args(Format)


def format_of(path: str | Path) -> Format:
    """The format that the ending of `path` names. Raises WriteError for any other ending."""
    ending = Path(path).suffix.lower().removeprefix(".")
    for known in FORMATS:
        if ending == known:
            return known
    has = f"the ending .{ending} is unknown" if ending else "the name has no ending"
    raise WriteError(f"cannot tell the format of {path}: {has}; use .svg, .pdf or .json")


def checked_format(format: Any) -> Format:
    """The format; raises WriteError for what is none."""
    for known in FORMATS:
        if format == known:
            return known
    raise WriteError(f"unknown format {format!r}; use svg, pdf or json")


def render(drawing: Drawing, format: str) -> bytes:
    """The drawing as a file's content; format is one of FORMATS. Raises WriteError for any other."""
    format = checked_format(format)
    # Each writer is imported only when it is used: PDF needs a library that the others do not.
    if format == "svg":
        from hlr.writers.svg import svg

        return svg(drawing)
    if format == "pdf":
        from hlr.writers.pdf import pdf

        return pdf(drawing)
    from hlr.writers.json import document

    return document(drawing)


def write(drawing: Drawing, file: Any, format: Any = None) -> Path | None:
    """Write a drawing into a file, named by its path, or into a binary file object.

    format: needed for a file object; of a path the ending names it otherwise. Returns the path, or None. A file appears
    whole or not at all; what was there before stays if anything fails. Raises WriteError, in one sentence, for an
    unknown format, a missing folder, a lack of permission or a full disk.
    """
    from hlr.writers import files

    if hasattr(file, "write"):
        if format is None:
            raise WriteError("a file object has no ending that names the format: give format='svg', 'pdf' or 'json'")
        files.put(file, render(drawing, checked_format(format)))
        return None
    path = files.path_of(file)
    kind = format_of(path) if format is None else checked_format(format)
    files.place({path: render(drawing, kind)})
    return path


def timed(drawing: Drawing, seconds: float) -> Drawing:
    """The drawing with the time that writing it took among its timings, and in their total."""
    total = drawing.timings.get("total", 0.0) - drawing.timings.get("write", 0.0) + seconds
    return replace(drawing, timings={**drawing.timings, "write": seconds, "total": total})
