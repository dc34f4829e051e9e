"""Messages of the commands beside their result: warnings, notes, summaries, reports."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from hlr.errors import StrictError

from .drawn_files import Targets
from .exits import remark, warn
from .streams import clear_line, say

if TYPE_CHECKING:
    from hlr.drawing.drawing import Drawing
    from hlr.drawing.notes import Note
    from hlr.drawing.picture import Picture


def tell_notes(notes: Iterable[Note], strict: bool = False, quiet: bool = False) -> None:
    """Print each note once, even of several views. strict: a warning raises StrictError; quiet: warnings only."""
    notes = list(dict.fromkeys(notes))
    warnings = [note for note in notes if note.is_warning]
    if strict and warnings:
        more = f" (and {len(warnings) - 1} more)" if len(warnings) > 1 else ""
        raise StrictError(f"{str(warnings[0]).rstrip('.')}{more}; nothing is written, because of --strict")
    for note in notes:
        if note.is_warning:
            warn(str(note))
        elif not quiet:
            remark(str(note))


def of_views(drawings: Sequence[Drawing | Picture], told: Sequence[Note] = ()) -> list[Note]:
    """The notes of several views, which name those that they are of, without those that are told already."""
    from hlr.drawing.notes import of_each_view

    notes = of_each_view([drawing.view.name for drawing in drawings], [drawing.notes for drawing in drawings])
    return [note for note in notes if note not in told]


def tell_early(notes: Iterable[Note], strict: bool = False, quiet: bool = False) -> None:
    """The same while a progress bar may be on the terminal: it is cleared first, and drawn anew below."""
    notes = list(notes)
    if notes:
        clear_line()
    tell_notes(notes, strict, quiet)


def summary(drawings: Sequence[Drawing], targets: Targets) -> bytes:
    """A summary of the drawings as JSON: one entry for each file."""
    import json
    from dataclasses import asdict

    from hlr.tables.documents import head
    from hlr.writers.json_records import accuracies

    entries = [
        {
            "file": str(target.path),
            "format": target.format,
            "source": drawing.source,
            "view": drawing.view.name,
            "scale": drawing.scale,
            "page": None if drawing.page is None else asdict(drawing.page),
            "accuracy": accuracies(drawing),
            "lines": _counts(drawing),
            "notes": [note.as_dict() for note in drawing.notes],
            "plan": [decision.as_dict() for decision in drawing.plan],
            "counters": dict(drawing.counters),
            "timings": dict(drawing.timings)
            | {"effects": {d.name: d.seconds for d in drawing.plan if d.seconds is not None}},
        }
        for drawing, row in zip(drawings, targets, strict=True)
        for target in row
    ]
    # Counters may be numbers of NumPy.
    document = head("hlr-summary") | {"drawings": entries}
    return json.dumps(document, indent=2, default=lambda value: value.tolist()).encode("ascii") + b"\n"


def tell_report(drawings: Sequence[Drawing]) -> None:
    """Print the accuracy that was asked for and reached, as a table."""
    from hlr.lab.measure.table import table

    for drawing in drawings:
        say(*table(drawing).split("\n"))


def tell_plan(drawings: Sequence[Drawing]) -> None:
    """Print the table of effects, and how the model was read, to standard error."""
    from hlr.request.effect import explained

    for drawing in drawings:
        if len(drawings) > 1:
            say(drawing.view.name)
        say(*explained(drawing.plan).split("\n"))
    if drawings and drawings[0].reading:
        say(f"{drawings[0].reading}.")


def tell_written(text: str, quiet: bool) -> None:
    """Print a line about what was written, on a terminal only: in a pipe success is silent."""
    if not quiet and sys.stderr is not None and sys.stderr.isatty():
        say(text)


def written(drawing: Drawing, targets: Sequence[object]) -> str:
    """One line about a drawing."""
    from hlr.drawing.scale import ratio

    counts = _counts(drawing)
    seconds = drawing.timings.get("total", 0.0)
    where = ", ".join(str(target) for target in targets)
    reached = f", accuracy {drawing.accuracy.used:.3g} mm" if drawing.accuracy.within is not None else ""
    page = "" if drawing.page is None else f" on {drawing.page.name}"
    return (
        f"{where}: {drawing.view.name}, {ratio(drawing.scale)}{page}, {counts['visible']} visible and "
        f"{counts['hidden']} hidden lines{reached}, {seconds:.1f} s"
    )


def _counts(drawing: Drawing) -> dict[str, int]:
    visible = sum(line.visible for line in drawing.lines)
    return {"visible": visible, "hidden": len(drawing.lines) - visible}
