"""Keep standard output for the result.

Scripts print, and so do libraries below Python. While a drawing is computed, their output goes to standard error; the
original standard output is reserved for the result.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator

from hlr.errors import WriteError


class ReaderGoneError(Exception):
    """Nobody reads standard output any more. (click would catch a BrokenPipeError.)"""


class Output:
    """The original standard output. descriptor: None where the process was started without one."""

    def __init__(self, descriptor: int | None) -> None:
        self._descriptor = descriptor

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
        try:
            left = memoryview(data)
            while left:
                left = left[os.write(self._descriptor, left) :]
        except BrokenPipeError as error:
            raise ReaderGoneError from error
        except OSError as error:
            reason = error.strerror or str(error)
            raise WriteError(f"cannot write to standard output: {reason[:1].lower()}{reason[1:]}") from error


@contextlib.contextmanager
def result_only() -> Iterator[Output]:
    """Within this block nothing but the yielded Output can write to standard output."""
    if sys.stdout is not None:
        sys.stdout.flush()
    kept = _duplicate(1)
    _send_to_errors(1)
    try:
        with contextlib.redirect_stdout(sys.stderr):
            yield Output(kept)
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
