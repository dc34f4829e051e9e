"""Files that a drawing must not overwrite: the model that it shows, and files that belong to models."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from hlr.errors import WriteError
from hlr.tables.readers import is_model

_HEAD = 1 << 20
"""Bytes: an OBJ file names its materials at its beginning."""

_WORDS = 12
"""Words of a line that may name a file; a longer line is not read further."""

_LIBRARY = re.compile(rb"^[ \t]*mtllib[ \t]+(.+?)[ \t\r]*$", re.MULTILINE)
_TEXTURE = re.compile(
    rb"^[ \t]*(?:map_\w+|bump|disp|decal|refl|norm)[ \t]+(.+?)[ \t\r]*$", re.MULTILINE | re.IGNORECASE
)


def check_model(path: Path) -> None:
    """Raise WriteError where `path` is there and is a model, by its ending or by that of the file that it links to."""
    names = [str(path), os.path.realpath(path)] if os.path.islink(path) else [str(path)]
    for name in names:
        if is_model(name) and path.is_file():
            raise WriteError(f"cannot write {path}: it is a model, and a drawing would destroy it; give another name")


def check_source(paths: Iterable[Path], source: str | os.PathLike[str], template: str | None = None) -> None:
    """Raise WriteError where one of `paths` is the source, however it is spelled or linked, or a file that it names.

    template: of the page, which must stay as well
    """
    originals = [(Path(source), "the source"), *((side, "a file of the model") for side in _sides(Path(source)))]
    originals += [] if template is None else [(Path(template), "the template")]
    for path in paths:
        for original, what in originals:
            if _same(path, original):
                raise WriteError(f"cannot write {path}: it is {what}, and would be destroyed; give another name")


def _same(a: Path, b: Path) -> bool:
    try:
        return os.path.samefile(a, b)
    except (OSError, ValueError):
        return False


def _sides(source: Path) -> Iterator[Path]:
    """Materials of an OBJ file, and their textures."""
    if source.suffix.lower() != ".obj":
        return
    for library in _named(source, _LIBRARY):
        yield library
        yield from _named(library, _TEXTURE)


def _named(file: Path, pattern: re.Pattern[bytes]) -> Iterator[Path]:
    """Files that a file names, in its own folder; the name may hold blanks, and may follow options."""
    try:
        with file.open("rb") as opened:
            head = opened.read(_HEAD)
    except (OSError, ValueError):
        return
    for match in pattern.finditer(head):
        words = match[1].decode("utf-8", "replace").split()[:_WORDS]
        for i in range(len(words)):
            for j in range(i + 1, len(words) + 1):
                yield file.parent / " ".join(words[i:j]).replace("\\", "/")
