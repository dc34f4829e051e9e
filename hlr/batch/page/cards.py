"""What the page shows of a batch: a card for each drawing, and one for each source that could not be drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from hashlib import blake2b
from typing import Any
from urllib.parse import quote

from hlr.batch.junit import title
from hlr.drawing.scale import ratio

PICTURES = ("svg", "png")
"""Formats that a browser shows as a picture, the better one first."""


@dataclass(frozen=True, slots=True)
class Card:
    """A drawing, or a source that failed.

    key      letters and digits that only this card has, the same in every run
    source   path of the source, and the parameters of a variant
    view     name of the view, or its direction; empty where the source failed
    state    "drawn", "warned" or "failed"
    change   against the baseline: "unchanged", "changed", "new"; empty without one
    picture  address of a picture; empty where no format is one
    svg      path of the SVG, seen from the folder of outputs; empty where there is none
    seconds  that the drawing took, by the clock
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
    return [card for source in found["sources"] for card in _of_source(source)]


def address(path: str) -> str:
    """The address of a file, seen from the page, by its path from the folder of outputs."""
    return "./" + quote(path.encode("utf-8", "surrogateescape"))


def _of_source(source: dict[str, Any]) -> Iterator[Card]:
    name = title(source)
    if source["error"] is not None:
        yield Card(_key(name), name, "", "failed", source["cost"]["seconds"], error=source["error"]["message"])
    for drawing in source["drawings"]:
        yield _of_drawing(name, drawing)


def _of_drawing(name: str, drawing: dict[str, Any]) -> Card:
    files, change = drawing["files"], drawing.get("change") or {}
    pictures = [files[format] for format in PICTURES if format in files]
    return Card(
        key=_key(next(iter(files.values()))),
        source=name,
        view=str(drawing["view"]),
        state="warned" if any(note["warning"] for note in drawing["notes"]) else "drawn",
        seconds=drawing["seconds"].get("total", 0.0),
        change=change.get("state", ""),
        picture=address(pictures[0]) if pictures else "",
        svg=files.get("svg", ""),
        details={
            "files": [[format, address(path)] for format, path in files.items()],
            "notes": [[note["text"], note["warning"]] for note in drawing["notes"]],
            "seconds": drawing["seconds"],
            "facts": _facts(drawing),
            "change": _change(change),
        },
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
