"""What a worker leaves behind: processes that a script has started. They are ended where the work does not succeed.

On Linux the process that waits for the worker adopts them: when the worker ends, they become its own children, however
they were started. Elsewhere they are looked for before the worker is told to end, and what it leaves behind when it
crashes is not found.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from collections.abc import Collection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import psutil

_PATIENCE = 2.0
"""Seconds that killed processes have to be gone."""


class Leftovers:
    """What the one worker of this process has started. Made before the worker (POSIX).

    `kill` is for afterwards: it takes all children of this process but those that it had before.
    """

    def __init__(self) -> None:
        # A shell that becomes this process by `exec` hands down its children: they are none of ours.
        self._others = {process.pid for process in _children()}
        self._adopts = False
        self._known: list[psutil.Process] = []

    def adopt(self) -> None:
        """Become the parent of whatever loses its own below this process, where the system does that."""
        if sys.platform == "linux":
            import ctypes

            with contextlib.suppress(OSError, AttributeError):
                self._adopts = ctypes.CDLL(None).prctl(36, 1, 0, 0, 0) == 0  # PR_SET_CHILD_SUBREAPER

    def look(self, worker: int) -> None:
        """Look for them while the worker still runs, where they cannot be found afterwards."""
        if not self._adopts:
            import psutil

            with contextlib.suppress(psutil.Error):
                self._known = _below(psutil.Process(worker))

    def kill(self, but: Collection[int] = ()) -> None:
        """Kill them, and wait until they are gone, though not for long. but: numbers of processes that stay."""
        end = time.monotonic() + _PATIENCE
        while self._killed(but) and time.monotonic() < end:
            time.sleep(0.005)

    def _killed(self, but: Collection[int]) -> int:
        """Kill those that run. Returns how many there were."""
        count = 0
        for process in {*self._known, *self._found()}:
            with contextlib.suppress(Exception):  # it has ended meanwhile, or is none of this user's
                if process.pid not in but and process.is_running() and process.status() != "zombie":
                    process.kill()
                    count += 1
        return count

    def _found(self) -> list[psutil.Process]:
        return [each for child in _children() if child.pid not in self._others for each in (*_below(child), child)]


def _children() -> list[psutil.Process]:
    """The children of this process. It takes leave of those that have ended."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        return []  # as almost always: then psutil need not be loaded
    import psutil

    found: list[psutil.Process] = psutil.Process().children()
    return found


def _below(process: psutil.Process) -> list[psutil.Process]:
    import psutil

    found: list[psutil.Process] = []
    with contextlib.suppress(psutil.Error):
        found = process.children(recursive=True)
    return found
