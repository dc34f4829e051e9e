"""Processes of the command line's own: what marks them, ties them to one another, and names the signal of a crash."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
import time

CRASHES = {
    getattr(signal, name): words
    for name, words in (
        ("SIGSEGV", "segmentation fault"),
        ("SIGBUS", "bus error"),
        ("SIGABRT", "abort"),
        ("SIGILL", "illegal instruction"),
        ("SIGFPE", "arithmetic error"),
        ("SIGTRAP", "trap"),
        ("SIGSYS", "bad system call"),
    )
    if hasattr(signal, name)
}
"""Signals of a crash."""


class _Process:
    own = False


def claim() -> None:
    """Declare that this process is the command line's own."""
    _Process.own = True


def is_own() -> bool:
    """Whether this process belongs to the command line alone, so that no other program imports modules in it."""
    return _Process.own


def debugging() -> bool:
    """Whether HLR_DEBUG asks for tracebacks."""
    return os.environ.get("HLR_DEBUG", "") not in ("", "0")


def tie_to(parent: int) -> None:
    """End this process when its parent, a process of this number, ends, even by a signal that it cannot pass on."""
    if sys.platform == "linux":
        import ctypes  # NumPy would load it anyway

        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(1, int(signal.SIGKILL))  # PR_SET_PDEATHSIG
        if os.getppid() != parent:
            os._exit(1)
        return

    def watch() -> None:  # as soon as OpenCASCADE lets go of the interpreter
        while os.getppid() == parent:
            time.sleep(1.0)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def without_core_files() -> None:
    """Write no core files. With HLR_DEBUG: write them, and a traceback of a crash."""
    if debugging():
        import faulthandler

        faulthandler.enable()
        return
    with contextlib.suppress(ImportError, OSError, ValueError):  # Windows has neither the module nor the files
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
