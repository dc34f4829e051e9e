"""Files that a drawing must not overwrite: all that are read for it, and other models."""

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
    given = os.fspath(path)
    names = [given, os.path.realpath(given)] if os.path.islink(given) else [given]
    for name in names:
        if is_model(name) and path.is_file():
            raise WriteError(f"cannot write {path}: it is a model, and a drawing would destroy it; give another name")


SOURCE = "the source"
"""What a model is called that is read. The files that it names belong to it."""


class Originals:
    """Files that are read, so that nothing may be written to them, however they are spelled or linked.

    read: the path of each, and what it is called; `SOURCE` stands for a model and for the files that it names
    """

    def __init__(self, read: Iterable[tuple[Path, str]]) -> None:
        self._called: dict[tuple[int, int], str] = {}
        for path, what in read:
            self._add(path, what)
            for side in _sides(path) if what == SOURCE else ():
                self._add(side, "a file of the model")

    def _add(self, path: Path, what: str) -> None:
        file = _identity(path)
        if file is not None:
            self._called.setdefault(file, what)

    def called(self, path: Path) -> str | None:
        """What the file at `path` is called; None: it is not there, or is none of these."""
        file = _identity(path)
        return None if file is None else self._called.get(file)

    def check(self, paths: Iterable[Path]) -> None:
        """Raise WriteError where one of `paths` is one of these files."""
        for path in paths:
            what = self.called(path)
            if what is not None:
                raise WriteError(f"cannot write {path}: it is {what}, and would be destroyed; give another name")


def _identity(path: Path) -> tuple[int, int] | None:
    """Device and number of a file, through links; None: there is none."""
    try:
        there = os.stat(path)
    except (OSError, ValueError):
        return None
    return there.st_dev, there.st_ino


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
