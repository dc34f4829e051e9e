"""A worker of the local pool: a process that does one job after the other, and is replaced when it ends."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any

from hlr.batch.frames import receive, send
from hlr.batch.job import Job, Outcome, failed
from hlr.common.process import CRASHES
from hlr.common.stage_times import StageTimes
from hlr.tables.readers import DOING, of_ending
from hlr.tables.stages import READS, given_up

if TYPE_CHECKING:
    import psutil

_KILLED = 9
"""The signal that the system kills with where memory is short."""


_PATIENCE = 0.5
"""Seconds that a process has to end when its input has ended."""


@dataclass(frozen=True, slots=True)
class Begun:
    """A job has come to a stage."""

    number: int
    stage: str


@dataclass(frozen=True, slots=True)
class Ended:
    """A job has ended, and its worker is free."""

    number: int
    outcome: Outcome
    worker: Worker


class Worker:
    """A process, and the thread of this one that talks with it. The thread's messages go into a queue."""

    def __init__(self, said: SimpleQueue[Begun | Ended], environment: Mapping[str, str] | None = None) -> None:
        """said: where its messages go. environment: variables of its process that differ from those of this one."""
        self._said, self._environment = said, environment or {}
        self._given: SimpleQueue[tuple[int, Job] | None] = SimpleQueue()
        self._process: subprocess.Popen[bytes] | None = None
        self._running: _Running | None = None
        # The process ends with the thread that starts it, at the latest.
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def give(self, number: int, job: Job) -> None:
        """Let it do a job; it has none now."""
        self._given.put((number, job))

    def keep_within_limits(self) -> None:
        """End the job that it does where that takes too long, or too much memory."""
        running = self._running
        if running is not None:
            running.keep_within_limits()

    def end(self) -> None:
        """End it, whatever it does: at once where it does a job, and when it is ready where it has none."""
        self._given.put(None)
        process = self._process
        if process is not None and self._running is not None:
            _kill(process.pid)

    def wait(self) -> None:
        """Wait until it has ended, though not for long."""
        self._thread.join(4.0 * _PATIENCE)

    def _work(self) -> None:
        while (given := self._given.get()) is not None:
            number, job = given
            started = time.monotonic()
            outcome = self._outcome(number, job, started)
            self._running = None
            self._said.put(Ended(number, outcome, self))
        self._stop()

    def _outcome(self, number: int, job: Job, started: float) -> Outcome:
        running = _Running(job)
        code: int | None = None
        printed = ""
        try:
            process = self._started()
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            return failed(
                "Crash", f"{job.source}: no process to draw it can be started with {sys.executable}: {reason}."
            )
        try:
            assert process.stdin is not None and process.stdout is not None
            send(process.stdin.fileno(), job)
            self._running = running
            while True:
                said, value = receive(process.stdout.fileno())
                if said == "at":
                    running.moved(value)
                elif said == "stage":
                    running.times.begin(value)
                    self._said.put(Begun(number, value))
                elif said == "printed":
                    printed = value
                elif said == "ended":
                    return replace(_ended(value), printed=printed)
                else:
                    code = value
                    break
        except (EOFError, OSError):
            code = self._stop()
        why = running.verdict or _why(job, running.times.stage, code)
        return replace(failed(*why, seconds=round(time.monotonic() - started, 4)), printed=printed)

    def _started(self) -> subprocess.Popen[bytes]:
        if self._process is None:
            # -P: the folder that the batch works in must not provide modules.
            command = [sys.executable, "-P", "-m", "hlr.batch.worker_process", str(os.getpid())]
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                env=os.environ | self._environment,
                start_new_session=True,
            )
        return self._process

    def _stop(self) -> int | None:
        """End the process and forget it. Returns how it ended."""
        process, self._process = self._process, None
        if process is None:
            return None
        with contextlib.suppress(OSError, subprocess.TimeoutExpired):
            process.communicate(timeout=_PATIENCE)
            return process.returncode
        _kill(process.pid)
        return process.wait()


class _Running:
    """The job that a worker does now: in which process, since when, and why it was ended, if it was."""

    def __init__(self, job: Job) -> None:
        self._job, self.times = job, StageTimes()
        self.verdict: tuple[str, str] | None = None
        self._process: psutil.Process | None = None
        self._since = time.monotonic()

    def moved(self, pid: int | None) -> None:
        """The job is done by this process from now on; None: by none for a while."""
        import psutil

        self._process = None
        if pid is not None:
            if self.verdict is not None:
                _kill(pid)  # the process before it ended of itself, just when it was to be ended
            with contextlib.suppress(psutil.Error):
                self._process = psutil.Process(pid)
        self._since, self.times = time.monotonic(), StageTimes()

    def keep_within_limits(self) -> None:
        """Kill the process where it takes too long, or too much memory."""
        import psutil

        job, process = self._job, self._process
        if process is None or self.verdict is not None:
            return
        with contextlib.suppress(psutil.Error):
            if time.monotonic() - self._since > job.time_limit_s:
                reader, limit = of_ending(Path(job.source).suffix), "time_limit_s (--time-limit)"
                longest = self.times.longest()
                coarser = "ask for a larger accuracy"
                self.verdict = (
                    "TimeLimit",
                    given_up(job.source, reader, job.time_limit_s, longest, limit, coarser) + ".",
                )
            elif process.memory_info().rss > job.memory_limit_mb * 1e6:
                self.verdict = (
                    "MemoryLimit",
                    f"{job.source} took more than {job.memory_limit_mb:g} MB of memory and was given up: raise "
                    "memory_limit_mb" + ("." if self.times.stage in READS else ", or ask for a larger accuracy."),
                )
            else:
                return
            _kill(process.pid)


def _ended(outcome: Any) -> Outcome:
    assert isinstance(outcome, Outcome)
    return outcome


def _why(job: Job, stage: str, code: int | None) -> tuple[str, str]:
    """Why a job has no outcome: the kind of failure, and a sentence."""
    name, reader = job.source, of_ending(Path(job.source).suffix)
    if code is None or code >= 0:
        if reader is not None and reader.kind == "script":
            return "SourceError", f"{name} ended its process before anything was drawn; take os._exit out of it."
        return "Crash", f"{name}: the process that drew it ended with exit code {code}."
    if -code == _KILLED:
        return "SourceError", f"{name}: the work was killed, most likely for want of memory."
    reason = CRASHES.get(-code, f"signal {-code}")
    if stage in DOING and reader is not None and reader.crash:
        return "SourceError", f"{reader.crash.format(name=name, reason=reason, doing=DOING[stage])}."
    return "Crash", f"{name} crashed hlr ({reason}); this is a fault of hlr, please report it with the model."


def _kill(pid: int) -> None:
    """Kill a process and all that it has started."""
    import psutil

    with contextlib.suppress(psutil.Error):
        process = psutil.Process(pid)
        for each in (*process.children(recursive=True), process):
            with contextlib.suppress(psutil.Error):
                each.kill()
