"""Outcomes that are kept: what was drawn once is not drawn again while nothing that it depends on has changed.

They lie in the folder where models that were read are kept (`hlr.cache`), one file for each job, and are written whole
or not at all. There is no index and no lock: two runs at once, or one that is killed, leave whole entries, and a CI
service can pack the folder and bring it back. An entry has the facts as JSON, then the contents of the files.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from time import time

from hlr.batch.job import Job, Outcome
from hlr.batch.keys import Digests, key_of
from hlr.cache.entry import DamagedError, packed, unpacked
from hlr.cache.store import NotKeptError, Store


class Kept:
    """The outcomes that a folder keeps.

    store     None where nothing is to be kept
    not_kept  why the last outcome that should have been kept was not, in a few words; empty: all were
    """

    def __init__(self, store: Store | None, digests: Digests) -> None:
        self._store, self._digests = store, digests
        self.not_kept = ""

    def find(self, job: Job) -> Outcome | None:
        """The outcome of a job that nothing has changed of since; None where there is none."""
        key = key_of(job, self._digests) if self._store is not None else None
        if self._store is None or key is None:
            return None
        entry = self._store.read(key)
        if entry is None:
            return None
        with suppress(DamagedError, KeyError, TypeError, ValueError):
            facts, data = unpacked(key, entry)
            same = all(self._digests.of(Path(job.root, path)) == digest for path, digest in facts["depends"])
            if same and not self._any(job, facts["missed"]):
                self._store.touch(key)
                contents, at = [], 0
                for sizes in facts["sizes"]:
                    row = []
                    for size in sizes:
                        row.append(bytes(data[at : at + size]))
                        at += size
                    contents.append(tuple(row))
                depends = tuple(path for path, _ in facts["depends"])
                cost = facts["seconds"], facts["peak_memory_mb"]
                drawings, missed = tuple(facts["drawings"]), tuple(facts["missed"])
                return Outcome(None, drawings, tuple(contents), depends, *cost, missed)
        return None

    def _any(self, job: Job, paths: Iterable[str]) -> bool:
        """Whether one of these files is there."""
        return any(self._digests.of(Path(job.root, path)) is not None for path in paths)

    def keep(self, job: Job, outcome: Outcome) -> None:
        """Keep an outcome where that is possible. Of failures nothing is kept: the next run tries again."""
        if self._store is None or outcome.failure is not None:
            return
        key, used = key_of(job, self._digests), [Path(job.root, path) for path in (job.source, *outcome.depends)]
        self._digests.forget([*used, *(Path(job.root, path) for path in outcome.missed)])
        if key is None or key != key_of(job, self._digests) or _newest(used) > time() - outcome.seconds:
            return  # something has changed meanwhile
        if self._any(job, outcome.missed):
            return
        facts = {
            "depends": [[path, self._digests.of(Path(job.root, path))] for path in outcome.depends],
            "missed": outcome.missed,
            "drawings": outcome.drawings,
            "sizes": [[len(content) for content in row] for row in outcome.contents],
            "seconds": outcome.seconds,
            "peak_memory_mb": outcome.peak_memory_mb,
        }
        try:
            self._store.write(key, packed(key, facts, [content for row in outcome.contents for content in row]))
        except NotKeptError as error:
            self.not_kept = str(error)


def _newest(paths: Iterable[Path]) -> float:
    """When the newest of these files was changed, in seconds since the epoch; infinite where one is gone."""
    try:
        return max(path.stat().st_mtime for path in paths)
    except OSError:
        return float("inf")
