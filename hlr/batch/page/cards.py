"""What the page shows of a batch: a card for each drawing, and one for each source that could not be drawn.

After them come the drawings of earlier runs that are still there, of which only files and sources are known.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from hashlib import blake2b
from pathlib import PurePosixPath
from typing import Any
from urllib.parse import quote

from hlr.batch.junit import title
from hlr.drawing.scale import ratio

EARLIER = {"others": "earlier", "stale": "stale"}
"""Where a report lists drawings of earlier runs, and the state of their cards."""

PICTURES = ("svg", "png")
"""Formats that a browser shows as a picture, the better one first."""


@dataclass(frozen=True, slots=True)
class Card:
    """A drawing, or a source that failed.

    key      letters and digits that only this card has, the same in every run
    source   path of the source, and the parameters of a variant
    view     name of the view, or its direction; of an earlier run the name of the file; empty where the source failed
    state    "drawn", "warned" or "failed"; of an earlier run "stale" where the batch draws it no more, else "earlier"
    change   against the baseline: "unchanged", "changed", "new"; empty without one
    picture  address of a picture; empty where no format is one
    svg      path of the SVG, seen from the folder of outputs; empty where there is none
    seconds  that the drawing took, by the clock; 0: nobody knows, as of an earlier run
    error    why there is no drawing
    details  what the viewer shows besides
    """

    key: str
    source: str
    view: str
    state: str
    seconds: float
    change: str = ""
    picture: str = ""
    svg: str = ""
    error: str = ""
    details: dict[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """What the card is called."""
        return f"{self.source}, {self.view}" if self.view else self.source

    @property
    def is_earlier(self) -> bool:
        """Whether an earlier run has drawn it."""
        return self.state in EARLIER.values()

    def data(self) -> dict[str, Any]:
        """What the script of the page knows of it."""
        return {
            "key": self.key,
            "name": self.name,
            "state": self.state,
            "picture": self.picture,
            "svg": bool(self.svg),
            "error": self.error,
            **self.details,
        }


def cards(found: dict[str, Any]) -> list[Card]:
    """The cards, in the order of the manifest. found: the report, as `manifest.json` has it."""
    own = [card for source in found["sources"] for card in _of_source(source)]
    return [*own, *(card for key, state in EARLIER.items() for card in _of_earlier(found.get(key, ()), state))]


def address(path: str) -> str:
    """The address of a file, seen from the page, by its path from the folder of outputs."""
    return "./" + quote(path.encode("utf-8", "surrogateescape"))


def _of_source(source: dict[str, Any]) -> Iterator[Card]:
    name = title(source)
    if source["error"] is not None:
        seconds = source.get("cost", {}).get("seconds", 0.0)
        yield Card(_key(name), name, "", "failed", seconds, error=source["error"]["message"])
    for drawing in source["drawings"]:
        yield _of_drawing(name, drawing)


def _of_earlier(rows: Sequence[dict[str, str]], state: str) -> Iterator[Card]:
    """A card for each drawing of earlier runs, whatever its formats. rows: a file and its source each."""
    drawings: dict[tuple[str, str], dict[str, str]] = {}
    for row in rows:
        path = PurePosixPath(row["file"])
        drawings.setdefault((row["source"], str(path.with_suffix(""))), {})[path.suffix[1:].lower()] = row["file"]
    for (source, name), files in drawings.items():
        pictures_first = {format: files[format] for format in (*PICTURES, *files) if format in files}
        yield _card(pictures_first, source, PurePosixPath(name).name, state)


def _of_drawing(name: str, drawing: dict[str, Any]) -> Card:
    change, seconds = drawing.get("change") or {}, drawing.get("seconds", {})
    state = "warned" if any(note["warning"] for note in drawing["notes"]) else "drawn"
    card = _card(drawing["files"], name, str(drawing["view"]), state)
    return replace(
        card,
        seconds=seconds.get("total", 0.0),
        change=change.get("state", ""),
        details={
            **card.details,
            "notes": [[note["text"], note["warning"]] for note in drawing["notes"]],
            "seconds": seconds,
            "facts": _facts(drawing),
            "change": _change(change),
        },
    )


def _card(files: dict[str, str], source: str, view: str, state: str) -> Card:
    """The card of a drawing with these files, by format, without what only its own run knows."""
    pictures = [files[format] for format in PICTURES if format in files]
    return Card(
        key=_key(next(iter(files.values()))),
        source=source,
        view=view,
        state=state,
        seconds=0.0,
        picture=address(pictures[0]) if pictures else "",
        svg=files.get("svg", ""),
        details={"files": [[format, address(path)] for format, path in files.items()]},
    )


def _facts(drawing: dict[str, Any]) -> list[list[str]]:
    """What is told of a drawing: pairs of a word and a value."""
    facts = []
    if "scale" in drawing:
        facts.append(["Scale", ratio(drawing["scale"])])
    if "width_mm" in drawing:
        facts.append(["Size", f"{drawing['width_mm']:.1f} × {drawing['height_mm']:.1f} mm"])
    if "lines" in drawing:
        facts.append(["Lines", f"{drawing['lines']['visible']} visible, {drawing['lines']['hidden']} hidden"])
    if "parts" in drawing:
        facts.append(["Parts", str(drawing["parts"])])
    if "accuracy" in drawing:
        facts.append(["Accuracy", f"{drawing['accuracy']['used']:g} mm"])
    return facts


def _change(change: dict[str, Any]) -> dict[str, str] | None:
    """What the viewer shows of a change."""
    if not change:
        return None
    paths = {name: change[name] for name in ("before", "overlay") if name in change}
    pictures: dict[str, str] = {
        name: address(path) for name, path in paths.items() if path.rpartition(".")[2] in PICTURES
    }
    return {"state": change["state"], "summary": change.get("summary", ""), **pictures}


def _key(name: str) -> str:
    return blake2b(name.encode("utf-8", "surrogatepass"), digest_size=8).hexdigest()
