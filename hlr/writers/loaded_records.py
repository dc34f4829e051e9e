"""Records that documents of drawings and of pages share, out of their JSON: parts, lines, accuracy, style and notes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from hlr.drawing.curve import Arc, Bezier, Curve
from hlr.drawing.drawing import Accuracy
from hlr.drawing.line import Line
from hlr.drawing.notes import Note
from hlr.drawing.page import Page
from hlr.errors import OptionError, respelled
from hlr.request.effect import Decision
from hlr.request.style import LineRule, Style
from hlr.tables.line_classes import LINE_CLASSES, Kind, names
from hlr.writers.revive import array, revived

if TYPE_CHECKING:
    from hlr.drawing.reached import Reached


def common(document: dict[str, Any]) -> dict[str, Any]:
    """The fields of a drawing that both kinds of documents have, by their names. Raises KeyError, ValueError."""
    accuracy: Accuracy = revived(Accuracy, document["accuracy"], "accuracy")
    if not isinstance(document["timings"], dict):
        raise ValueError("timings should be an object")
    model = document["model"]
    if not isinstance(model, dict):
        raise ValueError("model should be an object")
    timings = dict(document["timings"])
    seconds = timings.pop("effects", {})
    found: dict[str, Any] = {
        "source": revived(str, document["source"], "source"),
        "scale": positive(document["scale"], "scale"),
        "accuracy": accuracy,
        "unit": positive(model["unit"], "model.unit"),
        "up_axis": revived(tuple[tuple[float, float, float], ...], model["up_axis"], "model.up_axis"),
        # A later program may know more codes.
        "notes": tuple(
            Note(note["code"], revived(str, note["text"], "notes")) for note in objects(document["notes"], "notes")
        ),
        "counters": revived(Mapping[str, int], document["counters"], "counters"),
        "timings": revived(Mapping[str, float], timings, "timings"),
        "reached": _reached(document["accuracy"].get("reached"), accuracy),
        "style": _style(document.get("style", {})),
        "group": revived(tuple[float, float] | None, document.get("group"), "group"),
        "plan": tuple(_decision(d, seconds, f"plan[{i}]") for i, d in enumerate(objects(document["plan"], "plan"))),
    }
    return found


def direction(value: Any, what: str) -> Any:
    """Raise ValueError for a vector that is no direction; returns it."""
    if not all(map(math.isfinite, value)) or not any(value):
        raise ValueError(f"{what} is no direction")
    return value


def page_of(value: Any) -> Page:
    """The page of a drawing."""
    page: Page = revived(Page, value, "page")
    for name in ("width", "height"):
        positive(getattr(page, name), f"page.{name}")
    return page


def positive(value: Any, what: str) -> float:
    """A number; raises ValueError where it is none above zero."""
    number: float = revived(float, value, what)
    if not (math.isfinite(number) and number > 0.0):
        raise ValueError(f"{what} is {number:g}, not a positive number")
    return number


def objects(value: Any, what: str) -> list[dict[str, Any]]:
    """A list of objects; raises ValueError for anything else."""
    if not isinstance(value, list) or not all(isinstance(each, dict) for each in value):
        raise ValueError(f"{what} should be a list of objects")
    return value


def lines_of(value: Any, parts: int, where: str = "") -> Iterator[Line]:
    """Lines of so many parts. where: of which object they are, with a dot, for errors. Raises KeyError, ValueError."""
    for i, entry in enumerate(objects(value, f"{where}lines")):
        what = f"{where}lines[{i}]"
        part = revived(int, entry["part"], f"{what}.part")
        other = revived(int | None, entry.get("other"), f"{what}.other")
        for number in (part, *(() if other is None else (other,))):
            if not 0 <= number < parts:
                raise ValueError(f"{what} is of part {number}, and there are {parts}")
        points = array(entry["points"], np.float64, f"{what}.points", 2)
        points3 = array(entry["points3"], np.float64, f"{what}.points3", 3)
        if len(points) != len(points3) or len(points) < 2:
            raise ValueError(f"{what} should have as many points as points3, two or more")
        if not (np.isfinite(points).all() and np.isfinite(points3).all()):
            raise ValueError(f"{what} has coordinates that are no numbers")
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


def _style(values: Any) -> Style:
    """The style as it was written, field by field; the records check themselves."""
    if not isinstance(values, dict):
        raise ValueError("style should be an object")
    try:
        lines = {"lines": tuple(LineRule(**rule) for rule in values["lines"])} if "lines" in values else {}
        return Style(**{**values, **lines})
    except OptionError as error:
        raise ValueError(f"style: {respelled(str(error), str)}") from None


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
