"""Run a batch: what is unchanged is left alone, the rest goes to a pool, and every drawing is written as it comes."""

from __future__ import annotations

import math
import os
import re
import shlex
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from hlr.batch.job import Job, Outcome, failed
from hlr.batch.kept import Kept
from hlr.batch.manifest import Manifest
from hlr.batch.parameters import check_parameters
from hlr.batch.plan import REPORTS, Plan
from hlr.batch.request import check, wrong_one
from hlr.common.numbers import typed
from hlr.drawing import files
from hlr.errors import HlrError, WriteError
from hlr.tables.readers import of_ending

if TYPE_CHECKING:
    from hlr.batch.pool import Pool


class Listener(Protocol):
    """Whoever watches a batch. Jobs are told by their number in the plan."""

    def planned(self, plan: Plan, todo: Sequence[int]) -> None:
        """These jobs have to be drawn, or cannot be written from the cache; all others are unchanged."""

    def begun(self, number: int, stage: str) -> None:
        """A job has come to a stage."""

    def ended(self, number: int, outcome: Outcome) -> None:
        """A job was carried out, and its files are written."""

    def out_of_time(self, left: int) -> None:
        """The time of the whole batch is up, and so many jobs are not drawn."""


@dataclass(frozen=True, slots=True)
class Done:
    """A batch that is done: an outcome for each job of the plan, and the numbers of those that were drawn now."""

    plan: Plan
    outcomes: tuple[Outcome, ...]
    drawn: tuple[int, ...]

    @property
    def failed_files(self) -> tuple[str, ...]:
        """Names of the files that jobs which failed would have written."""
        pairs = zip(self.plan.jobs, self.outcomes, strict=True)
        return tuple(name for job, outcome in pairs if outcome.failure for names in job.files for name in names)


def run(plan: Plan, kept: Kept, pool: Callable[[], Pool], listener: Listener) -> Done:
    """Carry out all jobs of a plan. pool: called when there is work for it; whoever made it closes it.

    Where the time of the whole batch is up, what runs is ended; jobs that are not drawn have failed.

    Raises OptionError, ViewError where an option of a job cannot be drawn, before anything is; WriteError where
    the report cannot be written into the folder of outputs.
    """
    limit = plan.manifest.total_time_limit_s
    deadline = time.monotonic() + limit if limit else math.inf
    outcomes: dict[int, Outcome] = {}
    for number, job in enumerate(plan.jobs):
        outcome = kept.find(job)
        if outcome is not None:
            outcomes[number] = without_contents(written(plan, job, outcome))
    lost = [number for number, outcome in outcomes.items() if outcome.failure is not None]
    todo = [number for number in _largest_first(plan.jobs) if number not in outcomes]
    _check_options(plan.manifest, [plan.jobs[number] for number in todo])
    check_parameters(plan, {plan.jobs[number].rule for number in todo if plan.jobs[number].parameters})
    listener.planned(plan, [*lost, *todo])
    for number in lost:
        listener.ended(number, outcomes[number])
    if todo:
        _check_output(plan.output)
        for event in pool().run([plan.jobs[number] for number in todo], deadline):
            number = todo[event.number]
            if event.outcome is None:
                listener.begun(number, event.stage)
                continue
            job = plan.jobs[number]
            outcome = written(plan, job, event.outcome)
            kept.keep(job, outcome)
            # The contents are on disk now: in memory they would add up.
            outcomes[number] = without_contents(outcome)
            listener.ended(number, outcomes[number])
    late = [number for number in todo if number not in outcomes]
    if late:
        listener.out_of_time(len(late))
        outcomes |= {number: _late(plan.jobs[number], limit) for number in late}
    return Done(plan, tuple(outcomes[number] for number in range(len(plan.jobs))), tuple(sorted([*lost, *todo])))


