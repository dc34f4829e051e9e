"""The progress bar on a terminal, drawn by a child process.

OpenCASCADE blocks the interpreter for seconds, so a thread could not draw; and Ctrl-C ends this process before it can
clear the terminal's line. The child draws while its input is open, then clears the line.
"""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Iterator
from typing import IO

from . import guard

Progress = Callable[[str, float], None]

# Seconds between two reports of one stage: the eye needs no more, and the child has to read them all.
_PERIOD = 0.05


@contextlib.contextmanager
def meter(quiet: bool) -> Iterator[Progress]:
    """Yield the function that stages call with their name and the fraction done. It draws on a terminal only."""
    if quiet or sys.stderr is None or not sys.stderr.isatty():
        yield _noting(None)
        return
    import subprocess  # here, because the help text has no use for it

    try:
        # -P: the folder that hlr was started in must not provide modules.
        child = subprocess.Popen(
            [sys.executable, "-P", "-m", f"{__package__}.meter_process"],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            pass_fds=guard.kept_open(),
        )
    except OSError:  # drawing matters more than showing progress
        yield _noting(None)
        return
    guard.helped_by(child.pid)
    assert child.stdin is not None
    try:
        yield _noting(_sender(child.stdin))
    finally:
        with contextlib.suppress(OSError):
            child.stdin.close()
        child.wait()


def _noting(show: Progress | None) -> Progress:
    """Report each new stage to the process that waits for this one, and all progress to `show`."""
    noted = ""

    def report(stage: str, fraction: float) -> None:
        nonlocal noted
        if stage != noted:
            noted = stage
            guard.note(stage)
        if show is not None:
            show(stage, fraction)

    return report


def _sender(pipe: IO[bytes]) -> Progress:
    shown, at = "", 0.0

    def report(stage: str, fraction: float) -> None:
        nonlocal shown, at
        now = time.monotonic()
        if stage == shown and now - at < _PERIOD:
            return
        shown, at = stage, now
        with contextlib.suppress(OSError, ValueError):
            pipe.write(f"{fraction:.4f} {stage}\n".encode())
            pipe.flush()

    return report
