"""The neighbours' projectors as cameras: lines in model units, in the same plane and place as OpenCASCADE puts them.

OpenCASCADE's projector is an origin, a direction toward the viewer, and a direction that points up in the plane. With
a focus the eye stands that far before the origin, and what lies in the plane through the origin keeps its size.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from hlr.drawing import Drawing, Line, Points
from hlr.errors import OptionError
from hlr.pipeline import draw_views
from hlr.plan.options import Options, Perspective
from hlr.plan.request import WIDEST
from hlr.source import open_source
from hlr.source.model import Floats
from hlr.tolerance import DEFAULT_ACCURACY
from hlr.view.camera import Vector, normalized

FINE = 2.5e-4
"""Of the model's diagonal: the accuracy of lines that go on as geometry, where 0.05 mm are not finer."""

SIZE_NOTE = "the drawing is "
"""How the note about a drawing too small or too large for paper begins: here lines are in model units."""


@dataclass(frozen=True, slots=True)
class Viewport:
    """An OpenCASCADE projector. direction and up as given; up need not be perpendicular, but must not be parallel."""

    origin: Vector
    direction: Vector
    up: Vector
    focus: float | None = None


@dataclass(frozen=True, slots=True)
class Picture:
    """A drawing at the model's own scale, and what to add to its points to get coordinates in the viewport's plane."""

    drawing: Drawing
    shift: Points

    def lines(self, kinds: Iterable[str], visible: bool) -> list[Line]:
        """Its lines of some kinds."""
        wanted = set(kinds)
        return [line for line in self.drawing.lines if line.visible == visible and line.kind in wanted]


def along(direction: Any, what: str, focus: float | None = None) -> Viewport:
    """The projector that OpenCASCADE makes of a direction alone: at the world's origin, with an up of its own choice.

    Raises OptionError, or ViewError for a direction of no length.
    """
    given = vector(direction, what)
    normalized(given, what)
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    up = gp_Ax2(gp_Pnt(), gp_Dir(*given)).YDirection()
    return Viewport((0.0, 0.0, 0.0), given, (up.X(), up.Y(), up.Z()), focus)


def draw(
    thing: Any,
    viewport: Viewport,
    *,
    hidden: bool = True,
    smooth: bool = True,
    seam: bool = False,
    accuracy: Callable[[Floats], float] | None = None,
) -> Picture:
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
        if not note.startswith(SIZE_NOTE):
            warnings.warn(note, stacklevel=3)
    shift = np.array(drawing.origin)
    if perspective is None:
        # In perspective the axis through the eye is the origin of the plane already.
        shift -= [_dot(viewport.origin, drawing.view.right), _dot(viewport.origin, drawing.view.up)]
    return Picture(drawing, shift)


def flat_extent(bounds: Floats, viewport: Viewport) -> tuple[float, float]:
    """Width and height of a model's box (2, 3) in the viewport's plane, by parallel rays."""
    normal = np.array(normalized(viewport.direction, "the view direction"))
    right = np.cross(viewport.up, normal)
    right /= math.sqrt(float((right * right).sum()))
    axes = np.stack([right, np.cross(normal, right)])
    width, height = (np.abs(axes) * (bounds[1] - bounds[0])).sum(axis=1).tolist()
    return float(width), float(height)


def vector(value: Any, what: str) -> Vector:
    """Three finite numbers; raises OptionError."""
    try:
        x, y, z = (real(number, what) for number in value)
    except (TypeError, ValueError, OptionError):
        raise OptionError(f"{what} needs three finite numbers, such as (1, -1, 1), not {value!r}") from None
    return (x, y, z)


def real(value: Any, what: str) -> float:
    """A finite number; raises OptionError."""
    if not isinstance(value, Real) or isinstance(value, bool) or not math.isfinite(value):
        raise OptionError(f"{what} needs a finite number, not {value!r}")
    return float(value)


def positive(value: Any, what: str) -> float:
    """A number above zero; raises OptionError."""
    number = real(value, what)
    if number <= 0.0:
        raise OptionError(f"{what} must be above zero, not {number:g}")
    return number


def _fine(bounds: Floats) -> float:
    diagonal = math.sqrt(float(((bounds[1] - bounds[0]) ** 2).sum()))
    return min(DEFAULT_ACCURACY, FINE * diagonal) or DEFAULT_ACCURACY


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
