"""Stale drawings: those of an earlier run that still lie in the folder of outputs, though the batch draws them no more.

Their sources are gone, or are drawn without these views, sections or formats. A source that is there, but is no part of
the batch, may be left out of this run only: its drawings stay.

What an earlier run has drawn stands in its report, `manifest.json`. Nothing else in the folder is looked at.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from hlr.batch.plan import MOST_NAMED, Plan
from hlr.errors import counted
from hlr.tables.writers import WRITERS

Stale = dict[str, str]
"""As the report has it. file: from the folder of outputs; source: from the folder of the batch."""


def stale(plan: Plan) -> list[Stale]:
    """The stale drawings, by name. Call it before the new report is written."""
    planned = {name.casefold() for job in plan.jobs for names in job.files for name in names}
    drawn = {_place(Path(job.root, job.source)) for job in plan.jobs}
    found = {}
    for name, source, path in _earlier(plan.output):
        is_no_more = not os.path.lexists(path) or _place(path) in drawn
        if is_no_more and name.casefold() not in planned and _is_drawing(plan.output, name):
            found[name] = source
    return [{"file": name, "source": found[name]} for name in sorted(found)]


def told(rows: Sequence[Stale], output: Path) -> str:
    """One sentence that names the drawings, and what removes them."""
    names = ", ".join(row["file"] for row in rows[:MOST_NAMED])
    more = f" and {len(rows) - MOST_NAMED} more" if len(rows) > MOST_NAMED else ""
    one = len(rows) == 1
    why = "stays though the batch draws it no more" if one else "stay though the batch draws them no more"
    return (
        f"{counted(len(rows), 'drawing')} in {output} {why}: {names}{more}; --prune removes {'it' if one else 'them'}"
    )


def remove(rows: Sequence[Stale], output: Path) -> list[Stale]:
    """Remove stale drawings. Returns those that cannot be removed."""
    left = []
    for row in rows:
        try:
            (output / row["file"]).unlink()
        except OSError:
            left.append(row)
    return left


def folder_of(plan: Plan) -> str | None:
    """The folder of the batch from the folder of outputs; None: they are on different drives."""
    with suppress(ValueError):
        return Path(os.path.relpath(plan.manifest.root, plan.output)).as_posix()
    return None


def _place(path: Path) -> str:
    """One name for a file, however its path is written."""
    return os.path.normcase(os.path.realpath(path))


def _earlier(output: Path) -> Iterator[tuple[str, str, Path]]:
    """The drawings that the last report has: name, source as it has it, and its path. A broken one has none."""
    with suppress(OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
        report: dict[str, Any] = json.loads((output / "manifest.json").read_bytes())
        root = output / report["folder"]
        rows = [(row["file"], row["source"]) for row in report["stale"]]
        for source in report["sources"]:
            rows += [(name, source["source"]) for drawing in source["drawings"] for name in drawing["files"].values()]
        for name, path in rows:
            yield str(name), str(path), root / path


def _is_drawing(output: Path, name: str) -> bool:
    """Whether there is such a file, in the folder and not where a link leads, and of a format that hlr writes."""
    path = output / name
    with suppress(OSError, ValueError):
        inside = not Path(name).is_absolute() and Path(os.path.realpath(path)) == Path(os.path.realpath(output), name)
        return inside and path.is_file() and path.suffix.lower().removeprefix(".") in WRITERS
    return False
