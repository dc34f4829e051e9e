"""Pages of a FreeCAD document on the command line: `--page NAME` and `--all-pages` of `hlr draw`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from hlr.errors import OptionError
from hlr.tables.sheets import papers

from .drawn_files import targets_of, write
from .guard import start
from .meter import meter
from .streams import result_only
from .telling import summary, tell_notes, tell_written, written

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from hlr.drawing.drawing import Drawing
    from hlr.drawing.notes import Note
    from hlr.request.options import Options

    from .drawn_files import Targets


def names_a_page(source: str, page: str | None) -> bool:
    """Whether `--page` names a page of the document, and no sheet of paper."""
    if page is None or Path(source).suffix.lower() != ".fcstd":
        return False
    try:
        papers(page)
    except ValueError:
        return True
    return False


def draw_document_pages(
    source: str,
    outputs: Sequence[str],
    page: str | None,
    format: str | None,
    request: Options,
    told: Mapping[str, Any],
) -> None:
    """Draw one page of a document, or all, into files. page: None for all; told: as_json, quiet and time_limit.

    Raises OptionError where other options contradict the page; else as `hlr.draw_pages`.
    """
    if page is None and Path(source).suffix.lower() != ".fcstd":
        name = Path(source).name
        raise OptionError(f"only FreeCAD documents (.FCStd) have pages, and {name} is none: leave --all-pages out")
    # What cannot be a name of files is refused before the document is read for the names of all its pages.
    targets = targets_of(outputs, source, ["page" if page is None else page], format, told["as_json"])
    start(source, told["time_limit"])
    with result_only() as out:
        with meter(told["quiet"]) as progress:
            import hlr
            from hlr.public.pages import page_names

            if page is None:
                targets = targets_of(outputs, source, _distinct(page_names(source)), format, told["as_json"])
            drawings = hlr.draw_pages(source, None if page is None else [page], request, progress)
        notes = [*left_out_of(drawings, targets), *(note for drawing in drawings for note in drawing.notes)]
        tell_notes(notes, request.strict, told["quiet"])
        drawings = write(drawings, targets, out.put)
        if told["as_json"]:
            out.put(summary(drawings, targets))
    for drawing, row in zip(drawings, targets, strict=True):
        tell_written(written(drawing, row), told["quiet"])


def left_out_of(drawings: Sequence[Drawing], targets: Targets) -> list[Note]:
    """Notes on what is on the pages, but not in some of their files."""
    from hlr.writers.left_out import left_out

    return [
        note
        for drawing, row in zip(drawings, targets, strict=True)
        for target in row
        for note in left_out(drawing, target.format, str(target))
    ]


def _distinct(pages: list[tuple[str, str]]) -> list[str]:
    """The labels of pages, for the names of files; where two are the same but for large letters, their names."""
    labels = [label.casefold() for _, label in pages]
    return [name if labels.count(label.casefold()) > 1 else label for name, label in pages]
