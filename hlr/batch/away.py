"""A job on another machine: a Dask worker gets the files that the job needs, and gives the outcome back.

The files lie in a folder of this job alone, each at the path that it has where it comes from. The Dask worker itself
draws nothing: it keeps a `LocalPool` of one process for each of its threads, so what ends that process costs that job.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hlr.batch.job import Job, Outcome
from hlr.batch.pool import LocalPool
from hlr.batch.versions import difference, versions
from hlr.errors import ClusterError

_IDLE_S = 30.0
"""A process that has had no job for so long is ended: it keeps OpenCASCADE in memory."""


def draw(job: Job, contents: Mapping[str, bytes], asked: Mapping[str, str]) -> Outcome:
    """The outcome of a job. Called by Dask, on one of its workers.

    contents: of the files that it needs, by absolute path where they come from. asked: the versions that count there.
    Raises ClusterError where those here are others.
    """
    from distributed import Reschedule, get_worker

    worker = get_worker()
    wrong = difference(asked, versions())
    if wrong:
        raise ClusterError(unlike(worker.address, wrong))
    key = worker.get_current_task()

    def wanted() -> bool:
        """Whether the outcome is: whoever asked may have gone."""
        task = worker.state.tasks.get(key)
        return task is not None and task.state != "cancelled"

    with TemporaryDirectory(prefix="hlr-", dir=worker.local_directory) as folder:
        home = os.path.realpath(folder)
        moved = replace(job, root=_below(home, job.root), options={"threads": 1, **job.options})
        os.makedirs(moved.root, exist_ok=True)
        for path, content in contents.items():
            file = Path(_below(home, path))
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        with _warm(wanted) as pool:
            outcomes = [event.outcome for event in pool.run([moved]) if event.outcome is not None]
        if outcomes:
            return _as_there(outcomes[0], home)
    # Nobody waits for it; or somebody does again, for Dask takes a job back where a file of it was on a killed worker.
    raise Reschedule


def unlike(address: str, difference: str) -> str:
    """What is said of a worker on which other versions are installed."""
    return f"the worker {address} would draw other bytes: {difference}: install the same versions on both machines"


def _below(home: str, path: str) -> str:
    return f"{home}/{path.lstrip('/')}"


def _as_there(outcome: Outcome, home: str) -> Outcome:
    """The outcome, with all paths as they are where the job comes from."""

    def put_right(value: Any) -> Any:
        match value:
            case str():
                return value.replace(home, "")
            case dict():
                return {name: put_right(each) for name, each in value.items()}
            case list() | tuple():
                return type(value)(map(put_right, value))
        return value

    failure = outcome.failure
    if failure is not None:
        failure = replace(failure, message=put_right(failure.message))
    drawings, depends = put_right(outcome.drawings), put_right(outcome.depends)
    missed, printed = put_right(outcome.missed), put_right(outcome.printed)
    return replace(outcome, failure=failure, drawings=drawings, depends=depends, missed=missed, printed=printed)


_idle: dict[LocalPool, threading.Timer] = {}
"""Pools that wait for a job, each with the clock that ends it."""

_lock = threading.Lock()


@contextmanager
def _warm(wanted: Callable[[], bool]) -> Iterator[LocalPool]:
    """A pool of one process, which nobody else has; one that is warm already where there is one."""
    with _lock:
        pool, clock = _idle.popitem() if _idle else (None, None)
    if clock is not None:
        clock.cancel()
    # What is read of a model is not kept here: the disk is another's.
    pool = pool or LocalPool(1, {"HLR_CACHE": "off"})
    pool.wanted = wanted
    try:
        yield pool
    except BaseException:
        pool.close()  # it may be at work
        raise
    clock = threading.Timer(_IDLE_S, _end, (pool,))
    clock.daemon = True
    with _lock:
        _idle[pool] = clock
    clock.start()


def _end(pool: LocalPool) -> None:
    with _lock:
        gone = _idle.pop(pool, None) is None
    if not gone:
        pool.close()
