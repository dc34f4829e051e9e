"""The work is done in a worker process, so that a crash of it is an error and not the end of the program.

OpenCASCADE is C++ that takes broken files on trust: some make it use memory that is not there, recurse until the stack
is full, or abort. No Python can catch that in its own process. So the process that was started forks a worker, waits
for it, and puts into a sentence what a signal said about its end. Signals sent to the one are passed to the other, the
exit code is the worker's, and so are standard input and output: from outside there is one program. A worker says how it
ended: one that is gone without a word was ended by a script that it ran. And whoever started the command and is gone no
longer wants its result: the work ends then, unless `nohup` asked for the contrary.

Each drawing has a worker, whatever the source: forking a process that has imported nothing but click costs about a
millisecond, and memory can run out on a mesh too. Help, versions and refused options come before it. There is no
worker without `fork` (Windows), nor where the command line is called from within another program: there the process
does the work itself.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
import sys
import threading
import time
from pathlib import Path
from typing import NoReturn

from hlr.common.process import claim
from hlr.errors import SourceError
from hlr.tables.readers import of_ending

from .signals import STOPPING, Stopped, hang_up_ignored

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
"""Signals that a process brings upon itself."""

_READING = ("", "source", "tessellate")
"""Stages in which OpenCASCADE, or a script, is at work; the others are ours alone."""

_PATIENCE = 2.0
"""Seconds for the progress bar of a worker that crashed to clear its line, and for a stopped one to tidy up."""

_GLANCE = 0.25
"""Seconds between two looks at whether the process that started the command is still there."""


class CrashError(Exception):
    """The worker crashed in code of ours."""


class _Worker:
    """What this process knows of itself. notes: where the worker writes what it does, None if this is no worker."""

    allowed = False
    notes: int | None = None
    parent: int | None = None


def allow() -> None:
    """From now on this process may be split: it is the command and nothing else."""
    _Worker.allowed = hasattr(os, "fork")
    _Worker.parent = os.getppid() if _Worker.allowed else None


def start(source: str) -> None:
    """Go on in a worker. The process that was started never returns from here.

    Raises (there): SourceError, CrashError, or Stopped, by what ended the worker.
    """
    if not _Worker.allowed or threading.active_count() > 1:
        return
    reading, writing = os.pipe()
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
        _forward(worker)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        _wait(worker, reading, Path(source))
    os.close(reading)
    signal.pthread_sigmask(signal.SIG_SETMASK, before)
    _Worker.allowed, _Worker.notes = False, writing
    _tie_to(own)
    claim()
    _prepare()


def note(what: str) -> None:
    """Tell the waiting process what is being done: the name of a stage, or "done" and the exit code."""
    if _Worker.notes is not None:
        with contextlib.suppress(OSError):
            os.write(_Worker.notes, f"{what}\n".encode())


def kept_open() -> tuple[int, ...]:
    """Descriptors for a child that the waiting process is to wait for as well."""
    return () if _Worker.notes is None else (_Worker.notes,)


def _forward(worker: int) -> None:
    def forward(number: int, _frame: object) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.kill(worker, number)

    for number in STOPPING:
        if signal.getsignal(number) == signal.SIG_DFL:  # what is ignored stays ignored
            signal.signal(number, forward)


def _wait(worker: int, reading: int, source: Path) -> NoReturn:
    notes = _Notes(reading)
    while not (ended := os.waitpid(worker, os.WNOHANG))[0]:
        notes.listen(_GLANCE)
        if orphaned():
            _end(worker)
            raise Stopped(signal.SIGTERM)
    code = os.waitstatus_to_exitcode(ended[1])
    notes.rest(_PATIENCE if code < 0 else 0.0)
    stage, _, done = notes.last().partition(" ")
    if stage == "done":  # whatever became of it after that
        os._exit(int(done))
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
    if stage in _READING and reader is not None and reader.crash:
        doing = "meshed" if stage == "tessellate" else "read"
        raise SourceError(reader.crash.format(name=source.name, reason=reason, doing=doing))
    raise CrashError(f"{reason} while drawing {source.name}; nothing was written")


def orphaned() -> bool:
    """Whether the process that started the command is gone, and the command is to go with it."""
    return _Worker.parent is not None and os.getppid() != _Worker.parent and not hang_up_ignored()


def end_when_orphaned() -> None:
    """For a command without a worker: a thread that ends it, tidily where it is writing, when it is orphaned."""
    if _Worker.parent is None:
        return

    def watch() -> None:
        while not orphaned():
            time.sleep(_GLANCE)
        os.kill(os.getpid(), signal.SIGTERM)

    threading.Thread(target=watch, daemon=True).start()


def _end(worker: int) -> None:
    """By a signal that lets it tidy up; it ends with this process in any case."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(worker, signal.SIGTERM)
    end = time.monotonic() + _PATIENCE
    while time.monotonic() < end and not os.waitpid(worker, os.WNOHANG)[0]:
        time.sleep(0.01)


class _Notes:
    """What the worker says that it does."""

    def __init__(self, reading: int) -> None:
        self._reading, self._open, self._text = reading, True, b""

    def listen(self, seconds: float) -> bool:
        """Until there is something new, or for so long; whether there may be more."""
        if not self._open:
            time.sleep(min(seconds, 0.01))  # the worker is about to end
        elif select.select([self._reading], [], [], seconds)[0]:
            piece = os.read(self._reading, 4096)
            self._open = bool(piece)
            self._text = (self._text + piece)[-4096:]
            return self._open
        return False

    def rest(self, seconds: float) -> None:
        """Until nobody is left to say anything, or for so long: the progress bar has been cleared after this."""
        end = time.monotonic() + seconds
        while self.listen(max(end - time.monotonic(), 0.0)):
            pass

    def last(self) -> str:
        """What it said last."""
        lines = self._text.decode("utf-8", "replace").splitlines()
        return lines[-1] if lines else ""


def _tie_to(parent: int) -> None:
    """End with the waiting process: whoever kills that one with a signal that cannot be passed on means the work."""
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


def _prepare() -> None:
    """No core files, unless somebody looks for the fault: then a traceback as well."""
    if os.environ.get("HLR_DEBUG", "") not in ("", "0"):
        import faulthandler

        faulthandler.enable()
        return
    import resource

    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
