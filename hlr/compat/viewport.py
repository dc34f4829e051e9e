"""OpenCASCADE's projectors as views: lines in model units, in the coordinates of the projector's plane.

A projector is an origin, a direction toward the viewer, and an up direction in the plane. With a focus it is a
perspective: the eye is that far in front of the origin, and the plane through the origin keeps its size.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.common.numbers import is_finite
from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line, Points
from hlr.drawing.lines import Lines, held
from hlr.errors import OptionError
from hlr.pipeline.draw import draw_views
from hlr.request.accuracy import DEFAULT_ACCURACY, SMALL_GEOMETRY
from hlr.request.check import WIDEST
from hlr.request.directions import axes, normalized
from hlr.request.options import Options, Perspective, Vector
from hlr.source import open_source
from hlr.source.bounds import diagonal
from hlr.source.model import Source
from hlr.tables.line_classes import EdgeClass


@dataclass(frozen=True, slots=True)
class Viewport:
    """An OpenCASCADE projector, lengths in model units.

    origin     point of the plane
    direction  toward the viewer, of any length
    up         points up in the plane; need not be perpendicular to direction, must not be parallel
    focus      distance of the eye in front of the origin; None: parallel projection
    """

    origin: Vector
    direction: Vector
    up: Vector
    focus: float | None = None


@dataclass(frozen=True, slots=True)
class ViewportDrawing:
    """A drawing in model units. `shift` (2,) added to its points gives coordinates in the viewport's plane."""

    drawing: Drawing
    shift: Points

    def lines(self, kinds: Iterable[str], visible: bool) -> list[Line]:
        """The visible or hidden lines of these kinds."""
        wanted = set(kinds)
        return [line for line in self.drawing.lines if line.visible == visible and line.kind in wanted]


def viewport_along(direction: Any, what: str, focus: float | None = None, up: Any = None) -> Viewport:
    """The projector that OpenCASCADE makes of a direction: at the world's origin, with its default up direction.

    Args:
        direction: toward the viewer, three numbers.
        what: name of the argument, for errors.
        focus: model units; None: parallel projection.
        up: points up in the plane, three numbers; None: OpenCASCADE's default.

    Raises:
        OptionError: these are not three finite numbers.
        ViewError: the direction has no length.
    """
    given = check_vector(direction, what)
    normalized(given, what)
    if up is not None:
        return Viewport((0.0, 0.0, 0.0), given, check_vector(up, "up"), focus)
    return Viewport((0.0, 0.0, 0.0), given, _usual_up(given), focus)


@lru_cache(maxsize=64)
def _usual_up(direction: Vector) -> Vector:
    """OpenCASCADE's default up direction of a projector."""
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    usual = gp_Ax2(gp_Pnt(), gp_Dir(*direction)).YDirection()
    return (usual.X(), usual.Y(), usual.Z())


def draw_viewport(
    thing: Any,
    viewport: Viewport,
    *,
    hidden: bool = True,
    smooth: bool = True,
    seam: bool = False,
    accuracy: Callable[[Floats], float] | None = None,
) -> ViewportDrawing:
    """The lines of a model in a viewport. Warnings of the drawing become Python warnings.

    Args:
        thing: whatever `hlr.draw` takes.
        viewport: the projector.
        hidden, smooth, seam: whether these lines are drawn.
        accuracy: from the model's bounds (2, 3) to the accuracy, both in model units.

    Raises:
        HlrError: as `hlr.draw_views`.
    """
    opened = open_source(thing)
    used = (accuracy or _default_accuracy)(opened.bounds())
    perspective = None
    if viewport.focus is not None:
        toward = normalized(viewport.direction, "the view direction")
        x, y, z = (o + viewport.focus * d for o, d in zip(viewport.origin, toward, strict=True))
        perspective = Perspective(eye=(x, y, z), target=viewport.origin, fov=WIDEST)
    options = Options(
        hidden=hidden,
        smooth=smooth,
        seam=seam,
        accuracy=used,
        up=viewport.up,
        perspective=perspective,
        scale=1.0,
        details=True,
    )
    (drawing,) = draw_views(opened, [viewport.direction], options)
    for note in drawing.notes:
        if note.is_warning:  # remarks are about the page and the file
            warnings.warn(str(note), stacklevel=_caller_level())
    lines = _lines_with_seams(drawing, opened, seam)
    if lines is not drawing.lines:
        drawing = replace(drawing, lines=lines)
    shift = np.array(drawing.origin)
    if perspective is None:
        # In perspective the axis through the eye is the origin of the plane already.
        shift -= [_dot(viewport.origin, drawing.view.right), _dot(viewport.origin, drawing.view.up)]
    return ViewportDrawing(drawing, shift)


