"""Ctrl-C at any moment: at once while computing, tidily while writing.

OpenCASCADE keeps the interpreter for seconds, and a Python signal handler would wait for it. So while computing, the
system's own handling ends the process: nothing has been written yet. Only while files are written do the signals
become an exception, so that half-written files are removed.

What a shell or a CI runner hands down does not matter: one that starts a job in the background ignores Ctrl-C, and all
that runs in it would inherit that. Only `nohup` is a wish, so an ignored hang-up stays ignored.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

STOPPING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name))

ENDING = tuple(number for number in STOPPING if number != getattr(signal, "SIGHUP", None))
"""Signals that end the command even where it inherited that they are ignored."""


class Stopped(BaseException):
    """A signal asked the process to end while it was writing."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def at_once(own: bool) -> None:
    """Let Ctrl-C end the process without Python's help.

    own: the process runs the command and nothing else, so inherited signal settings are reset as well.
    """
    if not _in_main_thread():
        return
    if own and hasattr(signal, "pthread_sigmask"):
        for number in (*ENDING, signal.SIGCHLD):  # who ignores SIGCHLD cannot wait for a worker
            signal.signal(number, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPPING)
    elif signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def hang_up_ignored() -> bool:
    """Whether `nohup` started this process: then it goes on when the process that started it ends."""
    return hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) == signal.SIG_IGN


@contextmanager
def tidily() -> Iterator[None]:
    """Within this block, a signal raises Stopped."""
    if not _in_main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in STOPPING}
    caught = [number for number, handler in before.items() if handler == signal.SIG_DFL]
    for number in caught:
        signal.signal(number, _stop)
    try:
        yield
    finally:
        for number in caught:
            signal.signal(number, before[number])


def die_by(number: int) -> NoReturn:
    """End the process by a signal, so that the caller sees the true reason (130 in a shell for Ctrl-C)."""
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)
    os._exit(128 + number)  # where a signal does not end the process at once


def _stop(number: int, frame: FrameType | None) -> NoReturn:
    # Ctrl-C arrives twice, from the terminal and from the waiting process: the second must not disturb the tidying.
    for other in STOPPING:
        if signal.getsignal(other) is _stop:
            signal.signal(other, signal.SIG_IGN)
    raise Stopped(number)


def _in_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()
