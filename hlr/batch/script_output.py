"""What a script prints while it is drawn. Its end stands in the report where the script fails."""

from __future__ import annotations

import io
import os
import sys
from contextlib import suppress
from typing import BinaryIO, cast

MOST = 4000
"""Characters that are kept."""

_ROOM = 1 << 20
"""Bytes that a script may print until the worker throws away all but the end."""

_LONGEST = 200
"""Characters that are shown of a line."""


def last_lines(text: str, most: int) -> list[str]:
    """The last lines of what was printed, so many at most, without those that are empty, for people to read."""
    lines = [line.rstrip() for line in text.split("\n") if line.strip()][-most:]
    return [line if len(line) <= _LONGEST else f"{line[: _LONGEST - 4]} ..." for line in lines]


class ScriptOutput:
    """A place in memory that a child's standard output and errors go to, made before the child (Linux).

    Where the system has none, what is printed goes nowhere.
    """

    def __init__(self) -> None:
        self._file: int | None = None
        self._end = b""
        with suppress(OSError, AttributeError):
            self._file = os.memfd_create("hlr-printed")
            # What is added goes to the end, wherever that is: whoever has the file may shorten it.
            self._adding = os.open(f"/proc/self/fd/{self._file}", os.O_WRONLY | os.O_APPEND)

    def take(self) -> None:
        """In the child: print to this place from now on."""
        if self._file is not None:
            os.dup2(self._adding, 1)
            os.dup2(self._adding, 2)
            # Without a buffer, as with `python -u`: the child may be killed in the middle of a line.
            sys.stdout, sys.stderr = _unbuffered(1), _unbuffered(2)

    def shorten(self) -> None:
        """In the worker: keep the end alone where much was printed."""
        if self._file is not None and os.fstat(self._file).st_size > _ROOM:
            self._end = self._bytes()
            os.ftruncate(self._file, 0)

    def text(self) -> str:
        """The last lines that were printed."""
        text = self._bytes().decode("utf-8", "replace")
        if len(text) > MOST:
            text = text[-MOST:].partition("\n")[2] or text[-MOST:]
        return text.strip("\n")

    def close(self) -> None:
        """Give the place up."""
        if self._file is not None:
            os.close(self._file)
            os.close(self._adding)
            self._file = None

    def _bytes(self) -> bytes:
        """The end of all that was printed, somewhat more than is kept."""
        if self._file is None:
            return b""
        size = os.fstat(self._file).st_size
        return (self._end + os.pread(self._file, 4 * MOST, max(0, size - 4 * MOST)))[-4 * MOST :]


def _unbuffered(number: int) -> io.TextIOWrapper:
    """A stream that writes all it is given to an open file at once."""
    raw = io.FileIO(number, "w", closefd=False)
    return io.TextIOWrapper(cast(BinaryIO, raw), encoding="utf-8", errors="backslashreplace", write_through=True)