def _lines_with_seams(drawing: Drawing, opened: Source, seam: bool) -> Sequence[Line]:
    """A drawing's lines; smooth edges of curvature continuity (G2) become seams, or are left out where `seam` is False.

    Such edges only divide a surface, as those between the halves of a cylinder do.
    """
    from hlr.source.cad.brep_source import BrepSource

    if not drawing.counters["smooth_lines"] or not isinstance(opened, BrepSource):
        return drawing.lines
    whole = held(drawing.lines)
    smooth = np.flatnonzero(whole.kinds() == EdgeClass.SMOOTH)
    from OCP.BRep import BRep_Tool
    from OCP.GeomAbs import GeomAbs_Shape

    curvature = int(GeomAbs_Shape.GeomAbs_G2)

    @cache
    def divides(part: int, edge: int) -> bool:
        shape = opened.edge_shape(drawing.parts[part].name, edge)
        return int(BRep_Tool.MaxContinuity_s(shape)) >= curvature

    columns = whole.columns()
    ties = columns["ties"][smooth, :2].tolist()
    seams = smooth[[edge >= 0 and divides(part, edge) for part, edge in ties]]
    if not seam:
        kept = np.ones(len(whole), bool)
        kept[seams] = False
        return Lines(whole.chosen(kept))
    columns["kind"][seams] = EdgeClass.SEAM
    return Lines(_kernel.Lines(**columns))


def flat_extent(bounds: Floats, viewport: Viewport) -> tuple[float, float]:
    """Width and height of a model's box (2, 3) in the viewport's plane, by parallel rays."""
    low, high = bounds.tolist()
    right, up = axes(normalized(viewport.direction, "the view direction"), viewport.up)
    sides = [b - a for a, b in zip(low, high, strict=True)]
    return _reach(right, sides), _reach(up, sides)


def _reach(axis: Vector, sides: Sequence[float]) -> float:
    """How far a box with these sides reaches along a direction."""
    return abs(axis[0]) * sides[0] + abs(axis[1]) * sides[1] + abs(axis[2]) * sides[2]


def check_vector(value: Any, what: str) -> Vector:
    """Three finite numbers; raises OptionError."""
    try:
        x, y, z = (check_number(number, what) for number in value)
    except (TypeError, ValueError, OptionError):
        raise OptionError(f"{what} needs three finite numbers, such as (1, -1, 1), not {value!r}") from None
    return (x, y, z)


def check_number(value: Any, what: str) -> float:
    """A finite number; raises OptionError."""
    if not is_finite(value):
        raise OptionError(f"{what} needs a finite number, not {value!r}")
    return float(value)


def check_positive(value: Any, what: str) -> float:
    """A number above zero; raises OptionError."""
    number = check_number(value, what)
    if number <= 0.0:
        raise OptionError(f"{what} must be above zero, not {number:g}")
    return number


def _caller_level() -> int:
    """The stack level, as `warnings.warn` counts, of the first caller outside hlr."""
    frame, level = sys._getframe(1), 1
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).startswith("hlr."):
        frame, level = frame.f_back, level + 1
    return level


def _default_accuracy(bounds: Floats) -> float:
    return min(DEFAULT_ACCURACY, SMALL_GEOMETRY * diagonal(bounds)) or DEFAULT_ACCURACY


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
