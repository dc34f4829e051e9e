"""Where drawings go: every view to every output, all of them in one pass."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from hlr.errors import OptionError

from .outputs import STDOUT, Target, check, is_folder, place, plan

if TYPE_CHECKING:
    from hlr.drawing.drawing import Drawing

Targets = list[list[Target]]
"""For each view, the files that its drawing is written to."""


def targets_of(
    outputs: Sequence[str],
    source: str,
    names: Sequence[str],
    format: str | None,
    as_json: bool,
) -> Targets:
    """Where the drawing of each view is written. What cannot be written is refused before any work.

    outputs: file names, patterns, folders, or "-" for standard output.

    Raises OptionError, WriteError, SourceError.
    """
    if STDOUT in outputs:
        if len(names) > 1:
            raise OptionError("standard output takes one view; write several views to files with {view} in the name")
        if as_json:
            raise OptionError("--json and -o - both want standard output; write the drawing to a file")
        if list(outputs).count(STDOUT) > 1:
            raise OptionError("-o - is given twice; standard output takes one drawing")
    columns = [_column(output, source, names, format) for output in (outputs or (None,))]
    targets = [target for column in columns for target in column]
    _check_format(format, outputs, targets)
    check(targets)
    return [list(row) for row in zip(*columns, strict=True)]


def write(drawings: Sequence[Drawing], targets: Targets, put: Callable[[bytes], None]) -> list[Drawing]:
    """Write all files or none. Returns the drawings with the time of writing among their timings."""
    from hlr.drawing.drawing import timed
    from hlr.drawing.saving import render

    made, done = [], []
    for drawing, row in zip(drawings, targets, strict=True):
        begin = time.perf_counter()
        for target in row:
            data = render(drawing, target.format)
            if target.path is None:
                put(data)
            else:
                made.append((target, data))
        done.append(timed(drawing, time.perf_counter() - begin))
    place(made)
    return done


def formats_of(outputs: Sequence[str], format: str | None) -> list[str]:
    """The formats that are written, each once. outputs, format: as of `targets_of`, which has accepted them."""
    named = (Path(output) for output in outputs if output != STDOUT and not is_folder(output))
    formats = [_format(path, format) for path in named]
    return list(dict.fromkeys(formats if len(formats) == len(outputs) > 0 else (*formats, format or "svg")))


def to_stdout(targets: Targets) -> bool:
    """Whether a drawing goes to standard output."""
    return any(target.path is None for row in targets for target in row)


def _column(output: str | None, source: str, names: Sequence[str], format: str | None) -> list[Target]:
    """One output for every view."""
    if output == STDOUT:
        return [Target(None, format or "svg")]
    paths = plan(output, source, names, format or "svg")
    if output is not None and is_folder(output):
        return [Target(path, format or "svg", path.parent) for path in paths]
    return [Target(path, _format(path, format)) for path in paths]


def _format(path: Path, format: str | None) -> str:
    """The format that the file name says, else the option. Raises WriteError where neither says one."""
    from hlr.drawing.saving import format_of
    from hlr.tables.writers import WRITERS

    known = path.suffix.lower().removeprefix(".") in WRITERS
    return format_of(path) if known or format is None else format


def _check_format(format: str | None, outputs: Sequence[str], targets: Sequence[Target]) -> None:
    """Raises OptionError where the option contradicts the names of all outputs."""
    if format is not None and not any(target.format == format for target in targets):
        raise OptionError(f"--format {format} and the name {outputs[0]} contradict one another; leave out one of them")
