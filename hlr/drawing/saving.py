"""Drawings and pictures as files: the format is a row of `hlr.tables.writers`.

Drawings and pictures are plain objects here: their records import this module, not the other way round.
"""

from __future__ import annotations

import os
from itertools import combinations
from pathlib import Path
from typing import Any, Literal

from hlr.common.threads import at_most
from hlr.drawing import files
from hlr.errors import WriteError
from hlr.tables.writers import DEPTH, FACES, PICTURE, WRITERS, formats

Format = Literal["svg", "pdf", "dxf", "png", "json"]
"""What a drawing is written as, for type checkers; `hlr.tables.writers.WRITERS` is what there is."""


def format_of(path: str | Path) -> str:
    """The format that the ending of `path` names. Raises WriteError for any other ending."""
    ending = os.path.splitext(path)[1].lower().removeprefix(".")
    if ending in WRITERS:
        return ending
    has = f"the ending .{ending} is unknown" if ending else "the name has no ending"
    raise WriteError(f"cannot tell the format of {path}: {has}; use {formats('.')}")


def checked_format(format: Any) -> str:
    """The format; raises WriteError for what is none."""
    if isinstance(format, str) and format in WRITERS:
        return format
    raise WriteError(f"unknown format {format!r}; use {formats()}")


def render(drawing: object, format: str) -> bytes:
    """The drawing as a file's content; format is the name of a writer. Raises WriteError for any other."""
    writer, request = WRITERS[checked_format(format)], getattr(drawing, "request", None)
    with at_most(0 if request is None else request.options.threads):
        return writer.render(drawing)


def write(drawing: object, file: Any, format: Any = None) -> Path | None:
    """Write a drawing into a file, named by its path, or into a binary file object.

    format: needed for a file object; of a path the ending names it otherwise. Returns the path, or None. A file appears
    whole or not at all; what was there before stays if anything fails. Raises WriteError, in one sentence, for an
    unknown format, a missing folder, a lack of permission or a full disk.
    """
    if hasattr(file, "write"):
        if format is None:
            raise WriteError(f"a file object has no ending that names the format: give format={formats(around=_QUOTE)}")
        files.write_into(file, render(drawing, checked_format(format)))
        return None
    path = files.path_of(file)
    kind = format_of(path) if format is None else checked_format(format)
    files.write_all({path: render(drawing, kind)})
    return path


_QUOTE = "'"


def write_picture(picture: object, file: Any, depth: Any, ids: Any) -> Path | None:
    """Write all files or none, then into file objects; returns the picture's path, or None for a file object."""
    asked = [(file, PICTURE), *((f, writer) for f, writer in ((depth, DEPTH), (ids, FACES)) if f is not None)]
    targets = [(f if hasattr(f, "write") else check_png(files.path_of(f)), writer) for f, writer in asked]
    if any(one == other for (one, _), (other, _) in combinations(targets, 2)):
        raise WriteError(
            f"two maps would be written to one file; give picture, depth and ids a name each, not {targets[0][0]}"
        )
    made = [(target, writer.render(picture)) for target, writer in targets]
    files.write_all({target: data for target, data in made if isinstance(target, Path)})
    for target, data in made:
        if not isinstance(target, Path):
            files.write_into(target, data)
    first = targets[0][0]
    return first if isinstance(first, Path) else None


def check_png(path: str | Path) -> Path:
    """The path; raises WriteError where it does not end in .png."""
    path = Path(path)
    if path.suffix.lower() != ".png":
        raise WriteError(f"cannot write {path}: a picture is written as PNG; give a name that ends in .png")
    return path
