"""Importing OpenCASCADE: only where a B-rep is read, without its own output, with a clear error where it fails."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

from hlr.errors import SourceError


@cache
def load_occt() -> None:
    """Import OpenCASCADE's bindings and switch off its messages on standard output.

    Raises:
        SourceError: the bindings or a system library that they need is missing.
    """
    try:
        from OCP.Message import Message
    except ImportError as error:
        raise SourceError(import_failure_message(error)) from None
    # Readers print to standard output, which may be where the drawing is written.
    Message.DefaultMessenger_s().ChangePrinters().Clear()


@contextmanager
def silence_stdout() -> Iterator[None]:
    """Discard what C++ code writes to standard output (file descriptor 1) in the block."""
    try:
        sys.stdout.flush()
        saved_fd = os.dup(1)
    except (OSError, ValueError, AttributeError):
        yield
        return
    try:
        with open(os.devnull, "wb") as null:
            os.dup2(null.fileno(), 1)
        yield
    finally:
        os.dup2(saved_fd, 1)
        os.close(saved_fd)


def import_failure_message(error: ImportError) -> str:
    """One sentence: why OpenCASCADE cannot be imported, and what to install."""
    text = str(error)
    for library, package in (("libGL.so", "libgl1"), ("libX11", "libx11-6"), ("libXrender", "libxrender1")):
        if library in text:
            return (
                f"OpenCASCADE needs the system library {text.split(':', maxsplit=1)[0]}: "
                f"install it (Debian and Ubuntu: apt-get install {package})."
            )
    if isinstance(error, ModuleNotFoundError):
        return "B-rep sources need OpenCASCADE's Python bindings: pip install cadquery."
    return f"OpenCASCADE's Python bindings cannot be loaded: {text}."
