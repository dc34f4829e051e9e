"""The folder of entries, one file each. When it is full, the least recently used entries are removed.

A file is written under a temporary name and renamed when it is complete."""

from __future__ import annotations

import os
import re
import stat
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

MODEL, DRAWINGS = "model", "drawings"
"""Kinds of entries: what was read of a CAD file, and what was drawn of a source. They share the folder and its size."""

_ENTRY = re.compile(rf"[0-9a-f]{{40}}\.({MODEL}|{DRAWINGS})")
_UNFINISHED = re.compile(rf"[0-9a-f]{{40}}\.({MODEL}|{DRAWINGS})\.\w+\.part")
"""A file that is being written, or that was left unfinished."""

_ABANDONED = 3600.0
"""Seconds after which an unfinished file counts as abandoned."""

_SPARE = 1 / 16
"""Of the size that the cache may have: what is free once room was made in a full one. So much is written before the
next look, too, for other processes may write as well."""


class NotKeptError(Exception):
    """An entry was not written; says why in a few words."""


@dataclass(frozen=True, slots=True)
class Kept:
    """A file of the folder: its size in bytes, and when it was last used (seconds since the epoch)."""

    path: Path
    size: int
    used: float


class Store:
    """Entries by key, forty hexadecimal digits. Files with other names are ignored."""

    def __init__(self, folder: Path, most: int, kind: str = MODEL) -> None:
        """most: the most bytes that all entries together may take, of any kind. kind: of those read and written."""
        self.folder, self.most, self.kind = folder, most, kind
        self._room = -1
        """Bytes that may be written before the next look how full the folder is, which takes time for each file."""

    def path(self, key: str) -> Path:
        """The path of an entry's file, which may not exist."""
        return self.folder / f"{key}.{self.kind}"

    def read(self, key: str) -> bytes | None:
        """The bytes of an entry's file, unchecked; None where there is no file that can be read."""
        flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
        with suppress(OSError):
            number = os.open(self.path(key), flags)
            with open(number, "rb") as file:
                state = os.fstat(number)
                if not stat.S_ISREG(state.st_mode) or state.st_size > self.most:
                    return None
                return file.read(state.st_size)
        return None

    def touch(self, key: str) -> None:
        """Mark an entry as used now, so that it is removed last."""
        with suppress(OSError):
            os.utime(self.path(key))

    def write(self, key: str, entry: Sequence[bytes]) -> int:
        """Write an entry, given in pieces, in place of any older one with this key. Returns its size in bytes.

        Raises:
            NotKeptError: the folder is read-only or full, or the entry is larger than the whole cache may be.
        """
        size = sum(map(len, entry))
        if size > self.most:
            raise NotKeptError(f"it takes {_mega(size)}, and the cache may take {_mega(self.most)}")
        try:
            self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            self._write(key, entry)
        except OSError as error:
            raise NotKeptError(f"{self.folder}: {(error.strerror or str(error)).lower()}") from None
        self._room -= size
        if self._room < 0:
            self._shrink()
        return size

    def _write(self, key: str, entry: Sequence[bytes]) -> None:
        from tempfile import mkstemp

        target = self.path(key)
        number, beside = mkstemp(dir=self.folder, prefix=f"{target.name}.", suffix=".part")
        try:
            with open(number, "wb") as file:
                for piece in entry:
                    file.write(piece)
            os.replace(beside, target)
        except BaseException:
            with suppress(OSError):
                os.unlink(beside)
            raise

    def entries(self) -> list[Kept]:
        """All entries, the least recently used first."""
        return sorted(self._files(_ENTRY), key=lambda kept: (kept.used, kept.path.name))

    def clear(self) -> list[Kept]:
        """Remove all entries and unfinished files. Returns what was removed.

        Raises:
            OSError: one could not be removed.
        """
        found = [*self.entries(), *self._files(_UNFINISHED)]
        for kept in found:
            kept.path.unlink(missing_ok=True)
        return found

    def _shrink(self) -> None:
        entries = self.entries()
        spare = int(self.most * _SPARE)
        room = self.most - sum(kept.size for kept in entries)
        wanted = spare if room < 0 else 0
        for kept in entries[:-1]:
            if room >= wanted:
                break
            with suppress(OSError):
                kept.path.unlink()
                room += kept.size
        self._room = min(room, spare)
        for kept in self._files(_UNFINISHED):
            if kept.used < time.time() - _ABANDONED:
                with suppress(OSError):
                    kept.path.unlink()

    def _files(self, name: re.Pattern[str]) -> list[Kept]:
        found = []
        with suppress(OSError), os.scandir(self.folder) as files:
            for file in files:
                if name.fullmatch(file.name):
                    with suppress(OSError):
                        state = file.stat(follow_symlinks=False)
                        if stat.S_ISREG(state.st_mode):
                            found.append(Kept(Path(file.path), state.st_size, state.st_mtime))
        return found


def _mega(size: int) -> str:
    return f"{size / 1e6:.3g} MB"
