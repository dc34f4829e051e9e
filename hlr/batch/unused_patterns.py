"""Patterns of parts that name a part of none of the sources that share them: one source that has one is enough."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from hlr.batch.job import OF_PARTS
from hlr.batch.schema import as_list

if TYPE_CHECKING:
    from hlr.batch.run import Done


def named(option: str, pattern: str) -> str:
    """How a note on an unused pattern begins."""
    return f'{option} "{pattern}" matches no part'


def unused_patterns(done: Done) -> Iterator[str]:
    """A sentence about each pattern that no source has a part for, of the sources that were drawn."""
    used: dict[tuple[str, str], bool] = {}
    for job, outcome in zip(done.plan.jobs, done.outcomes, strict=True):
        if not job.is_shared or outcome.failure is not None:
            continue
        notes = [note["text"] for note in outcome.drawings[0]["notes"] if note["code"] == "pattern-unused"]
        for option in OF_PARTS:
            for pattern in as_list(job.options.get(option, [])):
                begin = named(option, pattern)
                key = (option, pattern)
                used[key] = used.get(key, False) or not any(text.startswith(begin) for text in notes)
    for (option, pattern), is_used in used.items():
        if not is_used:
            yield f"{named(option, pattern)} in any of its sources"
