"""Where sections and details are marked in the views that they are made of, as SVG."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from hlr.drawing.section_marks import EDGE_ON
from hlr.drawing.view_marks import BEYOND, LETTER, border_circle, detail_circle, section_line
from hlr.pipeline.page.placed_view import lines_on_page

if TYPE_CHECKING:
    from hlr.common.types import Floats
    from hlr.linework.cut_faces import CutFace
    from hlr.pipeline.page.placed_view import PlacedView

TURNS = (45.0, 135.0, 225.0, 315.0, 0.0, 90.0, 180.0, 270.0)
"""Degrees: where the letter of a detail may be placed around its circle, the usual place first."""

FROM_CIRCLE, ROOM = 0.85, 0.7
"""In sizes of letters: from the circle to the middle of the letter, and from there to the nearest line."""

BORDER = 0.35
"""Millimetres: the width of a detail's border where the document says none."""


def mark_of(placed: PlacedView, bases: Mapping[str, PlacedView], faces: Sequence[CutFace], height: float) -> str:
    """The mark of a section or a detail, and the border of a detail.

    bases: the views that are drawn, by name; faces: those that a section has cut; height: of the page
    """
    view = placed.view
    svg = ""
    if view.detail is not None:
        width = BORDER if view.widths is None else view.widths[0]
        svg = border_circle(view.place, view.detail.radius * view.scale, width, height)
    base = bases.get(view.mark.base) if view.mark is not None else None
    if base is None or base.view.focus is not None:
        return svg
    return svg + (_circle(placed, base, height) if view.detail is not None else _line(placed, base, faces, height))


def _circle(placed: PlacedView, base: PlacedView, height: float) -> str:
    view = placed.view
    assert view.detail is not None
    assert view.mark is not None
    whole = np.zeros(2) if base.view.detail is None else np.array(base.view.detail.middle)
    away = base.matrix @ (np.array(view.detail.middle) - whole) * base.view.scale
    middle, radius = np.array(base.view.place) + away, view.detail.radius * base.view.scale
    letter = free_place(middle, radius + FROM_CIRCLE * LETTER, [line.points for line in lines_on_page(base, 0)])
    return detail_circle(view.mark, _pair(middle), radius, _pair(letter), height)


def free_place(middle: Floats, reach: float, lines: Sequence[Floats]) -> Floats:
    """(2,) where a letter is placed so that no line runs through it: the first of eight places around a point.

    middle (2,), lines (n, 2) each, on the page; reach: from the middle, millimetres. Where lines run through all eight,
    it is the one farthest from them.
    """
    places = middle + reach * np.array([[np.cos(turn), np.sin(turn)] for turn in np.radians(TURNS)])
    starts = [line[:-1] for line in lines if len(line) > 1]
    if not starts:
        return np.asarray(places[0])
    a, b = np.concatenate(starts), np.concatenate([line[1:] for line in lines if len(line) > 1])
    way = b - a
    along = np.einsum("psi,si->ps", places[:, None] - a, way) / np.maximum((way * way).sum(axis=1), 1e-300)
    nearest = a + np.clip(along, 0.0, 1.0)[:, :, None] * way
    room = np.hypot(*np.moveaxis(places[:, None] - nearest, 2, 0)).min(axis=1)
    return np.asarray(places[int(np.argmax(np.minimum(room, ROOM * LETTER)))])


def _line(placed: PlacedView, base: PlacedView, faces: Sequence[CutFace], height: float) -> str:
    assert placed.view.mark is not None
    cut = placed.view.cuts[-1]
    normal = np.array(cut.normal) / float(np.linalg.norm(cut.normal))
    toward = np.array(base.drawing.view.direction)
    if abs(float(normal @ toward)) > EDGE_ON:
        return ""  # the plane is not seen from its edge
    along = np.cross(toward, normal)
    origin = np.array(cut.origin)
    reach = _reach(faces, origin, along)
    a, b = base.on_page(origin + reach[:, None] * along)
    way = _unit(base.turned(along[None])[0])
    back = _unit(base.turned(normal[None])[0])
    ends = (_pair(a - BEYOND * way), _pair(b + BEYOND * way))
    return section_line(placed.view.mark, ends, _pair(back), height)


def _reach(faces: Sequence[CutFace], origin: Floats, along: Floats) -> Floats:
    """(2,) from where to where the cut faces reach along the section line, model units."""
    if not faces:
        return np.zeros(2)
    points = np.concatenate([border for face in faces for border in face.borders])
    heights = (points - origin) @ along
    return np.array([heights.min(), heights.max()])


def _unit(way: Floats) -> Floats:
    return way / max(float(np.hypot(*way)), 1e-300)


def _pair(point: Floats) -> tuple[float, float]:
    x, y = point.tolist()
    return x, y
