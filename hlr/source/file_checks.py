"""Checks of a file before it is read, and errors that say what it looks like."""

from __future__ import annotations

import codecs
import os
from pathlib import Path

from hlr.errors import SourceError


def check_readable(path: Path) -> None:
    """Check that a path is a file that can be read.

    Raises:
        SourceError: it is missing, a folder, not readable, or empty.
    """
    try:
        if path.is_dir():
            raise SourceError(f"{path} is a folder: name a file in it.")
        if not path.exists():
            if str(path) == "-":
                raise SourceError("A model is read from a file, not from standard input: save it to a file first.")
            raise SourceError(f"{path} does not exist: check the name and the folder.")
        if not path.is_file():
            raise SourceError(f"{path} is not a regular file: save the model to a file first.")
        if path.stat().st_size == 0:
            raise SourceError(f"{path.name} is empty (0 bytes): export it again.")
        with path.open("rb"):
            pass
    except PermissionError:
        raise SourceError(f"{path} cannot be read: permission denied.") from None
    except (OSError, ValueError) as error:
        raise SourceError(f"{_printable(path)} cannot be read: {_reason(error)}.") from None


def check_signature(path: Path, mark: bytes, what: str) -> None:
    """Check that the first 4096 bytes of a file contain `mark`. what: the format, for the error.

    Raises:
        SourceError: they do not; the message says what the content looks like.
    """
    with path.open("rb") as file:
        head = file.read(4096)
    if mark not in head:
        raise wrong_format(path, what, head)


def wrong_format(path: Path, what: str, head: bytes) -> SourceError:
    """The error that a file is not of the format `what`; head: its first bytes, which say what it looks like."""
    seems = describe_content(head)
    if seems.removeprefix("a text ").removeprefix("a ").removeprefix("an ") in what:
        return SourceError(f"{path.name} is not {what} that can be read: its beginning is broken; export it again.")
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        seems = "text in UTF-16; save it as UTF-8, or export it again"
    return SourceError(f"{path.name} is not {what}: it looks like {seems}.")


def without_mark(data: bytes) -> bytes:
    """The content of a file in text without the byte order mark that some editors put before it."""
    return data.removeprefix(codecs.BOM_UTF8)


def content_of(path: Path) -> str:
    """The kind of content that a file seems to have, in words."""
    with path.open("rb") as file:
        return describe_content(file.read(4096))


def describe_content(head: bytes) -> str:
    """The kind of content that the first bytes of a file suggest, in words."""
    text = head.lstrip(b"\xef\xbb\xbf \t\r\n")
    lower = text[:200].lower()
    if lower.startswith((b"<!doctype html", b"<html")):
        return "a web page (was the download a login or error page?)"
    if text.startswith(b"version https://git-lfs"):
        return "a Git LFS pointer (run: git lfs pull)"
    for mark, name in _SIGNATURES:
        if text.startswith(mark):
            return name
    if b"\0" in head:
        return "binary data of another kind"
    return "text of another kind"


_SIGNATURES = (
    (b"ISO-10303-21", "a STEP file"),
    (b"solid", "a text STL file"),
    (b"glTF", "a GLB file"),
    (b"PK\x03\x04", "a ZIP archive"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"ply", "a PLY file"),
    (b"OFF", "an OFF file"),
    (b"%PDF", "a PDF document"),
    (b"DBRep_DrawableShape", "a BREP file"),
    (b"CASCADE Topology", "a BREP file"),
    (b"\x89PNG", "a picture"),
    (b"\xff\xd8\xff", "a picture"),
    (b"<?xml", "XML"),
    (b"{", "JSON"),
)


def _reason(error: BaseException) -> str:
    if isinstance(error, OSError) and error.errno is not None:
        return os.strerror(error.errno).lower()
    return str(error)


def _printable(path: Path) -> str:
    return str(path).replace("\0", "\\0")[:200]
