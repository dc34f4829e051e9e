"""The one door to OpenCASCADE: imported when a B-rep is met, silent, and with a cure when it cannot start."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

from hlr.errors import SourceError


@cache
def load_occt() -> None:
    """Import OpenCASCADE's bindings and switch off what it prints to standard output.

    Raises:
        SourceError: the bindings are missing, or a system library they need is.
    """
    try:
        from OCP.Message import Message
    except ImportError as error:
        raise SourceError(import_failure_message(error)) from None
    # Readers report to standard output, where our own drawing may go.
    Message.DefaultMessenger_s().ChangePrinters().Clear()


@contextmanager
def silence_stdout() -> Iterator[None]:
    """Keep what C++ writes straight to standard output out of it, for as long as a file is being read."""
    try:
        sys.stdout.flush()
        kept = os.dup(1)
    except (OSError, ValueError, AttributeError):
        yield
        return
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 1)
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)


def import_failure_message(error: ImportError) -> str:
    """One sentence on why OpenCASCADE cannot be imported, and what to install."""
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
