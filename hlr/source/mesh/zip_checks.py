"""Limits of 3MF files (ZIP archives of XML), checked before they are read."""

from __future__ import annotations

import math
import re
import zipfile
import zlib
from pathlib import Path

from hlr.errors import SourceError

MAX_EXPANDED = 4 << 30
"""Bytes that a 3MF archive may unpack to."""

MAX_RATIO = 300
"""Ratio of compression that only a ZIP bomb exceeds; plain XML does not."""


MAX_PLACED = 1_000_000
"""Bodies that a file may place: nested components can double them with every level."""

_TAG = re.compile(rb"<(?:\w+:)?(object|component|item)\b([^>]*)>")
_ID = re.compile(rb"\b(?:object)?id\s*=\s*[\"'](\d+)")


def check_3mf_archive(path: Path, size: int) -> None:
    """Check that a 3MF archive of `size` bytes can be unpacked, parsed and placed within the limits.

    Raises:
        SourceError: it cannot; the message says why.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            entries = archive.infolist()
            total = sum(entry.file_size for entry in entries)
            if total > MAX_EXPANDED or (total > 64 << 20 and total > MAX_RATIO * size):
                raise SourceError(f"{path.name} would unpack to {total >> 20} MiB: it is refused as a ZIP bomb.")
            models = [entry for entry in entries if entry.filename.lower().endswith(".model")]
            if not any("3d/3dmodel.model" in entry.filename.lower() for entry in entries):
                raise SourceError(f"{path.name} is a ZIP archive without 3D/3dmodel.model: it is no 3MF file.")
            for entry in models:
                text = archive.read(entry)
                prolog = _prolog(text[: 1 << 20])
                if "<!DOCTYPE" in prolog or "<!ENTITY" in prolog:
                    raise SourceError(f"{path.name} declares XML entities, which no 3MF file needs: it is refused.")
                if "<" not in prolog:
                    raise SourceError(f"{path.name} cannot be read as 3MF: {entry.filename} does not begin as XML.")
                if _placed(text) > MAX_PLACED:
                    raise SourceError(
                        f"{path.name} places more than {MAX_PLACED} bodies, or a body within itself: it is refused."
                    )
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, OSError) as error:
        raise SourceError(f"{path.name} cannot be read as 3MF: the archive is broken or encrypted ({error}).") from None


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
