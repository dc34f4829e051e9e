"""Several views on one page on the command line: `--arrange` of `hlr draw`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .drawn_files import targets_of, write
from .guard import start
from .meter import meter
from .streams import result_only
from .telling import summary, tell_notes, tell_written, written

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from hlr.public.arranged import Method
    from hlr.request.options import Options, View


def draw_arranged_page(
    source: str,
    outputs: Sequence[str],
    method: Method,
    views: Sequence[View],
    format: str | None,
    request: Options,
    told: Mapping[str, Any],
) -> None:
    """Draw views on one page into files. views: none for the usual ones; told: as_json, quiet and
    time_limit.

    Raises OptionError where other options contradict the page; else as `hlr.draw_arranged`.
    """
    targets = targets_of(outputs, source, [method], format, told["as_json"])
    start(source, told["time_limit"])
    with result_only() as out:
        with meter(told["quiet"]) as progress:
            import hlr

            drawing = hlr.draw_arranged(source, method, list(views) or None, request, progress)
        tell_notes(drawing.notes, request.strict, told["quiet"])
        (drawing,) = write([drawing], targets, out.put)
        if told["as_json"]:
            out.put(summary([drawing], targets))
    tell_written(written(drawing, targets[0]), told["quiet"])
