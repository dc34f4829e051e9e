"""Keep standard output for the result.

Scripts print, and so do libraries below Python. While a drawing is computed, their output goes to standard error; the
original standard output is reserved for the result.

Text that a command prints, its help too, goes through `Printed`: a full disk or a closed pipe ends every command alike.

What is for people is printed by `show`, `say` and `Output.show` alone: names out of files cannot control the terminal.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import click

from hlr.common.printable import printable
from hlr.errors import WriteError


class ReaderGoneError(Exception):
    """Nobody reads standard output any more. (click would catch a BrokenPipeError.)"""


class Printed:
    """Standard output for text. Raises WriteError where the system refuses, ReaderGoneError where nobody reads it."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """Write text; returns how many characters."""
        with _told():
            written: int = self._stream.write(text)
        return written

    def flush(self) -> None:
        """Hand over to the system what was written."""
        with _told():
            self._stream.flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextlib.contextmanager
def printing() -> Iterator[None]:
    """Within this block text is printed through `Printed`; at its end all of it is with the system."""
    if sys.stdout is not None:
        sys.stdout = Printed(sys.stdout)
    yield
    if sys.stdout is not None:
        sys.stdout.flush()


def show(*lines: str) -> None:
    """Print lines for people to standard output."""
    for line in lines:
        click.echo(printable(line))


def say(*lines: str) -> None:
    """Print lines for people to standard error, if there is one."""
    if sys.stderr is not None:
        with contextlib.suppress(OSError):
            sys.stderr.writelines(f"{printable(line)}\n" for line in lines)
            sys.stderr.flush()


def clear_line() -> None:
    """Clear the line of a terminal that standard error is, for what is said next."""
    if sys.stderr is not None and sys.stderr.isatty():
        sys.stderr.write("\r\x1b[K")


def show_path(path: Path) -> None:
    """Print a path to standard output: on a terminal for people, else byte for byte, as programs need it."""
    if sys.stdout is not None and sys.stdout.isatty():
        show(str(path))
    else:
        with _told():
            click.echo(os.fsencode(path))


@contextlib.contextmanager
def _told() -> Iterator[None]:
    """Say in our own words that standard output cannot be written to."""
    try:
        yield
    except BrokenPipeError as error:
        raise ReaderGoneError from error
    except OSError as error:
        reason = error.strerror or str(error)
        raise WriteError(f"cannot write to standard output: {reason[:1].lower()}{reason[1:]}") from error


class Output:
    """The original standard output. descriptor: None where the process was started without one; encoding: of text."""

    def __init__(self, descriptor: int | None, encoding: str = "utf-8") -> None:
        self._descriptor, self._encoding = descriptor, encoding

    @property
    def descriptor(self) -> int:
        """The file descriptor, for a child process that writes to it. Raises WriteError where there is none."""
        if self._descriptor is None:
            raise WriteError("cannot write to standard output: it is closed")
        return self._descriptor

    def put(self, data: bytes) -> None:
        """Write all of it. Raises WriteError where the system refuses, ReaderGoneError where nobody reads it."""
        if self._descriptor is None:
            raise WriteError("cannot write to standard output: it is closed")
        with _told():
            left = memoryview(data)
            while left:
                left = left[os.write(self._descriptor, left) :]

    def show(self, lines: Iterable[str]) -> None:
        """Write lines for people. Raises as `put` does."""
        self.put("".join(f"{printable(line)}\n" for line in lines).encode(self._encoding, "replace"))


@contextlib.contextmanager
def result_only() -> Iterator[Output]:
    """Within this block nothing but the yielded Output can write to standard output."""
    if sys.stdout is not None:
        sys.stdout.flush()
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"  # a text in memory has none
    kept = _duplicate(1)
    _send_to_errors(1)
    try:
        with contextlib.redirect_stdout(sys.stderr):
            yield Output(kept, encoding)
    finally:
        if kept is not None:
            os.dup2(kept, 1)
            os.close(kept)


def _duplicate(descriptor: int) -> int | None:
    try:
        return os.dup(descriptor)
    except OSError:
        return None


def _send_to_errors(descriptor: int) -> None:
    """Redirect a descriptor to standard error. Never close it: the next file opened would get its number."""
    try:
        os.dup2(2, descriptor)
    except OSError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        if nowhere != descriptor:
            os.dup2(nowhere, descriptor)
            os.close(nowhere)
