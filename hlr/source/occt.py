"""The one door to OpenCASCADE: imported when a B-rep is met, silent, and with a cure when it cannot start."""

from __future__ import annotations

from functools import cache

from hlr.errors import SourceError


@cache
def ready() -> None:
    """Import OpenCASCADE's bindings and switch off what it prints to standard output.

    Raises:
        SourceError: the bindings are missing, or a system library they need is.
    """
    try:
        from OCP.Message import Message
    except ImportError as error:
        raise SourceError(explain(error)) from None
    # Readers report to standard output, where our own drawing may go.
    Message.DefaultMessenger_s().ChangePrinters().Clear()


def explain(error: ImportError) -> str:
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
