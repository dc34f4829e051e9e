"""Files that a STEP file refers to: parts of an assembly that are kept in files of their own."""

from __future__ import annotations

import os
import re
from pathlib import Path

_WORD = b"DOCUMENT_FILE"
_REFERENCE = re.compile(_WORD + rb"\s*\(\s*'([^'\r\n]{1,300})'")
"""A file that a STEP file refers to."""

_PIECE_BYTES, _OVERLAP_BYTES = 1 << 20, 400
"""Files are read piece by piece; a reference that two pieces share lies whole in what the next one begins with."""

_MOST_REFERENCES = 10_000
"""Of one source."""


def references(source: Path) -> list[Path]:
    """Files that a STEP file refers to, and those that these refer to. Some may not be there."""
    found = [Path(os.path.realpath(source))]
    for file in found:  # which grows meanwhile
        if not _is_step(file) or not file.is_file():
            continue
        try:
            paths = [(file.parent / name.decode("utf-8", "replace")).resolve() for name in _named(file)]
        except (OSError, ValueError):
            continue
        # A file from anybody may name any other: only models count.
        new = [path for path in paths if _is_step(path) and path not in found]
        found += new[: _MOST_REFERENCES - len(found)]
    return found[1:]


def _named(file: Path) -> dict[bytes, None]:
    """The names, each once, in the order of the file."""
    found: dict[bytes, None] = {}
    before = b""
    with file.open("rb") as opened:
        while piece := opened.read(_PIECE_BYTES):
            text = before + piece
            if _WORD in text:
                found |= dict.fromkeys(_REFERENCE.findall(text))
            before = text[-_OVERLAP_BYTES:]
    return found


def _is_step(path: Path) -> bool:
    return path.suffix.lower() in (".step", ".stp")
