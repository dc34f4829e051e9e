"""Limits of 3MF files (ZIP archives of XML), checked before they are read."""

from __future__ import annotations

import math
import re
from pathlib import Path

from hlr.errors import SourceError
from hlr.source.archive import declares_entities, open_archive

MAX_PLACED = 1_000_000
"""Bodies that a file may place: nested components can double them with every level."""

_TAG = re.compile(rb"<(?:\w+:)?(object|component|item)\b([^>]*)>")
_ID = re.compile(rb"\b(?:object)?id\s*=\s*[\"'](\d+)")


def check_3mf_archive(path: Path) -> None:
    """Check that a 3MF archive can be unpacked, parsed and placed within the limits.

    Raises:
        SourceError: it cannot; the message says why.
    """
    with open_archive(path, "3MF") as archive:
        entries = archive.infolist()
        models = [entry for entry in entries if entry.filename.lower().endswith(".model")]
        if not any("3d/3dmodel.model" in entry.filename.lower() for entry in entries):
            raise SourceError(f"{path.name} is a ZIP archive without 3D/3dmodel.model: it is no 3MF file.")
        for entry in models:
            text = archive.read(entry)
            prolog = _prolog(text[: 1 << 20])
            if "<!DOCTYPE" in prolog or "<!ENTITY" in prolog:
                raise declares_entities(path, "3MF")
            if "<" not in prolog:
                raise SourceError(f"{path.name} cannot be read as 3MF: {entry.filename} does not begin as XML.")
            if _placed(text) > MAX_PLACED:
                raise SourceError(
                    f"{path.name} places more than {MAX_PLACED} bodies, or a body within itself: it is refused."
                )


def _prolog(start: bytes) -> str:
    """The text before the root element <model>; all of it where there is none."""
    wide = start[:2] in (b"\xff\xfe", b"\xfe\xff")
    text = start.decode("utf-16" if wide else "latin-1", errors="replace").replace("\0", "")
    root = re.search(r"<(?:\w+:)?model[\s>]", text)
    return text[: root.end()] if root else text


def _placed(text: bytes) -> float:
    """Number of bodies that a model places, nested components included; infinite where one contains itself."""
    if b"component" not in text:
        return 0.0
    inside: dict[bytes, list[bytes]] = {}
    items: list[bytes] = []
    here = items
    for tag, attributes in _TAG.findall(text):
        number = _ID.search(attributes)
        if number is None:
            continue
        if tag == b"object":
            here = inside.setdefault(number[1], [])
        else:
            (items if tag == b"item" else here).append(number[1])
    # Depth first, an object's own parts before itself; None while they are being counted.
    counts: dict[bytes, float | None] = {}
    todo = items[::-1]
    while todo:
        key = todo[-1]
        parts = inside.get(key, [])
        if key not in counts:
            counts[key] = None
            todo += [part for part in parts if part not in counts]
            if any(counts.get(part, 0.0) is None for part in parts):
                return math.inf
            continue
        todo.pop()
        if counts[key] is None:
            counts[key] = sum(counts[part] or 0.0 for part in parts) if parts else 1.0
    return sum(counts[item] or 0.0 for item in items)
