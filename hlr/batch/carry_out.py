"""Carry out one job in this process: draw its views, and tell what the drawings depend on."""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, cast

from hlr.batch.discover import takes_parameters
from hlr.batch.files_read import FilesRead, recording
from hlr.batch.job import OF_PARTS, Job, Outcome, failed
from hlr.batch.request import files_of, options_of
from hlr.batch.unused_patterns import named
from hlr.common.own_modules import forgotten, is_installed, own_modules
from hlr.common.process import debugging
from hlr.errors import HlrError, StrictError, respelled
from hlr.source.step_references import references

if TYPE_CHECKING:
    from hlr.common.types import Progress
    from hlr.drawing.drawing import Drawing
    from hlr.drawing.notes import Note
    from hlr.public.arranged import Method
    from hlr.request.options import Options, View
    from hlr.source.model import Source


def carry_out(job: Job, progress: Progress | None = None) -> Outcome:
    """Draw all views of a job. Whatever goes wrong becomes a failure of the outcome; nothing is written."""
    started, before = perf_counter(), set(sys.modules)
    forgotten()  # of what was drawn before
    read = FilesRead([Path(job.root), Path(job.root, job.source).parent], is_installed)
    try:
        with recording(read) if takes_parameters(Path(job.source)) else nullcontext():
            outcome = _drawn(job, progress)
    except StrictError as error:
        why = str(error).rstrip(".")
        outcome = failed(
            "StrictError", f"{job.source}: {why}; nothing is written, because warnings are errors (strict)."
        )
    except HlrError as error:
        # A file that is not there, or cannot be read, is named by its path: the report says it from the batch's folder.
        text, path = respelled(str(error), str), str(Path(job.root, job.source))
        outcome = failed(type(error).__name__, job.source + text.removeprefix(path) if text.startswith(path) else text)
    except MemoryError:
        outcome = failed("MemoryError", f"{job.source}: out of memory; a larger accuracy needs less.")
    except Exception as error:
        if debugging():
            raise
        text = " ".join(str(error).split()) or "no message"
        outcome = failed(
            "InternalError",
            f"{job.source}: internal error: {type(error).__name__}: {text}; this is a fault of hlr, please report it.",
        )
    modules = own_modules(set(sys.modules) - before)
    for name in modules:  # the next job imports them again, as they are then
        del sys.modules[name]
    modules |= forgotten()
    source = Path(job.root, job.source)
    known = (job.source, *files_of(job.options, job.root).values())
    # Links may lead to one another: `Path.resolve` raises then.
    opened = set(read.files) - {Path(os.path.realpath(Path(job.root, name))) for name in known}
    depends = {*modules.values(), *references(source), *opened}
    return replace(
        outcome,
        depends=tuple(sorted(_from_root(path, job.root) for path in depends)),
        missed=tuple(sorted(_from_root(path, job.root) for path in read.missed)),
        seconds=round(perf_counter() - started, 4),
        peak_memory_mb=_peak_memory_mb(),
    )


def _drawn(job: Job, progress: Progress | None) -> Outcome:
    from hlr.drawing.saving import render
    from hlr.pipeline.session import refuse_warnings
    from hlr.source.selection import open_whole
    from hlr.writers.left_out import left_out

    views = cast("list[View]", list(job.views))
    source: Any
    options, source = options_of(job.options, job.root), str(Path(job.root, job.source))
    missed: list[Note] = []
    if job.is_shared and any(getattr(options, name) for name in OF_PARTS):
        opened = open_whole(source, options)
        options, missed = for_its_parts(options, opened)
        source = opened
    if job.arrange:
        from hlr.public.arranged import draw_arranged

        printed = dict(job.printed)
        if "template" in printed:
            printed["template"] = Path(job.root, printed["template"])
        drawings = [draw_arranged(source, cast("Method", job.arrange), views, options, progress, **printed)]
    else:
        from hlr.public.draw import draw_views

        drawings = draw_views(source, views, options, progress)
    more = [
        [*missed, *(note for format in job.formats for note in left_out(each, format, format.upper()))]
        for each in drawings
    ]
    if options.strict:
        refuse_warnings([note for notes in more for note in notes])
    started = perf_counter()
    contents = tuple(tuple(render(drawing, format) for format in job.formats) for drawing in drawings)
    writing = (perf_counter() - started) / len(drawings)
    facts = (_facts(drawing, notes, writing) for drawing, notes in zip(drawings, more, strict=True))
    return Outcome(None, tuple(facts), contents)


def for_its_parts(options: Options, source: Source) -> tuple[Options, list[Note]]:
    """Options that are for several sources, without the patterns that name no part of this one, and notes on these.

    A source of which `only` names nothing keeps it, and is refused.
    """
    from hlr.drawing.notes import Note
    from hlr.source.selection import unmatched

    notes = []
    for name in OF_PARTS:
        patterns: Sequence[str] = getattr(options, name)
        missed = unmatched(patterns, source)
        if missed and not (name == "only" and len(missed) == len(patterns)):
            kept: dict[str, Any] = {name: tuple(each for each in patterns if each not in missed)}
            options = replace(options, **kept)
            notes += [Note("pattern-unused", f"{named(name, each)}: other sources share it.") for each in missed]
    return options, notes


def _facts(drawing: Drawing, more: Sequence[Note], writing: float) -> dict[str, Any]:
    """What the report says of a drawing. more: notes on its files; writing: seconds."""
    import json

    from hlr.writers.json_records import accuracies

    bounds, visible = drawing.bounds, sum(bool(line.visible) for line in drawing.lines)
    facts = {
        "view": drawing.view.name,
        "scale": drawing.scale,
        "width_mm": bounds.x1 - bounds.x0,
        "height_mm": bounds.y1 - bounds.y0,
        "lines": {"visible": visible, "hidden": len(drawing.lines) - visible},
        "parts": _most_parts(drawing),
        "accuracy": accuracies(drawing),
        "notes": [note.as_dict() | {"warning": note.is_warning} for note in (*more, *drawing.notes)],
        "seconds": {stage: round(s, 4) for stage, s in ({**drawing.timings} | {"write": writing}).items()},
    }
    # Numbers may be NumPy's.
    found: dict[str, Any] = json.loads(json.dumps(facts, default=lambda value: value.tolist()))
    return found


def _from_root(path: Path, root: str) -> str:
    base = Path(root).resolve()
    return path.relative_to(base).as_posix() if path.is_relative_to(base) else path.as_posix()


def _peak_memory_mb() -> float:
    """The most memory that this process has taken so far; 0: the system does not tell."""
    try:
        import resource
    except ImportError:
        return 0.0
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return round(peak / (1e6 if sys.platform == "darwin" else 1e3), 1)


def _most_parts(drawing: Drawing) -> int:
    """The parts of a drawing; of several views, the most that one of them shows: a section may show fewer."""
    if drawing.sheet is None:
        return len(drawing.parts)
    shown = Counter(part.name.partition("/")[0] for part in drawing.parts)
    return max(shown.values(), default=0)
