"""The neighbours' projectors as cameras: lines in model units, in the same plane and place as OpenCASCADE puts them.

OpenCASCADE's projector is an origin, a direction toward the viewer, and a direction that points up in the plane. With
a focus the eye stands that far before the origin, and what lies in the plane through the origin keeps its size.
"""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from numbers import Real
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line, Points
from hlr.errors import OptionError
from hlr.pipeline.draw import draw_views
from hlr.request.accuracy import DEFAULT_ACCURACY, SMALL_GEOMETRY
from hlr.request.check import WIDEST
from hlr.request.directions import normalized
from hlr.request.options import Options, Perspective, Vector
from hlr.source import open_source
from hlr.source.model import Source


@dataclass(frozen=True, slots=True)
class Viewport:
    """An OpenCASCADE projector. direction and up as given; up need not be perpendicular, but must not be parallel."""

    origin: Vector
    direction: Vector
    up: Vector
    focus: float | None = None


@dataclass(frozen=True, slots=True)
class ViewportDrawing:
    """A drawing at the model's own scale, and what to add to its points to get coordinates in the viewport's plane."""

    drawing: Drawing
    shift: Points

    def lines(self, kinds: Iterable[str], visible: bool) -> list[Line]:
        """Its lines of some kinds."""
        wanted = set(kinds)
        return [line for line in self.drawing.lines if line.visible == visible and line.kind in wanted]


def viewport_along(direction: Any, what: str, focus: float | None = None) -> Viewport:
    """The projector that OpenCASCADE makes of a direction alone: at the world's origin, with an up of its own choice.

    Raises OptionError, or ViewError for a direction of no length.
    """
    given = check_vector(direction, what)
    normalized(given, what)
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    up = gp_Ax2(gp_Pnt(), gp_Dir(*given)).YDirection()
    return Viewport((0.0, 0.0, 0.0), given, (up.X(), up.Y(), up.Z()), focus)


def draw_viewport(
    thing: Any,
    viewport: Viewport,
    *,
    hidden: bool = True,
    smooth: bool = True,
    seam: bool = False,
    accuracy: Callable[[Floats], float] | None = None,
) -> ViewportDrawing:
    """The lines of anything that can be drawn, as a viewport shows them.

    accuracy: model units, chosen from the model's bounds (2, 3). What a drawing notes becomes a Python warning.
    Raises what `hlr.draw_views` raises.
    """
    opened = open_source(thing)
    used = (accuracy or _fine)(opened.bounds())
    perspective = None
    if viewport.focus is not None:
        toward = normalized(viewport.direction, "the view direction")
        x, y, z = (o + viewport.focus * d for o, d in zip(viewport.origin, toward, strict=True))
        perspective = Perspective(eye=(x, y, z), target=viewport.origin, fov=WIDEST)
    options = Options(
        hidden=hidden, smooth=smooth, seam=seam, accuracy=used, up=viewport.up, perspective=perspective, scale=1.0
    )
    (drawing,) = draw_views(opened, [viewport.direction], options)
    for note in drawing.notes:
        if note.is_warning:  # remarks are on paper and on files
            warnings.warn(str(note), stacklevel=_caller())
    drawing = replace(drawing, lines=_sewn(drawing, opened, seam))
    shift = np.array(drawing.origin)
    if perspective is None:
        # In perspective the axis through the eye is the origin of the plane already.
        shift -= [_dot(viewport.origin, drawing.view.right), _dot(viewport.origin, drawing.view.up)]
    return ViewportDrawing(drawing, shift)


def _sewn(drawing: Drawing, opened: Source, seam: bool) -> tuple[Line, ...]:
    """A drawing's lines; tangent edges that OpenCASCADE knows to be more than tangent are seams.

    Such edges only divide a surface, as those between the halves of a cylinder do. Where no seams are drawn, they are
    not drawn either.
    """
    from hlr.source.cad.brep_source import BrepSource

    if not isinstance(opened, BrepSource) or all(line.kind != "smooth" for line in drawing.lines):
        return tuple(drawing.lines)
    from OCP.BRep import BRep_Tool
    from OCP.GeomAbs import GeomAbs_Shape

    curvature = int(GeomAbs_Shape.GeomAbs_G2)
    divides: dict[tuple[int, int], bool] = {}
    for line in drawing.lines:
        if line.kind == "smooth" and line.edge is not None and (line.part, line.edge) not in divides:
            edge = opened.edge_shape(drawing.parts[line.part].name, line.edge)
            divides[line.part, line.edge] = int(BRep_Tool.MaxContinuity_s(edge)) >= curvature
    found = []
    for line in drawing.lines:
        if line.kind == "smooth" and line.edge is not None and divides[line.part, line.edge]:
            if not seam:
                continue
            line = replace(line, kind="seam")  # noqa: PLW2901
        found.append(line)
    return tuple(found)


def flat_extent(bounds: Floats, viewport: Viewport) -> tuple[float, float]:
    """Width and height of a model's box (2, 3) in the viewport's plane, by parallel rays."""
    normal = np.array(normalized(viewport.direction, "the view direction"))
    right = np.cross(viewport.up, normal)
    right /= math.sqrt(float((right * right).sum()))
    axes = np.stack([right, np.cross(normal, right)])
    width, height = (np.abs(axes) * (bounds[1] - bounds[0])).sum(axis=1).tolist()
    return float(width), float(height)


def check_vector(value: Any, what: str) -> Vector:
    """Three finite numbers; raises OptionError."""
    try:
        x, y, z = (check_number(number, what) for number in value)
    except (TypeError, ValueError, OptionError):
        raise OptionError(f"{what} needs three finite numbers, such as (1, -1, 1), not {value!r}") from None
    return (x, y, z)


def check_number(value: Any, what: str) -> float:
    """A finite number; raises OptionError."""
    if not isinstance(value, Real) or isinstance(value, bool) or not math.isfinite(value):
        raise OptionError(f"{what} needs a finite number, not {value!r}")
    return float(value)


def check_positive(value: Any, what: str) -> float:
    """A number above zero; raises OptionError."""
    number = check_number(value, what)
    if number <= 0.0:
        raise OptionError(f"{what} must be above zero, not {number:g}")
    return number


def _caller() -> int:
    """The stack level, for whoever asks, of the first caller that is not hlr itself."""
    frame, level = sys._getframe(1), 1
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).startswith("hlr."):
        frame, level = frame.f_back, level + 1
    return level


def _fine(bounds: Floats) -> float:
    diagonal = math.sqrt(float(((bounds[1] - bounds[0]) ** 2).sum()))
    return min(DEFAULT_ACCURACY, SMALL_GEOMETRY * diagonal) or DEFAULT_ACCURACY


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
