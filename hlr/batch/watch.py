"""Watch the files of a batch, and draw again what has changed on disk."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Protocol

from hlr.batch.request import files_of
from hlr.batch.run import Done
from hlr.tables.readers import of_ending

_STEP_MS = 20
"""Milliseconds between two looks at what the system has told."""

_SETTLE_MS = 40
"""Milliseconds that changes are gathered for: an editor writes a file in several steps."""


class Stop(Protocol):
    """Tells when to stop; `threading.Event` does."""

    def is_set(self) -> bool:
        """Whether to stop."""


def changes(root: Path, output: Path, others: set[Path], stop: Stop) -> Iterator[set[Path]]:
    """The files that have changed, time after time. Those in the folder of outputs do not count.

    root: watched with all its folders; others: files outside it; stop: looked at every few hundredths of a second.
    """
    from watchfiles import watch

    folders = {path.parent for path in others if not path.is_relative_to(root)}
    for changed in watch(root, *folders, step=_STEP_MS, debounce=_SETTLE_MS, stop_event=stop, raise_interrupt=True):
        paths = {Path(path) for _, path in changed}
        paths = {path for path in paths if not path.is_relative_to(output) and not _is_aside(path, root)}
        if paths:
            yield paths


def concern(done: Done, changed: set[Path]) -> bool:
    """Whether the files that have changed may change drawings: models, manifests, and what the sources depend on."""
    root = done.plan.manifest.root
    known = set()
    for job, outcome in zip(done.plan.jobs, done.outcomes, strict=True):
        files = (job.source, *job.depends, *outcome.depends, *files_of(job.options, job.root).values())
        known |= {Path(os.path.realpath(Path(root, file))) for file in files}
    return any(
        of_ending(path.suffix) is not None or path.suffix == ".toml" or path.resolve() in known for path in changed
    )


def _is_aside(path: Path, root: Path) -> bool:
    """Whether a path is hidden below the root, or is compiled code: no drawing depends on it."""
    parts = path.relative_to(root).parts if path.is_relative_to(root) else path.parts[-1:]
    return any(part.startswith(".") or part == "__pycache__" for part in parts)
