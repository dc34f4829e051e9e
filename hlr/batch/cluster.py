"""Jobs on other machines, by Dask: sources go out as content, and outcomes come back as plain data.

Every file is a task of its own, named by its content, so it goes out once however many jobs need it, and Dask makes
it again where the worker that held it is killed. No disk is shared. Dask sees to all else: which worker does what, and
that the jobs of a worker that ends run elsewhere.
"""

from __future__ import annotations

import math
import time
from collections import OrderedDict, deque
from collections.abc import Iterator, Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any, cast
from uuid import uuid4

from hlr.batch import away
from hlr.batch.carry_out import carry_out
from hlr.batch.job import Job, Outcome, failed
from hlr.batch.pool import Event
from hlr.batch.pulled_in import needed
from hlr.batch.versions import difference, versions
from hlr.errors import ClusterError

PATIENCE_S = 10.0
"""Seconds that a scheduler has to answer, and that it may be without any worker."""

_GLANCE_S = 2.0
"""Seconds between two looks whether scheduler and workers are there."""

_MOST_BYTES = 200_000_000
"""Of files that the scheduler is to remember besides those of the jobs that are out."""

_AHEAD = 2
"""Jobs that are out for each thread of the workers: while one is drawn, the next one's files arrive."""


class DaskPool:
    """Workers of a Dask scheduler, as a `hlr.batch.pool.Pool`."""

    def __init__(self, address: str, most: int | None = None) -> None:
        """address: of the scheduler, such as tcp://host:8786. most: jobs at the same time; None: as many as fit.

        Raises ClusterError where Dask is not installed, no scheduler answers, it has no workers, or these would draw
        other bytes.
        """
        self._address, self._most, self._versions = address, most, versions()
        self._client = _connected(address)
        self._files: OrderedDict[str, tuple[Any, int]] = OrderedDict()
        self._out: dict[str, tuple[int, Any]] = {}
        self._seen = self._looked = time.monotonic()
        try:
            self._check_workers()
        except BaseException:
            self.close()
            raise

    def run(self, jobs: Sequence[Job], deadline: float = math.inf) -> Iterator[Event]:
        """As of `hlr.batch.pool.Pool`. Raises ClusterError where the scheduler goes away, or all workers do."""
        ended: SimpleQueue[Any] = SimpleQueue()
        waiting = deque(enumerate(jobs))
        while waiting or self._out:
            if (time_left := deadline - time.monotonic()) <= 0.0:
                yield from self._given_up(jobs)
                return
            while waiting and len(self._out) < self._room:
                number, job = waiting.popleft()
                if not Path(job.root, job.source).is_file() or (files := _contents(job)) is None:
                    yield Event(number, outcome=carry_out(job))  # it cannot be read: this says why
                    continue
                future = self._sent(job, files)
                self._out[future.key] = number, future
                future.add_done_callback(ended.put)
            self._look()
            with suppress(Empty):
                future = ended.get(timeout=min(_GLANCE_S, time_left))
                number, _ = self._out.pop(future.key)
                yield Event(number, outcome=self._outcome(jobs[number], future))

    def _given_up(self, jobs: Sequence[Job]) -> Iterator[Event]:
        """End all jobs that are out, but those that are drawn already."""
        out = list(self._out.values())
        self._out.clear()
        self._client.cancel([future for _, future in out if future.status != "finished"], force=True)
        for number, future in out:
            if future.status == "finished":
                yield Event(number, outcome=self._outcome(jobs[number], future))

    def close(self) -> None:
        """As of `Pool`: jobs that are out are ended by their workers."""
        with suppress(Exception):  # there may be nobody to tell
            self._client.cancel([future for _, future in self._out.values()], force=True)
        with suppress(Exception):
            self._client.close(timeout=2.0)

    def _sent(self, job: Job, files: dict[str, bytes]) -> Any:
        """The future of a job's outcome."""
        held = {path: self._file(content) for path, content in files.items()}
        key = f"hlr-job-{uuid4().hex}"
        return self._client.submit(away.draw, job, held, self._versions, key=key, pure=False)

    def _file(self, content: bytes) -> Any:
        """The future of a file's content."""
        key = f"hlr-file-{sha256(content).hexdigest()}"
        if key not in self._files:
            self._files[key] = self._client.submit(_as_it_is, content, key=key), len(content)
        self._files.move_to_end(key)
        while len(self._files) > 1 and sum(size for _, size in self._files.values()) > _MOST_BYTES:
            self._files.popitem(last=False)  # jobs that are out still have it
        return self._files[key][0]

    def _outcome(self, job: Job, future: Any) -> Outcome:
        """What became of a job. Raises ClusterError where the cluster failed, and not the job."""
        if future.status == "cancelled":
            raise self._gone()
        try:
            outcome: Outcome = future.result(timeout=PATIENCE_S * 6)
            return outcome
        except ClusterError:
            raise
        except Exception as error:
            if self._client.status != "running":
                raise self._gone() from None
            if type(error).__name__ == "KilledWorker":
                return failed(
                    "KilledWorker", f"{job.source}: one worker after the other ended while it was drawn there."
                )
            text = " ".join(str(error).split())
            return failed("ClusterError", f"{job.source}: a worker could not draw it: {type(error).__name__}: {text}")

    def _look(self) -> None:
        """Raise ClusterError where the scheduler, or the last worker, has been away for too long."""
        now = time.monotonic()
        if now - self._looked < _GLANCE_S:
            return
        self._looked = now
        self._count()
        if self._threads:
            self._seen = now
        elif now - self._seen > PATIENCE_S:
            raise ClusterError(f"all workers of the scheduler {self._address} have ended: start some and run it again")

    def _count(self) -> None:
        try:
            client = self._client
            threads: dict[str, int] = client.sync(client.scheduler.ncores, workers=None, callback_timeout=PATIENCE_S)
        except Exception:  # whatever Dask raises then
            raise self._gone() from None
        self._threads = sum(threads.values())

    @property
    def _room(self) -> int:
        """The number of jobs that may be out."""
        room = max(2, _AHEAD * self._threads)
        return room if self._most is None else min(room, self._most)

    def _gone(self) -> ClusterError:
        return ClusterError(
            f"the scheduler {self._address} has gone: what was drawn is there, and the next run draws the rest"
        )

    def _check_workers(self) -> None:
        """Raise ClusterError where there are none, or they would draw other bytes."""
        try:
            self._client.wait_for_workers(1, timeout=PATIENCE_S)
        except TimeoutError:
            raise ClusterError(
                f"the scheduler {self._address} has no workers: start some with dask worker {self._address}"
            ) from None
        self._count()

        def of_worker() -> dict[str, str] | None:  # goes out as code: hlr may not be there
            try:
                from hlr.batch.versions import versions
            except ImportError:
                return None
            return versions()

        for worker, found in self._client.run(of_worker, on_error="return").items():
            if not isinstance(found, dict):
                raise ClusterError(f"the worker {worker} cannot import this version of hlr: install it there")
            wrong = difference(self._versions, found)
            if wrong:
                raise ClusterError(away.unlike(worker, wrong))


