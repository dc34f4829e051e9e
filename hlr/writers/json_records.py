"""The records that JSON documents of drawings and of pages share: parts, lines, accuracy, and what ends a document."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, fields, is_dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.drawing.curve import Arc, Curve
from hlr.drawing.drawing import Drawing, DrawnPart
from hlr.drawing.line import Line
from hlr.errors import WriteError
from hlr.request.style import Style
from hlr.writers.number import NOT_FINITE


def accuracies(drawing: Drawing) -> dict[str, Any]:
    """The accuracy, and the measured errors where they were asked for."""
    fields = asdict(drawing.accuracy)
    if drawing.accuracy.within is None:
        del fields["within"]
    return fields if drawing.reached is None else fields | {"reached": drawing.reached.as_dict()}


def model_record(drawing: Drawing) -> dict[str, Any]:
    """The unit of the model, and how it stands."""
    return {"unit": float(drawing.unit), "up_axis": numbers(drawing.up_axis)}


def ending(drawing: Drawing) -> dict[str, Any]:
    """The last keys of a document: how the drawing looks, notes, figures and times."""
    return {
        **({} if drawing.style == Style() else {"style": asdict(drawing.style)}),
        **({} if drawing.group is None else {"group": numbers(drawing.group)}),
        "notes": [note.as_dict() for note in drawing.notes],
        "plan": [decision.as_dict() for decision in drawing.plan],
        "counters": dict(drawing.counters),
        "timings": {**drawing.timings, **_effects(drawing)},
    }


def _effects(drawing: Drawing) -> dict[str, dict[str, float]]:
    """Seconds of single effects. All times are in one place, because only they differ from run to run."""
    timed = {d.name: d.seconds for d in drawing.plan if d.seconds is not None}
    return {"effects": timed} if timed else {}


def listed(parts: Sequence[DrawnPart], lines: Sequence[Line]) -> str:
    """Parts and lines as the last two keys of an object, one line of text for each."""
    named = ",\n".join(dumped(_part(part)) for part in parts)
    drawn = ",\n".join(_lines(lines))
    return f'"parts": [\n{named}\n],\n"lines": [\n{drawn}\n]'


def _part(part: DrawnPart) -> dict[str, Any]:
    above = {"above": part.above} if part.above else {}
    return {"name": part.name, "color": part.color, "transform": numbers(part.transform), **above}


def _lines(lines: Sequence[Line]) -> Iterator[str]:
    """Each line as JSON."""
    for line in lines:
        fields: dict[str, Any] = {
            "class": line.kind,
            "visible": bool(line.visible),
            "part": line.part,
            "edge": line.edge,
            "face": line.face,
        }
        if line.other is not None:
            fields["other"] = line.other
        fields |= {"points": numbers(line.points), "points3": numbers(line.points3)}
        if line.curve is not None:
            fields["curve"] = _curve(line.curve)
        yield dumped(fields, ",")


def _curve(curve: Curve) -> dict[str, Any]:
    if isinstance(curve, Arc):
        vectors = {name: numbers(getattr(curve, name)) for name in ("centre", "axes", "angles")}
        return {"type": "arc", **vectors}
    return {"type": "bezier", "degree": curve.degree, "points": numbers(curve.points)}


def record(value: Any) -> Any:
    """A record of arrays, by the names of its fields."""
    if isinstance(value, np.ndarray):
        return numbers(value) if value.dtype.kind == "f" else value.tolist()
    if is_dataclass(value):
        return {f.name: record(getattr(value, f.name)) for f in fields(value)}
    return [record(each) for each in value] if isinstance(value, tuple) else value


def numbers(values: npt.ArrayLike) -> Any:
    """An array as nested lists."""
    # Adding zero turns -0.0 into 0.0: a sign without meaning would differ between equal drawings.
    return (np.asarray(values, dtype=np.float64) + 0.0).tolist()


def dumped(value: Any, between: str = ", ") -> str:
    """A value as JSON, in one line of text. Raises WriteError where a number is not finite."""
    try:
        return json.dumps(value, default=_plain, separators=(between, ": "), allow_nan=False)
    except ValueError:
        raise WriteError(NOT_FINITE) from None


def _plain(value: Any) -> Any:
    """Numbers and arrays of NumPy."""
    return value.tolist()
