"""What has changed in the drawings of a batch since its baseline."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from hlr.batch.baseline import FOLDER, Baseline
from hlr.batch.run import Done
from hlr.compare import compare
from hlr.compare.difference import KINDS
from hlr.drawing import files
from hlr.errors import HlrError

_COMPARED = ("svg", "json")
"""Formats that can be compared; the first that a drawing has is."""

Change = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Changes:
    """The change of each drawing, by the name of its first file; and drawings that are no longer made."""

    of: dict[str, Change]
    gone: tuple[str, ...]

    def __str__(self) -> str:
        states = [change["state"] for change in self.of.values()]
        told = ", ".join(f"{states.count(state)} {state}" for state in ("unchanged", "changed", "new"))
        return f"{told}, {len(self.gone)} gone"

    @property
    def any(self) -> bool:
        """Whether something differs from the baseline."""
        return bool(self.gone) or any(change["state"] != "unchanged" for change in self.of.values())


def changes(done: Done, baseline: Baseline) -> Changes:
    """Compare the drawings of a batch with earlier ones. What is the same byte for byte is not looked into.

    Earlier drawings that differ, and overlays, are written into the folder of outputs. Raises WriteError where they
    cannot be, OptionError where the baseline cannot be read.
    """
    found: dict[str, Change] = {}
    for job, outcome in zip(done.plan.jobs, done.outcomes, strict=True):
        if outcome.failure is None:
            for names in job.files:
                found[names[0]] = _change(done.plan.output, dict(zip(job.formats, names, strict=True)), baseline)
    planned = {name for job in done.plan.jobs for names in job.files for name in names}
    return Changes(found, tuple(sorted(baseline.names() - planned)))


def _change(output: Path, names: dict[str, str], baseline: Baseline) -> Change:
    format = next((each for each in _COMPARED if each in names), next(iter(names)))
    name = names[format]
    same = baseline.same(name, (output / name).read_bytes())
    if same is None:
        return _told("new", "not in the baseline")
    if same:
        return _told("unchanged", "the same bytes")
    if format not in _COMPARED:
        return _told("changed", f"other bytes; with {' or '.join(_COMPARED)} among the formats it is told what differs")
    before, overlay = PurePosixPath(FOLDER, name), PurePosixPath(FOLDER, f"{name}.overlay.svg")
    _write(output / before, baseline.read(name))
    try:
        compared = compare(output / before, output / name, register="translation")
    except HlrError as error:
        return _told("changed", str(error))
    if compared.same:
        (output / before).unlink()
        return _told("unchanged", compared.summary)
    _write(output / overlay, compared.to_svg().encode())
    change = _told("changed", compared.summary) | {"mm": compared.lengths_mm, "overlay": str(overlay)}
    return change | ({"before": str(before)} if format == "svg" else {})


def _told(state: str, summary: str) -> Change:
    return {"state": state, "summary": summary, "mm": dict.fromkeys(KINDS, 0.0)}


def _write(path: Path, content: bytes) -> None:
    files.write_all({path: content}, [path.parent])
