"""The process of a worker: takes jobs from standard input, and sends what becomes of them to standard output.

It draws nothing itself. It imports what drawings need, and forks a child for each job: the child has all that is
imported, and nothing that a script does reaches the next job. A child that crashes, or is killed, costs its job and no
second import. OpenCASCADE and what stands on it take seconds to import, and not every job needs them: the child that
first does ends there, the worker imports the package, and the job starts again in a new child. What a script has
started ends where its child does not succeed.

Where there is no `fork` (Windows), or where it is not safe after such imports (macOS), the worker does the job itself.

Messages to the pool::

    ("at", pid)            this process now does the job; None: none does, what it needs is imported
    ("stage", name)        a stage of the drawing begins
    ("printed", text)      the end of what a script has printed that fails; one of the next two follows
    ("ended", outcome)     the job is done
    ("crashed", code)      the child ended without an outcome: exit code, or minus the number of the signal
"""

from __future__ import annotations

import contextlib
import os
import select
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.machinery import ModuleSpec
from pathlib import Path
from typing import Any, NoReturn

from hlr.batch.carry_out import carry_out
from hlr.batch.discover import takes_parameters
from hlr.batch.frames import receive, send
from hlr.batch.job import Job
from hlr.batch.script_output import ScriptOutput
from hlr.common.leftovers import Leftovers
from hlr.common.process import claim, debugging, tie_to, without_core_files
from hlr.tables.entry import called
from hlr.tables.writers import WRITERS

_FORKS = sys.platform == "linux"

_HEAVY = {"OCP": ("OCP.TopoDS", "OCP.STEPCAFControl"), "cadquery": ("cadquery",), "build123d": ("build123d",)}
"""Packages that take long to import, and what a worker imports of them."""

_GLANCE = 0.25
"""Seconds between two checks whether a child that says nothing still runs."""


def main() -> None:
    """Do jobs until the input ends."""
    reading, writing = _own_streams()
    tie_to(int(sys.argv[1]))
    without_core_files()
    claim()
    sys.dont_write_bytecode = True  # a script's modules are read as they are, and nothing is left beside them
    imported: set[str] = set()
    with contextlib.suppress(EOFError, OSError):
        while True:
            job: Job = receive(reading)
            send(writing, ("at", os.getpid()))
            if _FORKS:
                for entry in ("hlr.public.arranged:draw_arranged", *(WRITERS[format].entry for format in job.formats)):
                    called(entry)  # imports it
                while _in_child(job, writing, imported):
                    send(writing, ("at", os.getpid()))
            else:
                send(writing, ("ended", _done(job, writing)))
    os._exit(0)  # taking down what is imported takes longer than many a drawing


def _own_streams() -> tuple[int, int]:
    """Descriptors of the pool's messages. Scripts find an empty input, and an output that goes nowhere."""
    reading, writing = os.dup(0), os.dup(1)
    nowhere = os.open(os.devnull, os.O_RDWR)
    os.dup2(nowhere, 0)
    os.dup2(2 if debugging() else nowhere, 1)
    if not debugging():
        os.dup2(nowhere, 2)
    return reading, writing


def _done(job: Job, writing: int) -> Any:
    """The outcome of a job in this process, from the job's own folder; its stages are told."""
    told = ""
    with contextlib.suppress(OSError):
        os.chdir(job.root)

    def progress(stage: str, _fraction: float) -> None:
        nonlocal told
        if stage != told:
            told = stage
            send(writing, ("stage", stage))

    return carry_out(job, progress)


def _in_child(job: Job, writing: int, imported: set[str]) -> bool:
    """Do a job in a child, and pass on what it says. Returns whether the job has to start again."""
    here, there = os.pipe()
    own, left = os.getpid(), Leftovers()
    printed = ScriptOutput() if takes_parameters(Path(job.source)) and not debugging() else None
    child = os.fork()
    if not child:
        _be_child(job, there, own, imported, printed)
    os.close(there)
    left.adopt()
    send(writing, ("at", child))
    said = _pass_on(here, child, writing, printed)
    os.close(here)
    if said[0] == "needs":
        send(writing, ("at", None))  # limits are for the job
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if said[0] != "ended" or said[1].failure is not None:
        left.kill()
        if printed is not None and said[0] != "needs":
            send(writing, ("printed", printed.text()))
    if printed is not None:
        printed.close()
    if said[0] == "needs":
        imported.add(said[1])
        for name in _HEAVY[said[1]]:
            with contextlib.suppress(Exception):  # the next child meets the same error, and tells it
                import_module(name)
        return True
    send(writing, said if said[0] == "ended" else ("crashed", code))
    return False


def _be_child(job: Job, writing: int, parent: int, imported: set[str], printed: ScriptOutput | None) -> NoReturn:
    code = 1
    try:
        tie_to(parent)
        if printed is not None:
            printed.take()

        def needs(package: str) -> NoReturn:
            send(writing, ("needs", package))
            os._exit(0)

        sys.meta_path.insert(0, _Watch(set(_HEAVY) - imported, needs))
        send(writing, ("ended", _done(job, writing)))
        code = 0
    finally:
        os._exit(code)


def _pass_on(here: int, child: int, writing: int, printed: ScriptOutput | None) -> tuple[Any, ...]:
    """Pass on the stages of a child. Returns its last message: an outcome, or a package that it needs, or ()."""
    with contextlib.suppress(EOFError):
        while True:
            if printed is not None:
                printed.shorten()
            if select.select([here], [], [], _GLANCE)[0]:
                message: tuple[Any, ...] = receive(here)
                if message[0] != "stage":
                    return message
                send(writing, message)
            elif os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None:
                break  # what a script has started may keep the pipe open
    return ("",)


class _Watch:
    """A finder of modules that finds none: it tells when one of these packages is imported first."""

    def __init__(self, packages: set[str], tell: Callable[[str], NoReturn]) -> None:
        self._packages, self._tell = packages, tell

    def find_spec(self, name: str, path: Sequence[str] | None = None, target: Any = None) -> ModuleSpec | None:
        """As of any finder; None: this one does not know the module."""
        package = name.partition(".")[0]
        if package in self._packages and not sys.modules.get(package):
            self._tell(package)
        return None


if __name__ == "__main__":
    main()
