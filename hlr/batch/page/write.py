"""Write the page of a batch: index.html, and beside it the folder `page` with style, scripts and drawings.

The page is written anew where the report has changed, or the templates. Drawings are handled one after another, for all
together may be too large for the memory; one that is unchanged is not touched.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

from hlr.batch.page import scripts
from hlr.common.web import ASSETS, shared, template
from hlr.drawing import files
from hlr.errors import counted

INDEX, FOLDER = "index.html", "page"

_HOME = Path(__file__).parent

_SCRIPTS = ("start", "theme", "sheet", "unpack", "zoom", "layers", "hover", "facts", "change", "viewer", "keys")
"""Names of the scripts, in the order in which they are loaded."""

_HEAD_BYTES = 2000
"""In which the page says what it is made of."""


def write(found: dict[str, Any], report: bytes, output: Path) -> None:
    """Write what of the page has changed. found: the report; report: its bytes. Raises WriteError."""
    made_of = scripts.stamp(report, *(path.read_bytes() for path in _own_files()))
    if scripts.stamped(_head(output / INDEX, _HEAD_BYTES)) == made_of and (output / FOLDER).is_dir():
        return
    from hlr.batch.page.cards import cards

    shown, page = cards(found), output / FOLDER
    files.write_all({}, [page / "drawings"])
    for card in shown:
        if card.svg:
            _write_drawing(output / card.svg, page / "drawings" / f"{card.key}.js", card.key)
    _remove_others(page / "drawings", (f"{card.key}.js" for card in shown if card.svg))
    contents = {page / path.name: path.read_bytes() for path in _assets()}
    contents[page / "data.js"] = scripts.data([card.data() for card in shown])
    # Last, for it says that all is there.
    contents[output / INDEX] = _html(found, shown, made_of)
    files.write_all(contents)


def _html(found: dict[str, Any], shown: list[Any], made_of: str) -> bytes:
    counts = found["counts"]
    text = template(_HOME / "templates", "index.html").render(
        report=found,
        drawings=counted(counts["drawings"], "drawing"),
        sources=counted(counts["sources"], "source"),
        cards=shown,
        gone=found.get("gone", ()),
        filters=_filters(shown),
        scripts=_SCRIPTS,
        made_of=made_of,
    )
    return text.encode("utf-8", "replace")


def _filters(shown: list[Any]) -> list[tuple[str, str, int]]:
    """(state, what it is called, number of cards) of each filter; for earlier runs and a baseline only where needed."""
    from hlr.batch.page.cards import EARLIER

    rows = [("", "All", len(shown))]
    rows += [(state, state.title(), sum(card.state == state for card in shown)) for state in ("failed", "warned")]
    for state in EARLIER.values():
        if count := sum(card.state == state for card in shown):
            rows.append((state, state.title(), count))
    if any(card.change for card in shown):
        rows += [(state, state.title(), sum(card.change == state for card in shown)) for state in ("changed", "new")]
    return rows


def _write_drawing(svg: Path, script: Path, key: str) -> None:
    """Write the script of a drawing; nothing where the drawing itself is gone."""
    with suppress(OSError):
        content = svg.read_bytes()
        if not scripts.is_of(_head(script, scripts.HEAD_BYTES), content):
            files.write_all({script: scripts.drawing(key, content)})


def _remove_others(folder: Path, names: Iterable[str]) -> None:
    """Remove scripts of drawings that the batch no longer has."""
    wanted = set(names)
    for path in folder.glob("*.js"):
        if path.name not in wanted:
            with suppress(OSError):
                path.unlink()


def _own_files() -> list[Path]:
    """What the page is made of besides the report: templates, style and scripts."""
    return [*sorted((_HOME / "templates").iterdir()), *sorted(ASSETS.glob("*.html")), *_assets()]


def _assets() -> list[Path]:
    return [*sorted((_HOME / "assets").iterdir()), *shared()]


def _head(path: Path, size: int) -> bytes:
    """The first bytes of a file; none where it cannot be read."""
    with suppress(OSError), path.open("rb") as file:
        return file.read(size)
    return b""
