"""Do the work in a worker process, so that a crash becomes an error message.

OpenCASCADE does not check files fully: a broken file can make it read invalid memory, recurse until the stack is full,
or abort. Python cannot catch that in its own process. So the process that was started forks a worker, waits for it, and
turns the signal that ended it into a sentence. Signals are passed on to the worker; the exit code, standard input and
standard output are the worker's: from outside there is one program. The worker reports how it ended; if it ends without
a report, a script that it ran has ended it. If the process that started the command is gone, the work ends too, unless
`nohup` was used. Where the work does not succeed, what a script has started ends with it.

Every drawing has a worker, whatever the source: forking a process that has imported nothing but click takes about a
millisecond, and a mesh can use up the memory too. Help, versions and refused options need no worker. There is none
without `fork` (Windows), nor where another program calls the command line: there the process does the work itself.
"""

from __future__ import annotations

import contextlib
import math
import os
import select
import signal
import threading
import time
from pathlib import Path
from typing import NoReturn

from hlr.common.leftovers import Leftovers
from hlr.common.process import CRASHES, claim, tie_to, without_core_files
from hlr.common.stage_times import StageTimes
from hlr.errors import OptionError, SourceError
from hlr.tables.readers import DOING, of_ending
from hlr.tables.stages import given_up

from .signals import STOPPING, Stopped, hang_up_ignored

_PATIENCE = 2.0
"""Seconds that a crashed worker's progress bar has to clear its line, and that a stopped worker has to tidy up."""

_GLANCE = 0.25
"""Seconds between two checks whether the process that started the command still runs."""

_HELPER = "helper"
"""What a report on a helper begins with."""

_DONE = "done"
"""What the last report begins with; the exit code follows."""

_RESULTS = (0, 1)
"""Exit codes of a command that has done its work: `hlr compare` says by 1 that drawings differ."""


class CrashError(Exception):
    """The worker crashed in our own code."""


class _Worker:
    """The state of this process. notes: descriptor that a worker reports its stages to; None if this is no worker."""

    allowed = False
    notes: int | None = None
    parent: int | None = None


def allow() -> None:
    """Allow this process to fork a worker: it runs the command and nothing else."""
    _Worker.allowed = hasattr(os, "fork")
    _Worker.parent = os.getppid() if _Worker.allowed else None


def start(source: str, limit_s: float | None = None, coarser: str = "ask for a larger --accuracy") -> None:
    """Continue in a worker. In the process that was started this never returns.

    That process raises SourceError, CrashError or Stopped, by what ended the worker. limit_s: seconds after which it
    ends the worker itself; coarser: what helps then where accuracy took the time; empty: nothing.
    Raises OptionError where there is a limit, and can be no worker.
    """
    if not possible():
        if limit_s is not None:
            raise OptionError("--time-limit needs a process that hlr can end, and there is none here: leave it out")
        return
    reading, writing = os.pipe()
    left = Leftovers()
    # Until both know what to do with it, no signal may reach only one of them.
    before = signal.pthread_sigmask(signal.SIG_BLOCK, STOPPING)
    own = os.getpid()
    try:
        worker = os.fork()
    except OSError:  # no room for another process: then without
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        return
    if worker:
        os.close(writing)
        ending = _Ending(worker, left)
        _forward(ending)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        left.adopt()
        _wait(ending, reading, Path(source), limit_s, coarser)
    os.close(reading)
    signal.pthread_sigmask(signal.SIG_SETMASK, before)
    _Worker.allowed, _Worker.notes = False, writing
    tie_to(own)
    claim()
    without_core_files()


def possible() -> bool:
    """Whether this process may have a worker."""
    return _Worker.allowed and threading.active_count() == 1


def note(what: str) -> None:
    """Report to the waiting process: the name of a stage, or "done" and the exit code."""
    if _Worker.notes is not None:
        with contextlib.suppress(OSError):
            os.write(_Worker.notes, f"{what}\n".encode())


def helped_by(process: int) -> None:
    """Report a child of the worker that belongs to the command: it ends by itself, when it has done its part."""
    note(f"{_HELPER} {process}")


def kept_open() -> tuple[int, ...]:
    """Descriptors that a child process inherits so that the waiting process waits for it as well."""
    return () if _Worker.notes is None else (_Worker.notes,)


class _Ending:
    """The worker, and whether it was told to end: by which signal; 0: it was not. late: it took too long."""

    def __init__(self, worker: int, left: Leftovers) -> None:
        self.worker, self.left = worker, left
        self.told, self.late = 0, False
        self._since = 0.0

    def tell(self, number: int) -> None:
        """Tell the worker to end by a signal that lets it tidy up. Its patience is that of the first."""
        if not self.told:
            self.left.look(self.worker)
            self.told, self._since = number, time.monotonic()
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.worker, number)

    def insist(self) -> None:
        """Kill a worker that does not end though it was told to: a script may ignore signals."""
        if self.told and time.monotonic() - self._since > _PATIENCE:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.worker, signal.SIGKILL)


