"""The exchange format: all fields of a drawing, as JSON. hlr/docs/json.md describes it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, fields, is_dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.drawing.curve import Arc, Curve
from hlr.drawing.drawing import Drawing, DrawnView
from hlr.drawing.line import Line
from hlr.drawing.section import Section
from hlr.errors import WriteError
from hlr.request.style import Style
from hlr.tables import documents
from hlr.writers.number import NOT_FINITE

FORMAT = "hlr-drawing"


def document(drawing: Drawing) -> bytes:
    """The drawing as JSON, one line of text per part and per line. Raises WriteError where a point is not finite."""
    if drawing.sheet is not None:
        raise WriteError("a page of several views cannot be written as JSON: use svg, pdf, dxf or png")
    head = {
        **documents.head(FORMAT),
        "source": drawing.source,
        "units": "mm",
        "accuracy": accuracies(drawing),
        "view": _view(drawing.view),
        "scale": float(drawing.scale),
        "origin": _numbers(drawing.origin),
        **({} if drawing.window is None else {"window": _numbers(drawing.window)}),
        **({} if drawing.section is None else {"section": _section(drawing.section)}),
        **({} if drawing.page is None else {"page": asdict(drawing.page)}),
        "model": {"unit": float(drawing.unit), "up_axis": _numbers(drawing.up_axis)},
    }
    parts = [{"name": part.name, "color": part.color, "transform": _numbers(part.transform)} for part in drawing.parts]
    tail: dict[str, Any] = {
        "notes": [note.as_dict() for note in drawing.notes],
        "plan": [decision.as_dict() for decision in drawing.plan],
        "counters": dict(drawing.counters),
        "timings": {**drawing.timings, **_effects(drawing)},
    }
    if drawing.group is not None:
        tail = {"group": _numbers(drawing.group), **tail}
    if drawing.style != Style():
        tail = {"style": asdict(drawing.style), **tail}
    if drawing.fill is not None:
        tail = {"fill": _record(drawing.fill), **tail}
    listed = ",\n".join(_dump(part) for part in parts)
    drawn = ",\n".join(_lines(drawing.lines))
    text = f'{_dump(head)[:-1]},\n"parts": [\n{listed}\n],\n"lines": [\n{drawn}\n],\n{_dump(tail)[1:]}\n'
    return text.encode("ascii")


def _effects(drawing: Drawing) -> dict[str, dict[str, float]]:
    """Seconds of single effects. All times are in one place, because only they differ from run to run."""
    timed = {d.name: d.seconds for d in drawing.plan if d.seconds is not None}
    return {"effects": timed} if timed else {}


def accuracies(drawing: Drawing) -> dict[str, Any]:
    """The accuracy, and the measured errors where they were asked for."""
    fields = asdict(drawing.accuracy)
    if drawing.accuracy.within is None:
        del fields["within"]
    return fields if drawing.reached is None else fields | {"reached": drawing.reached.as_dict()}


def _view(view: DrawnView) -> dict[str, Any]:
    fields = {k: v if isinstance(v, str) else _numbers(v) for k, v in asdict(view).items() if v is not None}
    # In perspective, what is unknown is null.
    return fields if view.projection == "orthographic" else dict.fromkeys(asdict(view)) | fields


def _section(section: Section) -> dict[str, Any]:
    fields = asdict(section)
    if not section.corners:
        del fields["corners"]
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


def _record(value: Any) -> Any:
    """A record of arrays, by the names of its fields."""
    if isinstance(value, np.ndarray):
        return _numbers(value) if value.dtype.kind == "f" else value.tolist()
    if is_dataclass(value):
        return {f.name: _record(getattr(value, f.name)) for f in fields(value)}
    return [_record(each) for each in value] if isinstance(value, tuple) else value


def _numbers(values: npt.ArrayLike) -> Any:
    # Adding zero turns -0.0 into 0.0: a sign without meaning would differ between equal drawings.
    return (np.asarray(values, dtype=np.float64) + 0.0).tolist()


def _dump(value: Any, between: str = ", ") -> str:
    try:
        return json.dumps(value, default=_plain, separators=(between, ": "), allow_nan=False)
    except ValueError:
        raise WriteError(NOT_FINITE) from None


def _plain(value: Any) -> Any:
    """Numbers and arrays of NumPy."""
    return value.tolist()
