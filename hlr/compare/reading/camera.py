"""How a drawing of ours says that its model was seen: a model beside it is drawn so."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from hlr.compare.lines.sketch import Seen
from hlr.drawing.drawing import DrawnView
from hlr.request.options import Options, Perspective, Vector, View
from hlr.source.model import Frame


def seen(view: DrawnView) -> Seen:
    """Of a drawing in memory."""
    return Seen(view.name, view.direction, view.up, view.eye, view.target)


def seen_in(name: str | None, fields: Mapping[str, str]) -> Seen | None:
    """Of a file: its vectors as texts. None where it does not say them. Raises ValueError where they are no vectors."""
    if name is None or "direction" not in fields or "up" not in fields:
        return None
    eye, target = (_vector(fields[key]) if key in fields else None for key in ("eye", "target"))
    return Seen(name, _vector(fields["direction"]), _vector(fields["up"]), eye, target)


def _vector(text: str) -> Vector:
    x, y, z = map(float, text.split())
    if not all(map(math.isfinite, (x, y, z))) or not any((x, y, z)):
        raise ValueError(f"{text} is no direction and no place")
    return (x, y, z)


def as_seen(how: Seen, frame: Frame, options: Options) -> tuple[View, Options]:
    """The view of a model in this frame, and the options with what the view does not say."""
    up, direction = _to_world(how.up, frame), _to_world(how.direction, frame)
    if how.eye is not None:
        target = None if how.target is None else _millimetres(how.target, frame)
        camera = Perspective(eye=_millimetres(how.eye, frame), target=target)
        return direction, replace(options, up=up, perspective=camera)
    return direction, replace(options, up=up)


def _millimetres(point: Vector, frame: Frame) -> Vector:
    x, y, z = (frame.unit * c for c in _to_world(point, frame))
    return (x, y, z)


def _to_world(v: Vector, frame: Frame) -> Vector:
    """Model axes to world axes (z up)."""
    x, y, z = (sum(row[k] * v[k] for k in range(3)) for row in frame.up)
    return (x, y, z)
