"""Ctrl-C at any moment: at once while computing, tidily while writing.

OpenCASCADE keeps the interpreter for seconds, and a Python signal handler would wait for it. So while computing, the
system's own handling ends the process: nothing has been written yet. Only while files are written do the signals
become an exception, so that half-written files are removed.

What a shell or a CI runner hands down does not matter: one that starts a job in the background ignores Ctrl-C, and all
that runs in it would inherit that. Only `nohup` is a wish, so an ignored hang-up stays ignored.
"""

from __future__ import annotations

import _thread
import os
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

STOPPING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name))

ENDING = tuple(number for number in STOPPING if number != getattr(signal, "SIGHUP", None))
"""Signals that end the command even where it inherited that they are ignored."""

_AGAIN_S = 0.01
"""Seconds until a signal whose exception was lost comes again."""


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


class StopRequest:
    """Whether a signal has asked the process to end, and which."""

    def __init__(self) -> None:
        self.number: int | None = None

    def is_set(self) -> bool:
        """Whether it has."""
        return self.number is not None


@contextmanager
def tidily() -> Iterator[StopRequest]:
    """Within this block, a signal raises Stopped; at its end at the latest.

    Whoever waits for long may look at the object as well: an exception raised where nobody expects one can be lost.
    """
    asked = StopRequest()
    before = {number: signal.getsignal(number) for number in STOPPING}
    caught = [number for number, handler in before.items() if handler == signal.SIG_DFL]
    if not caught or not _in_main_thread():  # a block around this one may have caught them all
        yield asked
        return
    hook, asking_again = sys.unraisablehook, False

    def stop(number: int, frame: FrameType | None) -> None:
        if asking_again:  # an exception here would be lost as well, and nobody would ask a third time
            _thread.start_new_thread(_send_again, (number,))
            return
        # Ctrl-C arrives twice, from the terminal and from the waiting process: the second must not disturb the tidying.
        for other in caught:
            signal.signal(other, signal.SIG_IGN)
        asked.number = number
        raise Stopped(number)

    def unraisable(lost: UnraisableHookArgs) -> None:
        if not isinstance(lost.exc_value, Stopped):
            hook(lost)
            return
        # Raised in a destructor, it ends nothing: the same signal again, when the destructor is done.
        nonlocal asking_again
        asking_again, number = True, lost.exc_value.number
        signal.signal(number, stop)
        _thread.start_new_thread(_send_again, (number,))
        asking_again = False

    sys.unraisablehook = unraisable
    for number in caught:
        signal.signal(number, stop)
    try:
        yield asked
        if asked.number is not None:
            raise Stopped(asked.number)
    except KeyboardInterrupt:  # a library has taken the signal for its own
        if asked.number is None:
            raise
        raise Stopped(asked.number) from None
    finally:
        sys.unraisablehook = hook
        for number in caught:
            signal.signal(number, before[number])


def _send_again(number: int) -> None:
    """Send this process the signal in a moment; in a thread of its own."""
    time.sleep(_AGAIN_S)
    os.kill(os.getpid(), number)


def die_by(number: int) -> NoReturn:
    """End the process by a signal, so that the caller sees the true reason (130 in a shell for Ctrl-C)."""
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)
    os._exit(128 + number)  # where a signal does not end the process at once


def _in_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()
