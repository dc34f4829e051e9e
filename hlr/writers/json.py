"""The exchange format: everything the drawing knows, for other programs. JSON.md beside this file describes it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.curve import Arc
from hlr.drawing import Drawing, Line
from hlr.tolerance import DIGITS_IN_JSON
from hlr.writers.number import decimals, encode, grid

FORMAT = "hlr-drawing"
VERSION = 2


def document(drawing: Drawing) -> bytes:
    """The drawing as JSON, one line of text per part and per line. Raises WriteError where a point is not finite."""
    head = {
        "format": FORMAT,
        "version": VERSION,
        "source": drawing.source,
        "units": "mm",
        "accuracy": dict(drawing.accuracy),
        "view": _view(drawing),
        "scale": drawing.scale,
        "origin": [x + 0.0 for x in drawing.origin],
        "model": {"unit": drawing.unit, "up_axis": _matrix(np.asarray(drawing.up_axis))},
    }
    parts = [{"name": part.name, "color": part.color, "transform": _matrix(part.transform)} for part in drawing.parts]
    tail = {
        "notes": [note.as_dict() for note in drawing.notes],
        "plan": [decision.as_dict() for decision in drawing.plan],
        "counters": dict(drawing.counters),
        "timings": {**drawing.timings, **_effects(drawing)},
    }
    listed = ",\n".join(_dump(part) for part in parts)
    drawn = ",\n".join(_lines(drawing))
    text = f'{_dump(head)[:-1]},\n"parts": [\n{listed}\n],\n"lines": [\n{drawn}\n],\n{_dump(tail)[1:]}\n'
    return text.encode("ascii")


def _effects(drawing: Drawing) -> dict[str, dict[str, float]]:
    """What the steps of single effects took; all times are in one place, for they alone differ from run to run."""
    timed = {d.name: d.seconds for d in drawing.plan if d.seconds is not None}
    return {"effects": timed} if timed else {}


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


def _lines(drawing: Drawing) -> list[str]:
    lines = drawing.lines
    if not lines:
        return []
    accuracy = float(drawing.accuracy["used"])
    counts = np.array([len(line.points) for line in lines], dtype=np.int64)
    paper, paper_at = _nested(np.concatenate([line.points for line in lines]), counts, accuracy)
    in_model = accuracy / (drawing.scale * drawing.unit)
    space, space_at = _nested(np.concatenate([line.points3 for line in lines]), counts, in_model)
    curves = _curves(lines, accuracy)
    out = []
    for i, line in enumerate(lines):
        edge = "null" if line.edge is None else line.edge
        face = "null" if line.face is None else line.face
        other = "" if line.other is None else f'"other": {line.other}, '
        out.append(
            f'{{"class": "{line.kind}", "visible": {"true" if line.visible else "false"}, "part": {line.part}, '
            f'"edge": {edge}, "face": {face}, {other}"points": [{paper[paper_at[i] : paper_at[i + 1]]}]], '
            f'"points3": [{space[space_at[i] : space_at[i + 1]]}]]{curves.get(i, "")}}}'
        )
    return out


def _curves(lines: Sequence[Line], accuracy: float) -> dict[int, str]:
    """The field `curve` of lines that have one, by line, with the comma before it."""
    curved = [(i, line.curve) for i, line in enumerate(lines) if line.curve is not None]
    if not curved:
        return {}
    vectors = [np.vstack([c.centre, c.axes]) if isinstance(c, Arc) else c.points for _, c in curved]
    counts = np.array([len(v) for v in vectors], dtype=np.int64)
    text, at = _nested(np.concatenate(vectors), counts, accuracy)
    out = {}
    for k, (i, curve) in enumerate(curved):
        points = text[at[k] : at[k + 1]]
        if isinstance(curve, Arc):
            centre, axes = points.split("],", 1)
            # An angle moves a point by so much more as the radius is larger.
            places = decimals(accuracy / max(1.0, curve.radii[0]), share=DIGITS_IN_JSON)
            angles = ", ".join(f"{angle + 0.0:.{places}f}" for angle in curve.angles.tolist())
            out[i] = f', "curve": {{"type": "arc", "centre": {centre}], "axes": [{axes}]], "angles": [{angles}]}}'
        else:
            out[i] = f', "curve": {{"type": "bezier", "degree": {curve.degree}, "points": [{points}]]}}'
    return out


def _nested(points: npt.NDArray[np.float64], counts: npt.NDArray[np.int64], accuracy: float) -> tuple[str, list[int]]:
    """Points (n, k) of many lines as "[x,y],[x,y", and where each line starts in that text (lines + 1 offsets)."""
    n, k = points.shape
    places = decimals(accuracy, float(np.abs(points).max(initial=0.0)), DIGITS_IN_JSON)
    first = np.cumsum(counts) - counts
    before = np.zeros((n, k, 3), np.uint8)
    before[:, 0] = np.frombuffer(b"],[", np.uint8)
    before[first, 0] = np.frombuffer(b"[\0\0", np.uint8)
    before[:, 1:, 0] = ord(",")
    text, ends = encode(grid(points, places).reshape(-1), places, before.reshape(n * k, 3), leading=True)
    return text.decode("ascii"), ends[np.append(first, n) * k].tolist()


def _matrix(values: npt.NDArray[np.float64]) -> list[list[float]]:
    # Adding zero turns -0.0 into 0.0: a sign without meaning would differ between equal drawings.
    rows: list[list[float]] = (np.asarray(values, dtype=np.float64) + 0.0).tolist()
    return rows


def _dump(value: Any) -> str:
    return json.dumps(value, default=_plain, separators=(", ", ": "))


def _plain(value: Any) -> Any:
    """Numbers and arrays of NumPy."""
    return value.tolist()