def _check_output(folder: Path) -> None:
    """Raise WriteError where the report cannot be written into the folder of outputs: it comes last of all."""
    from hlr.batch.page.write import FOLDER, INDEX

    for name in (*REPORTS, INDEX, f"{FOLDER}/data.js"):
        files.check_writable(folder / name, make_folder=True)


def _late(job: Job, limit: float) -> Outcome:
    """The outcome of a job that was not drawn in the time of the batch. limit: that time, seconds."""
    return failed(
        "TotalTimeLimit",
        f"{job.source} is not drawn: the batch has taken its {typed(limit)} s; run it again to go on, or raise "
        "total_time_limit_s (--total-time-limit).",
    )


def written(plan: Plan, job: Job, outcome: Outcome) -> Outcome:
    """Write the files of an outcome, all or none; what is there already, byte for byte, is not touched."""
    if outcome.failure is not None:
        return outcome
    contents: dict[Path, bytes] = {}
    for names, row in zip(job.files, outcome.contents, strict=True):
        for name, content in zip(names, row, strict=True):
            path = plan.output / name
            if _content(path, len(content)) != content:
                contents[path] = content
    try:
        files.write_all(contents, dict.fromkeys(path.parent for path in contents))
    except WriteError as error:
        return failed("WriteError", str(error), outcome.seconds)
    return outcome


def without_contents(outcome: Outcome) -> Outcome:
    """The outcome without the bytes of its files."""
    return replace(outcome, contents=())


def tidy(folder: Path) -> None:
    """Remove what runs that were killed have left unfinished under a folder, an hour ago or more."""
    for place, _, names in os.walk(folder):
        for name in filter(_UNFINISHED.fullmatch, names):
            path = Path(place, name)
            with suppress(OSError):
                if path.stat().st_mtime < time.time() - _ABANDONED_S:
                    path.unlink()


_UNFINISHED = re.compile(r"\..*\.[0-9a-f]{8}\.tmp")
"""A file of `hlr.drawing.files.write_all` that has not got its name yet."""

_ABANDONED_S = 3600.0


def _content(path: Path, size: int) -> bytes | None:
    """The content of a file of this size; None: there is no such file."""
    with suppress(OSError):
        if path.stat().st_size == size:
            return path.read_bytes()
    return None


def _largest_first(jobs: Sequence[Job]) -> list[int]:
    """The jobs' numbers: large sources first, so that none of them is left alone at the end."""
    return sorted(range(len(jobs)), key=lambda number: (-source_size(jobs[number]), number))


def source_size(job: Job) -> int:
    """Bytes; 0 where there is no such file."""
    with suppress(OSError):
        return Path(job.root, job.source).stat().st_size
    return 0


def _check_options(manifest: Manifest, jobs: Sequence[Job]) -> None:
    """Raise OptionError or ViewError where the options of a job, or its views, cannot be drawn."""
    seen = set()
    for job in jobs:
        if (job.rule, job.views) in seen:
            continue
        seen.add((job.rule, job.views))
        options = {name: value for name, value in job.options.items() if name != "parameters"}
        try:
            check(options, job.views, job.root, job.arrange)
        except HlrError as error:
            name = wrong_one(options, job.root, job.arrange) or "views"
            documents = [each.source for each in jobs if each.rule == job.rule and _has_pages(each.source)]
            is_page = name == "page" and isinstance(options[name], str) and documents
            text = _no_pages(options["page"], documents[0]) if is_page else str(error)
            raise manifest.error((*job.rule, name), text) from None


def _has_pages(source: str) -> bool:
    reader = of_ending(Path(source).suffix)
    return reader is not None and reader.kind == "fcstd"


def _no_pages(page: str, document: str) -> str:
    """What is said where a page is asked for that is no sheet, and may be one of a document."""
    return (
        f"a sheet such as A3 is needed, not {page!r}: batches draw no TechDraw pages; "
        f"hlr draw {shlex.quote(document)} --page {shlex.quote(page)} draws one"
    )
