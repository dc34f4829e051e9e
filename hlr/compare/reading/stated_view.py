"""The view that a drawing of ours states: a model beside it is drawn so."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from hlr.compare.lines.sketch import PlacedView, StatedPage, StatedView
from hlr.drawing.drawing import Drawing, DrawnView
from hlr.drawing.line import Bounds
from hlr.drawing.section import Section
from hlr.drawing.sheet import SheetView
from hlr.request.options import Options, Perspective, SectionPlace, Steps, Vector, View
from hlr.request.scale import scale_of
from hlr.source.model import Frame


def stated_by(view: DrawnView, section: Section | None = None, window: Bounds | None = None) -> StatedView:
    """Of a drawing in memory."""
    cut, corners = (None, ()) if section is None else (section.point, section.corners)
    return StatedView(view.name, view.direction, view.up, view.eye, view.target, cut, corners, window)


def stated_in(name: str | None, fields: Mapping[str, str]) -> StatedView | None:
    """Of a file: its vectors as texts. None where it does not say them. Raises ValueError where they are no vectors."""
    if name is None or "direction" not in fields or "up" not in fields:
        return None
    eye, target, section = (_vector(fields[key]) if key in fields else None for key in ("eye", "target", "section"))
    direction, up = (_vector(fields[key]) for key in ("direction", "up"))
    numbers = fields.get("section-corners", "").split()
    corners = tuple(_vector(" ".join(numbers[k : k + 3])) for k in range(0, len(numbers), 3))
    if not any(direction) or not any(up):
        raise ValueError("a direction is zero")
    window = Bounds(*_numbers(fields["window"])) if "window" in fields else None
    return StatedView(name, direction, up, eye, target, section, corners, window)


def page_by(drawing: Drawing) -> StatedPage | None:
    """Of a page in memory; None where it is by no method of projection, or a view is in perspective."""
    if drawing.sheet is None or not drawing.sheet.method:
        return None
    found = [_placed_by(view) for view in drawing.sheet.views]
    size = None if drawing.page is None else (drawing.page.width, drawing.page.height)
    views = tuple(view for view in found if view is not None)
    return StatedPage(drawing.sheet.method, size, views) if len(views) == len(found) else None


def _placed_by(view: SheetView) -> PlacedView | None:
    if view.origin is None or view.rotation:
        return None
    x, y, z = np.cross(view.direction, view.right).tolist()
    stated = StatedView(view.label, view.direction, (x, y, z), section=view.section, corners=view.corners)
    return PlacedView(view.name, stated, view.scale, view.origin, view.letter)


def placed_in(fields: Mapping[str, str]) -> PlacedView | None:
    """A view of a page of a file: its vectors as texts. None where it does not say them. Raises as `stated_in`."""
    if any(name not in fields for name in ("direction", "right", "scale", "origin")):
        return None
    up = np.cross(_vector(fields["direction"]), _vector(fields["right"])).tolist()
    plane = {"section": fields.get("plane"), "section-corners": fields.get("plane-corners")}
    told = {"direction": fields["direction"], "up": " ".join(map(str, up))}
    stated = stated_in(fields.get("label"), told | {name: text for name, text in plane.items() if text is not None})
    x, y = _numbers(fields["origin"])
    if stated is None or float(fields.get("rotation", "0")) or ("section" in fields and stated.section is None):
        return None
    scale = scale_of(fields["scale"])
    letter = fields.get("section", "").partition("-")[0]
    return None if scale is None else PlacedView(fields.get("name", ""), stated, scale, (x, y), letter)


def stated_as_text(text: str) -> tuple[StatedView | None, float | None]:
    """Of a PDF or DXF of ours, and its scale: "view=front; direction=0 -1 0; ...". None: the file does not say it."""
    fields = dict(field.split("=", 1) for field in text.split("; ") if "=" in field)
    try:
        return stated_in(fields.get("view"), fields), scale_of(fields["scale"]) if "scale" in fields else None
    except ValueError:  # changed by another program, or cut short
        return None, None


def views_in_text(text: str) -> int:
    """How many views a page has, of a PDF or DXF of ours: "views=4"; 0: it does not say that it is a page."""
    number = text.removeprefix("views=")
    return int(number) if number != text and number.isascii() and number.isdigit() and len(number) < 6 else 0


def _vector(text: str) -> Vector:
    x, y, z = _numbers(text)
    return (x, y, z)


def _numbers(text: str) -> list[float]:
    numbers = [float(word) for word in text.split()]
    if not all(map(math.isfinite, numbers)):
        raise ValueError(f"{text} is not finite")
    return numbers


def as_stated(stated: StatedView, frame: Frame, options: Options) -> tuple[View, Options]:
    """The view of a model in this frame, and the options with what the view does not say."""
    up, direction = _to_world(stated.up, frame), _to_world(stated.direction, frame)
    options = replace(options, window=stated.window)
    if stated.eye is not None:
        target = None if stated.target is None else _millimetres(stated.target, frame)
        camera = Perspective(eye=_millimetres(stated.eye, frame), target=target)
        return direction, replace(options, up=up, perspective=camera)
    if stated.section is None:
        return direction, replace(options, up=up, section=None)
    place: SectionPlace = _millimetres(stated.section, frame)
    if stated.corners:
        place = _stepped([_millimetres(corner, frame) for corner in stated.corners], direction, up)
    return direction, replace(options, up=up, section=place)


def _stepped(corners: Sequence[Vector], direction: Vector, up: Vector) -> Steps:
    """A plane that steps at these corners, millimetres in the world. Raises ValueError where it is none."""
    toward, upward = (max(range(3), key=lambda k: abs(way[k])) for way in (direction, up))
    if toward == upward or len(corners) % 2:
        raise ValueError("a plane steps across an axis, from one point to another")
    (across,) = {0, 1, 2} - {toward, upward}
    steps = [(after[across], after[toward]) for after in corners[1::2]]
    return (corners[0][toward], *steps)


def _millimetres(point: Vector, frame: Frame) -> Vector:
    x, y, z = (frame.unit * c for c in _to_world(point, frame))
    return (x, y, z)


def _to_world(v: Vector, frame: Frame) -> Vector:
    """Model axes to world axes (z up)."""
    x, y, z = (sum(row[k] * v[k] for k in range(3)) for row in frame.up)
    return (x, y, z)