def _connected(address: str) -> Any:
    """A client of the scheduler."""
    try:
        import dask.config

        quiet = dict.fromkeys(("distributed", "distributed.client", "tornado.application"), "critical")
        # One sentence tells of an error, not a log; and a model is no mistake in a graph, as Dask would think.
        dask.config.set({"logging": quiet, "distributed.admin.large-graph-warning-threshold": "10GB"})
        from distributed import Client
    except ImportError:
        raise ClusterError("--on needs Dask: pip install 'hlr-drawing[cluster]'") from None
    try:
        return cast("Any", Client)(address, timeout=PATIENCE_S, set_as_default=False)
    except (OSError, TimeoutError):
        raise ClusterError(f"no scheduler answers at {address} within {PATIENCE_S:g} s") from None
    except (ValueError, TypeError, RuntimeError) as error:
        raise ClusterError(f"{address} is no address of a scheduler, such as tcp://host:8786: {error}") from None


def _contents(job: Job) -> dict[str, bytes] | None:
    """The files that a job needs, by absolute path; None: the source cannot be read. What is not there is left out."""
    found = {}
    for number, path in enumerate(needed(job)):
        try:
            if path.is_file():
                found[path.as_posix()] = path.read_bytes()
        except OSError:
            if number == 0:
                return None
    return found


def _as_it_is(content: bytes) -> bytes:
    return content
