"""Pools: whoever carries out jobs. `LocalPool` does so with worker processes on this machine.

Any object that follows the protocol `Pool` will do: what runs elsewhere gets jobs and gives outcomes as plain data.
"""

from __future__ import annotations

import contextlib
import math
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from queue import Empty, SimpleQueue
from typing import Protocol

from hlr.batch.job import Job, Outcome
from hlr.batch.worker import Begun, Ended, Worker

_GLANCE = 0.1
"""Seconds between two looks at the time and memory that the running jobs take."""


@dataclass(frozen=True, slots=True)
class Event:
    """Something happened to a job. number: its place among the jobs. stage: it has begun; outcome: it has ended."""

    number: int
    stage: str = ""
    outcome: Outcome | None = None


class Pool(Protocol):
    """Carries out jobs, in any order and each once."""

    def run(self, jobs: Sequence[Job], deadline: float = math.inf) -> Iterator[Event]:
        """Carry out jobs, the first ones first. Each ends with one event that has an outcome, whatever goes wrong.

        deadline: of `time.monotonic`, seconds. Then all that still runs is ended, and jobs that have not ended have no
        such event.
        """

    def close(self) -> None:
        """End all that still runs."""


class LocalPool:
    """Worker processes on this machine, started when there is work for them and kept until the pool is closed."""

    def __init__(
        self,
        workers: int,
        environment: Mapping[str, str] | None = None,
        wanted: Callable[[], bool] = lambda: True,
    ) -> None:
        """workers: at most so many at the same time. environment: variables of theirs that differ from those of this
        process. wanted: asked all the time; once it says no, all jobs are ended."""
        self._most, self._environment, self.wanted = workers, environment, wanted
        self._workers: list[Worker] = []
        self._said: SimpleQueue[Begun | Ended] = SimpleQueue()

    def run(self, jobs: Sequence[Job], deadline: float = math.inf) -> Iterator[Event]:
        """As of `Pool`."""
        while len(self._workers) < min(self._most, len(jobs)):
            self._workers.append(Worker(self._said, self._environment))
        # Jobs that run at the same time share the cores; the number of threads changes no byte.
        threads = max(1, (os.cpu_count() or 1) // max(1, min(self._most, len(jobs))))
        shared = [replace(job, options={"threads": threads, **job.options}) for job in jobs]
        waiting, left = iter(enumerate(shared)), len(jobs)
        for worker in self._workers:
            _give(worker, waiting)
        looked = time.monotonic()
        while left:
            if (time_left := deadline - time.monotonic()) <= 0.0:
                ended = list(self._ended())
                self.close()
                yield from ended
                return
            # Not only where nothing is said: quick jobs beside an endless one always have something to say.
            if time.monotonic() - looked >= _GLANCE:
                looked = time.monotonic()
                if not self.wanted():
                    self.close()
                    return
                for worker in self._workers:
                    worker.keep_within_limits()
            try:
                said = self._said.get(timeout=min(_GLANCE, time_left))
            except Empty:
                continue
            if isinstance(said, Begun):
                yield Event(said.number, stage=said.stage)
            else:
                left -= 1
                _give(said.worker, waiting)
                yield Event(said.number, outcome=said.outcome)

    def _ended(self) -> Iterator[Event]:
        """Jobs that have ended already, and were not told of yet."""
        with contextlib.suppress(Empty):
            while True:
                said = self._said.get_nowait()
                if isinstance(said, Ended):
                    yield Event(said.number, outcome=said.outcome)

    def close(self) -> None:
        """As of `Pool`."""
        for worker in self._workers:
            worker.end()
        for worker in self._workers:
            worker.wait()
        self._workers.clear()
        self._said = SimpleQueue()  # what they may still say is of jobs that have been given up


def _give(worker: Worker, waiting: Iterator[tuple[int, Job]]) -> None:
    with contextlib.suppress(StopIteration):
        worker.give(*next(waiting))
