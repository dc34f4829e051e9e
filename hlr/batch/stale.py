"""Drawings of earlier runs that still lie in the folder of outputs, though this run does not draw them.

They are stale where the batch draws them no more: their sources are gone, or are drawn without these views, sections or
formats. All others stay, and the report lists them, so that later runs know of them. Others are:

- those of a source that is there, but is no part of the batch: it may be left out of this run only;
- those of a source that is drawn, where this run is only a part of the batch: it draws some of the earlier sources, or
  some of the views and formats that the manifest names;
- those of a source that has failed now.

What an earlier run has drawn stands in its report, `manifest.json`. Nothing else in the folder is looked at.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from hlr.batch.plan import MOST_NAMED, Plan
from hlr.errors import counted
from hlr.tables.writers import WRITERS

Row = dict[str, str]
"""As the report has it. file: from the folder of outputs; source: from the folder of the batch."""


class EarlierDrawings(NamedTuple):
    """Drawings of earlier runs that are still there, each by name.

    stale   those that the batch draws no more
    others  all else, which this run has not drawn
    spared  those of the others that would be stale if this run were the whole batch
    """

    stale: Sequence[Row] = ()
    others: Sequence[Row] = ()
    spared: Sequence[Row] = ()


def earlier(
    plan: Plan, failed: Sequence[str] = (), *, usual: Plan | None = None, is_part: bool = False
) -> EarlierDrawings:
    """The drawings of earlier runs. Call it before the new report is written.

    failed   names of files that were to be drawn now, and are not
    usual    the plan without the views and formats of the command line; None: as this one
    is_part  whether it is known that this run is only a part of the batch
    """
    planned, unfinished = _names(plan), {name.casefold() for name in failed}
    usually = planned if usual is None else _names(usual)
    drawn = {_place(Path(job.root, job.source)) for job in plan.jobs}
    rows = {name: path for name, path in _earlier(plan.output) if _is_drawing(plan.output, name)}
    there = {path for path in set(rows.values()) if os.path.lexists(path)}
    if plan.manifest.file is None and any(_place(path) not in drawn for path in there):
        is_part = True
    stale: list[Row] = []
    others: list[Row] = []
    spared: list[Row] = []
    for name in sorted(rows):
        path, key = rows[name], name.casefold()
        row = {"file": name, "source": _from(plan.manifest.root, path)}
        if key in planned:
            kinds = [others] if key in unfinished else []
        elif path not in there:
            kinds = [stale]
        elif _place(path) not in drawn or key in usually:
            kinds = [others]
        else:
            kinds = [others, spared] if is_part else [stale]
        for kind in kinds:
            kind.append(row)
    return EarlierDrawings(stale, others, spared)


def told(rows: Sequence[Row], output: Path) -> str:
    """One sentence that names the drawings, and what removes them."""
    one = len(rows) == 1
    why = "stays though the batch draws it no more" if one else "stay though the batch draws them no more"
    return (
        f"{counted(len(rows), 'drawing')} in {output} {why}: {_some(rows)}; --prune removes {'it' if one else 'them'}"
    )


def told_of_part(rows: Sequence[Row]) -> str:
    """One sentence that says why drawings are not removed."""
    one = len(rows) == 1
    return (
        f"{counted(len(rows), 'drawing')} of sources drawn here {'is' if one else 'are'} not removed, though not drawn "
        f"here ({_some(rows)}): this run is only a part of the batch, and --prune removes {'it' if one else 'them'} in "
        "a run of all of it"
    )


def remove(rows: Sequence[Row], output: Path) -> list[Row]:
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


def _some(rows: Sequence[Row]) -> str:
    """The names of the first drawings, and how many more there are."""
    more = f" and {len(rows) - MOST_NAMED} more" if len(rows) > MOST_NAMED else ""
    return ", ".join(row["file"] for row in rows[:MOST_NAMED]) + more


def _names(plan: Plan) -> set[str]:
    """The files of a plan, as a file system sees them that takes large and small letters for the same."""
    return {name.casefold() for job in plan.jobs for names in job.files for name in names}


def _from(root: Path, path: Path) -> str:
    """The path of a source from the folder of the batch; as it is where that is on another drive."""
    with suppress(ValueError):
        return Path(os.path.relpath(path, root)).as_posix()
    return path.as_posix()


def _place(path: Path) -> str:
    """One name for a file, however its path is written."""
    return os.path.normcase(os.path.realpath(path))


def _earlier(output: Path) -> Iterator[tuple[str, Path]]:
    """The drawings that the last report has, each with the path of its source. A broken one has none."""
    with suppress(OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
        report: dict[str, Any] = json.loads((output / "manifest.json").read_bytes())
        root = output / report["folder"]
        rows = [(row["file"], row["source"]) for key in ("stale", "others") for row in report.get(key, ())]
        for source in report["sources"]:
            rows += [(name, source["source"]) for drawing in source["drawings"] for name in drawing["files"].values()]
        for name, path in rows:
            yield str(name), root / path


def _is_drawing(output: Path, name: str) -> bool:
    """Whether there is such a file, in the folder and not where a link leads, and of a format that hlr writes."""
    path = output / name
    with suppress(OSError, ValueError):
        inside = not Path(name).is_absolute() and Path(os.path.realpath(path)) == Path(os.path.realpath(output), name)
        return inside and path.is_file() and path.suffix.lower().removeprefix(".") in WRITERS
    return False