def _forward(ending: _Ending) -> None:
    def forward(number: int, _frame: object) -> None:
        ending.tell(number)

    for number in STOPPING:
        if signal.getsignal(number) == signal.SIG_DFL:  # what is ignored stays ignored
            signal.signal(number, forward)


def _wait(ending: _Ending, reading: int, source: Path, limit_s: float | None, coarser: str) -> NoReturn:
    notes, end = _Notes(reading), math.inf if limit_s is None else time.monotonic() + limit_s
    while not (ended := os.waitpid(ending.worker, os.WNOHANG))[0]:
        notes.listen(max(min(_GLANCE, end - time.monotonic()), 0.01))
        late = time.monotonic() >= end
        if not ending.told and (late or orphaned()):
            ending.late = late
            ending.tell(signal.SIGTERM)
        ending.insist()
    code = os.waitstatus_to_exitcode(ended[1])
    notes.rest(0.0)
    stage, done = notes.times.stage, notes.done
    if done not in _RESULTS:
        ending.left.kill(but=notes.helpers)
        notes.rest(_PATIENCE if code < 0 else 0.0)
    if done is not None:  # whatever became of it after that
        os._exit(done)
    if ending.late and limit_s is not None:
        reader = of_ending(source.suffix)
        raise SourceError(given_up(source.name, reader, limit_s, notes.times.longest(), "--time-limit", coarser))
    if ending.told:
        raise Stopped(ending.told)
    _explain(source, stage, code)


def _explain(source: Path, stage: str, code: int) -> NoReturn:
    """Raise the error that says how a worker ended by itself: in which stage, and by which exit code or signal."""
    reader = of_ending(source.suffix)
    if code >= 0:
        if reader is not None and reader.kind == "script":
            raise SourceError(
                f"{source.name} ended the program (exit code {code}) before anything was drawn; nothing was written; "
                "take os._exit out of it"
            )
        raise CrashError(f"exit code {code} while drawing {source.name}; nothing was written")
    if -code == signal.SIGKILL:
        raise SourceError(f"{source.name}: the work was killed, most likely for want of memory; nothing was written")
    if -code not in CRASHES:
        raise Stopped(-code)
    reason = CRASHES[signal.Signals(-code)]
    if stage in DOING and reader is not None and reader.crash:
        raise SourceError(reader.crash.format(name=source.name, reason=reason, doing=DOING[stage]))
    raise CrashError(f"{reason} while drawing {source.name}; nothing was written")


def orphaned() -> bool:
    """Whether the process that started the command is gone, so that the command must end."""
    return _Worker.parent is not None and os.getppid() != _Worker.parent and not hang_up_ignored()


def without_worker() -> None:
    """Go on in this process, for a command whose work is done by processes of its own.

    Once it is orphaned, a thread ends it; a file being written is completed.
    """
    if _Worker.parent is None:
        return
    claim()

    def watch() -> None:
        while not orphaned():
            time.sleep(_GLANCE)
        os.kill(os.getpid(), signal.SIGTERM)

    threading.Thread(target=watch, daemon=True).start()


class _Notes:
    """What the worker says that it does.

    times    of its stages
    done     its exit code, once it has done all; None: it has not
    helpers  numbers of its processes that end by themselves
    """

    def __init__(self, reading: int) -> None:
        self._reading, self._open, self._rest = reading, True, b""
        self.times = StageTimes()
        self.done: int | None = None
        self.helpers: set[int] = set()

    def listen(self, seconds: float) -> bool:
        """Wait for a report, for so many seconds at most. Returns whether there may be more."""
        if not self._open:
            time.sleep(min(seconds, 0.01))  # the worker is about to end
        elif select.select([self._reading], [], [], seconds)[0]:
            piece = os.read(self._reading, 4096)
            self._open = bool(piece)
            *lines, self._rest = (self._rest + piece).split(b"\n")
            for line in lines:
                self._take(line.decode("utf-8", "replace"))
            return self._open
        return False

    def rest(self, seconds: float) -> None:
        """Wait until all writers have ended, for so many seconds at most: then the progress bar is cleared."""
        end = time.monotonic() + seconds
        while self.listen(max(end - time.monotonic(), 0.0)):
            pass

    def _take(self, line: str) -> None:
        match line.split(" "):
            case [word, number] if word == _HELPER:
                self.helpers.add(int(number))
            case [word, code] if word == _DONE:
                self.done = int(code)
            case _:
                self.times.begin(line)
