"""A view of a page: drawn by itself, and put at its place."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hlr.common.types import Floats, Progress
from hlr.drawing.drawing import Drawing, DrawnView
from hlr.drawing.line import Bounds, Line
from hlr.drawing.moved import moved
from hlr.pipeline.draw import draw_views
from hlr.request.check import WIDEST
from hlr.request.options import Options, Perspective
from hlr.source.cad.brep_source import BrepSource
from hlr.source.freecad.page_views import PageView
from hlr.window.frame import Circle, Frame
from hlr.window.lines import cut_lines


@dataclass(frozen=True, slots=True, eq=False)
class PlacedView:
    """A view of a page before it was put at its place: what it shows, and its drawing.

    Lines lie at matrix @ (x, y) + shift on the page.
    """

    view: PageView
    source: BrepSource
    drawing: Drawing
    matrix: Floats
    shift: Floats

    @property
    def cut(self) -> bool:
        """Whether only those lines are there that lie inside a window or a circle of the page."""
        return self.view.window is not None or self.view.detail is not None

    def on_page(self, points: Floats) -> Floats:
        """Points (n, 3) of the model as (n, 2) mm on the page, of a parallel projection."""
        return self.turned(points) - np.array(self.drawing.origin) @ self.matrix.T + self.shift

    def turned(self, ways: Floats) -> Floats:
        """Directions and lengths (n, 3) of the model as (n, 2) mm on the page, of a parallel projection."""
        axes = np.array([self.drawing.view.right, self.drawing.view.up]) * (self.drawing.unit * self.view.scale)
        return np.asarray(ways @ axes.T @ self.matrix.T)


def placed_view(view: PageView, source: BrepSource, options: Options, progress: Progress | None) -> PlacedView:
    """Draw a view, and find its place. Raises SourceError as `draw_views`."""
    asked = replace(
        options,
        strict=False,
        scale=view.scale,
        up=_up(view),
        hidden=any(not visible for _, visible in view.lines),
        smooth=any(kind == "smooth" for kind, _ in view.lines),
        seam=any(kind == "seam" for kind, _ in view.lines),
        perspective=None if view.focus is None else _camera(view, source),
    )
    (drawing,) = draw_views(source, [view.direction], asked, progress)
    bounds = drawing.bounds
    if view.focus is None:
        middle = np.array([0.5 * (bounds.x0 + bounds.x1), 0.5 * (bounds.y0 + bounds.y1)])
    else:
        middle = -np.array(drawing.origin)
    if view.detail is not None:
        middle = middle + np.array(view.detail.middle) * view.scale
    turn = math.radians(view.rotation)
    matrix = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    return PlacedView(view, source, drawing, matrix, np.array(view.place) - matrix @ middle)


def lines_on_page(placed: PlacedView, first_part: int) -> list[Line]:
    """The lines that the view shows, at their places. first_part: is added to the numbers of their parts."""
    view = placed.view
    shown = [x for x in placed.drawing.lines if (x.kind, x.visible) in view.lines]
    lines = [moved(x, placed.matrix, placed.shift, first_part) for x in shown]
    if not placed.cut:
        return lines
    seen = _seen(placed)
    if view.detail is not None:
        lines = list(cut_lines(lines, Circle(seen, view.scale, view.place, view.detail.radius * view.scale))[0])
    if view.window is not None:
        lines = list(cut_lines(lines, Frame(seen, view.scale, Bounds(*view.window)))[0])
    return lines


def _seen(placed: PlacedView) -> DrawnView:
    """The view with its axes turned as it is on the page."""
    drawn, (turned_right, turned_up) = placed.drawing.view, placed.matrix
    axes = np.array([drawn.right, drawn.up])
    right, up = turned_right @ axes, turned_up @ axes
    return replace(drawn, right=tuple(right.tolist()), up=tuple(up.tolist()))


def _up(view: PageView) -> tuple[float, float, float]:
    x, y, z = np.cross(view.direction, view.right).tolist()
    return x, y, z


def _camera(view: PageView, source: BrepSource) -> Perspective:
    """The eye in front of the middle of what is seen, in the box whose sides lie along the view's axes."""
    toward = np.array(view.direction) / math.sqrt(sum(x * x for x in view.direction))
    axes = np.array([view.right, np.cross(toward, view.right), toward])
    low, high = source.bounds()
    size = float(np.max(high - low))
    points: Floats = np.concatenate([part.points for part in source.mesh(1e-4 * size, 0.2).parts]) @ axes.T
    target = 0.5 * (points.min(axis=0) + points.max(axis=0)) @ axes
    eye = target + (view.focus or 0.0) / view.scale * toward
    return Perspective(eye=tuple(eye.tolist()), target=tuple(target.tolist()), fov=WIDEST)
