"""The view that a drawing of ours states: a model beside it is drawn so."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from hlr.compare.lines.sketch import StatedView
from hlr.drawing.drawing import DrawnView
from hlr.drawing.section import Section
from hlr.request.options import Options, Perspective, Vector, View
from hlr.source.model import Frame


def stated_by(view: DrawnView, section: Section | None = None) -> StatedView:
    """Of a drawing in memory."""
    cut = None if section is None else section.point
    return StatedView(view.name, view.direction, view.up, view.eye, view.target, cut)


def stated_in(name: str | None, fields: Mapping[str, str]) -> StatedView | None:
    """Of a file: its vectors as texts. None where it does not say them. Raises ValueError where they are no vectors."""
    if name is None or "direction" not in fields or "up" not in fields:
        return None
    eye, target, section = (_vector(fields[key]) if key in fields else None for key in ("eye", "target", "section"))
    direction, up = (_vector(fields[key]) for key in ("direction", "up"))
    if not any(direction) or not any(up):
        raise ValueError("a direction is zero")
    return StatedView(name, direction, up, eye, target, section)


def _vector(text: str) -> Vector:
    x, y, z = map(float, text.split())
    if not all(map(math.isfinite, (x, y, z))):
        raise ValueError(f"{text} is no vector")
    return (x, y, z)


def as_stated(stated: StatedView, frame: Frame, options: Options) -> tuple[View, Options]:
    """The view of a model in this frame, and the options with what the view does not say."""
    up, direction = _to_world(stated.up, frame), _to_world(stated.direction, frame)
    if stated.eye is not None:
        target = None if stated.target is None else _millimetres(stated.target, frame)
        camera = Perspective(eye=_millimetres(stated.eye, frame), target=target)
        return direction, replace(options, up=up, perspective=camera)
    section = None if stated.section is None else _millimetres(stated.section, frame)
    return direction, replace(options, up=up, section=section)


def _millimetres(point: Vector, frame: Frame) -> Vector:
    x, y, z = (frame.unit * c for c in _to_world(point, frame))
    return (x, y, z)


def _to_world(v: Vector, frame: Frame) -> Vector:
    """Model axes to world axes (z up)."""
    x, y, z = (sum(row[k] * v[k] for k in range(3)) for row in frame.up)
    return (x, y, z)
