"""The exchange format: everything the drawing knows, for other programs. JSON.md beside this file describes it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.curve import Arc, Curve
from hlr.drawing import Drawing, Line
from hlr.errors import WriteError
from hlr.writers.number import NOT_FINITE

FORMAT = "hlr-drawing"
VERSION = 2


def document(drawing: Drawing) -> bytes:
    """The drawing as JSON, one line of text per part and per line. Raises WriteError where a point is not finite."""
    head = {
        "format": FORMAT,
        "version": VERSION,
        "source": drawing.source,
        "units": "mm",
        "accuracy": accuracies(drawing),
        "view": _view(drawing),
        "scale": drawing.scale,
        "origin": [x + 0.0 for x in drawing.origin],
        "model": {"unit": drawing.unit, "up_axis": _numbers(drawing.up_axis)},
    }
    parts = [{"name": part.name, "color": part.color, "transform": _numbers(part.transform)} for part in drawing.parts]
    tail = {
        "notes": [note.as_dict() for note in drawing.notes],
        "plan": [decision.as_dict() for decision in drawing.plan],
        "counters": dict(drawing.counters),
        "timings": {**drawing.timings, **_effects(drawing)},
    }
    listed = ",\n".join(_dump(part) for part in parts)
    drawn = ",\n".join(_lines(drawing.lines))
    text = f'{_dump(head)[:-1]},\n"parts": [\n{listed}\n],\n"lines": [\n{drawn}\n],\n{_dump(tail)[1:]}\n'
    return text.encode("ascii")


def _effects(drawing: Drawing) -> dict[str, dict[str, float]]:
    """What the steps of single effects took; all times are in one place, for they alone differ from run to run."""
    timed = {d.name: d.seconds for d in drawing.plan if d.seconds is not None}
    return {"effects": timed} if timed else {}


def accuracies(drawing: Drawing) -> dict[str, Any]:
    """The accuracy, and what was reached where it was measured."""
    fields = asdict(drawing.accuracy)
    if drawing.accuracy.within is None:
        del fields["within"]
    return fields if drawing.reached is None else fields | {"reached": drawing.reached.as_dict()}


def _view(drawing: Drawing) -> dict[str, Any]:
    view = drawing.view
    fields: dict[str, Any] = {
        "name": view.name,
        "projection": view.projection,
        "direction": [x + 0.0 for x in view.direction],
        "right": [x + 0.0 for x in view.right],
        "up": [x + 0.0 for x in view.up],
    }
    if view.projection == "perspective":
        fields |= {"eye": view.eye, "target": view.target, "fov": view.fov, "distance": view.distance}
    return fields


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
        fields |= {"points": _numbers(line.points), "points3": _numbers(line.points3)}
        if line.curve is not None:
            fields["curve"] = _curve(line.curve)
        yield _dump(fields, ",")


def _curve(curve: Curve) -> dict[str, Any]:
    if isinstance(curve, Arc):
        vectors = {name: _numbers(getattr(curve, name)) for name in ("centre", "axes", "angles")}
        return {"type": "arc", **vectors}
    return {"type": "bezier", "degree": curve.degree, "points": _numbers(curve.points)}


def _numbers(values: npt.ArrayLike) -> list[Any]:
    # Adding zero turns -0.0 into 0.0: a sign without meaning would differ between equal drawings.
    rows: list[Any] = (np.asarray(values, dtype=np.float64) + 0.0).tolist()
    return rows


def _dump(value: Any, between: str = ", ") -> str:
    try:
        return json.dumps(value, default=_plain, separators=(between, ": "), allow_nan=False)
    except ValueError:
        raise WriteError(NOT_FINITE) from None


def _plain(value: Any) -> Any:
    """Numbers and arrays of NumPy."""
    return value.tolist()
