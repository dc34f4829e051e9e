"""`hlr.load`: reads a drawing from the exchange format, which `hlr/docs/json.md` describes."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from hlr.drawing.curve import Arc, Bezier, Curve
from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.fill import Fill
from hlr.drawing.line import Bounds, Line
from hlr.drawing.notes import Note
from hlr.drawing.page import Page
from hlr.drawing.section import Section
from hlr.errors import OptionError, SourceError
from hlr.request.effect import Decision
from hlr.request.style import LineRule, Style
from hlr.tables.documents import VERSIONS
from hlr.tables.line_classes import LINE_CLASSES, Kind, names
from hlr.writers.json import FORMAT
from hlr.writers.revive import array, revived

if TYPE_CHECKING:
    from hlr.drawing.reached import Reached


Box = tuple[float, float, float, float]


def load(file: str | os.PathLike[str] | IO[Any]) -> Drawing:
    """The drawing that a JSON file of hlr holds: equal to the one that was saved, but for what was asked for.

    file: a path, or a file object, open for bytes or for text. `request` is None, for the file does not hold it.
    Raises SourceError, in one sentence, for a file that cannot be read or is none of hlr's.

    >>> import hlr
    >>> drawing = hlr.draw("part.step")
    >>> path = drawing.save("part.json")
    >>> hlr.load(path) == drawing
    True
    """
    if hasattr(file, "read"):
        name = str(getattr(file, "name", "") or f"the {type(file).__name__}")
        try:
            return loads(file.read(), name)
        except (OSError, ValueError) as error:
            raise SourceError(f"{name} cannot be read: {error}") from None
    from hlr.source.file_checks import check_readable

    try:
        path = Path(file)
    except TypeError:
        raise SourceError(f"{file!r} cannot be read: give a path or a file object") from None
    check_readable(path)
    try:
        return loads(path.read_bytes(), path.name)
    except OSError as error:
        raise SourceError(f"{path} cannot be read: {error.strerror}") from None


def loads(text: str | bytes, name: str = "the text") -> Drawing:
    """The drawing that the text of a JSON file holds; name: what errors call it. Raises SourceError."""
    try:
        document = json.loads(text)
    except (ValueError, RecursionError):
        raise SourceError(f"{name} is no JSON: save a drawing as .json and load that") from None
    except TypeError:
        raise SourceError(f"{name} is neither text nor bytes, but {type(text).__name__}") from None
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise SourceError(f"{name} is no drawing of hlr: save a drawing as .json and load that")
    version = VERSIONS[FORMAT]
    if document.get("version") != version:
        raise SourceError(
            f"{name} has version {document.get('version')!r} of the format, not {version}: draw the model again"
        )
    try:
        return _drawing(document)
    except KeyError as error:
        raise SourceError(f"{name} is damaged: {error} is missing") from None
    except (TypeError, ValueError) as error:
        raise SourceError(f"{name} is damaged: {error}") from None


def _drawing(document: dict[str, Any]) -> Drawing:
    accuracy: Accuracy = revived(Accuracy, document["accuracy"], "accuracy")
    parts: tuple[DrawnPart, ...] = revived(tuple[DrawnPart, ...], document["parts"], "parts")
    if not isinstance(document["timings"], dict):
        raise ValueError("timings should be an object")
    timings = dict(document["timings"])
    seconds = timings.pop("effects", {})
    found = Drawing(
        source=revived(str, document["source"], "source"),
        view=revived(DrawnView, document["view"], "view"),
        scale=revived(float, document["scale"], "scale"),
        origin=revived(tuple[float, float], document["origin"], "origin"),
        accuracy=accuracy,
        unit=revived(float, document["model"]["unit"], "model.unit"),
        up_axis=revived(tuple[tuple[float, float, float], ...], document["model"]["up_axis"], "model.up_axis"),
        parts=parts,
        lines=tuple(_lines(_objects(document["lines"], "lines"), len(parts))),
        # A later program may know more codes.
        notes=tuple(
            Note(note["code"], revived(str, note["text"], "notes")) for note in _objects(document["notes"], "notes")
        ),
        counters=revived(Mapping[str, int], document["counters"], "counters"),
        timings=revived(Mapping[str, float], timings, "timings"),
        fill=revived(Fill | None, document.get("fill"), "fill"),
        reached=_reached(document["accuracy"].get("reached"), accuracy),
        style=_style(document.get("style", {})),
        group=revived(tuple[float, float] | None, document.get("group"), "group"),
        window=None if document.get("window") is None else Bounds(*revived(Box, document["window"], "window")),
        section=revived(Section | None, document.get("section"), "section"),
        page=revived(Page | None, document.get("page"), "page"),
        plan=tuple(_decision(d, seconds, f"plan[{i}]") for i, d in enumerate(_objects(document["plan"], "plan"))),
    )
    _check(found)
    return found


def _objects(value: Any, what: str) -> list[dict[str, Any]]:
    if not isinstance(value, list) or not all(isinstance(each, dict) for each in value):
        raise ValueError(f"{what} should be a list of objects")
    return value


def _check(drawing: Drawing) -> None:
    """Raise ValueError for numbers that no drawing has."""
    page = () if drawing.page is None else (("page.width", drawing.page.width), ("page.height", drawing.page.height))
    for name, value in (("scale", drawing.scale), ("model.unit", drawing.unit), *page):
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} is {value:g}, not a positive number")
    for name in ("direction", "right", "up"):
        vector = getattr(drawing.view, name)
        if not all(map(math.isfinite, vector)) or not any(vector):
            raise ValueError(f"view.{name} is no direction")
    for i, line in enumerate(drawing.lines):
        if not (np.isfinite(line.points).all() and np.isfinite(line.points3).all()):
            raise ValueError(f"lines[{i}] has coordinates that are no numbers")


def _lines(entries: list[dict[str, Any]], parts: int) -> Iterator[Line]:
    for i, entry in enumerate(entries):
        what = f"lines[{i}]"
        part = revived(int, entry["part"], f"{what}.part")
        other = revived(int | None, entry.get("other"), f"{what}.other")
        for number in (part, *(() if other is None else (other,))):
            if not 0 <= number < parts:
                raise ValueError(f"{what} is of part {number}, and there are {parts}")
        points = array(entry["points"], np.float64, f"{what}.points", 2)
        points3 = array(entry["points3"], np.float64, f"{what}.points3", 3)
        if len(points) != len(points3) or len(points) < 2:
            raise ValueError(f"{what} should have as many points as points3, two or more")
        yield Line(
            kind=_class(entry["class"], f"{what}.class"),
            visible=revived(bool, entry["visible"], f"{what}.visible"),
            part=part,
            edge=revived(int | None, entry["edge"], f"{what}.edge"),
            face=revived(int | None, entry["face"], f"{what}.face"),
            points=points,
            points3=points3,
            other=other,
            curve=None if "curve" not in entry else _curve(entry["curve"], f"{what}.curve"),
        )


def _class(name: Any, what: str) -> Kind:
    row = LINE_CLASSES.get(name) if isinstance(name, str) else None
    if row is None:
        raise ValueError(f"{what} should be one of {', '.join(names())}")
    return row.name


def _curve(entry: dict[str, Any], what: str) -> Curve:
    if entry["type"] == "arc":
        arc: Arc = revived(Arc, entry, what)
        if (arc.centre.shape, arc.axes.shape, arc.angles.shape) != ((2,), (2, 2), (2,)):
            raise ValueError(f"{what} should have a centre, two axes and two angles")
        return arc
    degree, points = entry["degree"], array(entry["points"], np.float64, f"{what}.points", 2)
    if entry["type"] != "bezier" or degree not in (2, 3) or len(points) <= degree or len(points) % degree != 1:
        raise ValueError(f"{what} should be an arc, or a chain of Bezier curves of degree 2 or 3")
    return Bezier(degree, points)


def _style(values: dict[str, Any]) -> Style:
    """The style as it was written, field by field; the records check themselves."""
    try:
        lines = {"lines": tuple(LineRule(**rule) for rule in values["lines"])} if "lines" in values else {}
        return Style(**{**values, **lines})
    except OptionError as error:
        raise ValueError(f"style: {error}") from None


def _reached(entry: dict[str, Any] | None, accuracy: Accuracy) -> Reached | None:
    if entry is None:
        return None
    from hlr.drawing.reached import Reached

    found: Reached = revived(Reached, {**entry, "accuracy": accuracy.used}, "accuracy.reached")
    return found


def _decision(entry: dict[str, Any], seconds: dict[str, float], what: str) -> Decision:
    name = revived(str, entry["effect"], f"{what}.effect")
    found: Decision = revived(Decision, {**entry, "name": name, "seconds": seconds.get(name)}, what)
    return found
