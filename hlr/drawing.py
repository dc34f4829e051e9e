"""The drawing: lines on paper, each tied to its part and edge, and what is known about how they came to be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from hlr.curve import Arc, Bezier, Curve, arc_bounds, bezier_bounds
from hlr.notes import Note

if TYPE_CHECKING:
    from hlr.measure.reached import Reached
    from hlr.plan.effect import Decision
    from hlr.plan.options import Request

Points = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Line:
    """One visible or hidden piece of one edge.

    kind     sharp, smooth, seam, outline, boundary or intersection
    part     index into Drawing.parts
    edge     index in the part's TopExp edge map; None for meshes and outlines
    face     index in the part's TopExp face map for outlines; else None
    points   (n, 2) millimetres on paper, y up; along a curve within the accuracy
    points3  (n, 3) model coordinates, same count
    curve    what the line is on paper, in millimetres; None: its points
    other    of an intersection line: index of the second part (the same one where a part meets itself); else None
    """

    kind: str
    visible: bool
    part: int
    edge: int | None
    face: int | None
    points: Points
    points3: Points
    other: int | None = None
    curve: Curve | None = None


@dataclass(frozen=True, slots=True)
class Fill:
    """Faces under the lines, in the order of drawing: far to near.

    points (n, 2) millimetres on paper, y up; loops (l + 1,) int32 into points, faces (f + 1,) int32 into loops, filled
    by the even-odd rule; colors (f, 3) uint8 sRGB; part (f,) int32 index into Drawing.parts
    """

    points: Points
    loops: npt.NDArray[np.int32]
    faces: npt.NDArray[np.int32]
    colors: npt.NDArray[np.uint8]
    part: npt.NDArray[np.int32]


@dataclass(frozen=True, slots=True)
class DrawnPart:
    """A part as the drawing names it. color: sRGB 0..1; transform: (4, 4) placement, row major."""

    name: str
    color: tuple[float, float, float] | None
    transform: Points


@dataclass(frozen=True, slots=True)
class DrawnView:
    """The camera that was used, in model coordinates.

    projection is "orthographic" or "perspective"; direction points from the object toward the viewer.
    Perspective only: eye, target, fov (vertical, degrees), distance of the image plane from the eye.
    """

    name: str
    projection: str
    direction: tuple[float, float, float]
    right: tuple[float, float, float]
    up: tuple[float, float, float]
    eye: tuple[float, float, float] | None = None
    target: tuple[float, float, float] | None = None
    fov: float | None = None
    distance: float | None = None


@dataclass(frozen=True, slots=True)
class Drawing:
    """Visible and hidden lines of one view. points = (P.right, P.up) * unit * scale - origin.

    source    base name of what was drawn
    accuracy  {"asked": mm or None, "used": mm, "deflection": model units, ...}
    unit      millimetres per model unit
    up_axis   (3, 3) model frame -> z-up world
    fill      faces under the lines, in SVG and PDF; None unless asked for
    timings   seconds: source, tessellate, scene, plan, visibility, linework, write, total
    request   what was asked for; None for drawings that were made otherwise
    reached   the errors that were measured; None unless asked for
    plan      what was decided of each effect, why, and what it cost
    """

    source: str
    view: DrawnView
    scale: float
    origin: tuple[float, float]
    accuracy: Mapping[str, Any]
    unit: float
    up_axis: tuple[tuple[float, float, float], ...]
    parts: tuple[DrawnPart, ...]
    lines: tuple[Line, ...]
    notes: tuple[Note, ...] = ()
    counters: Mapping[str, int] = field(default_factory=dict)
    timings: dict[str, float] = field(default_factory=dict)
    fill: Fill | None = None
    request: Request | None = None
    reached: Reached | None = None
    plan: tuple[Decision, ...] = ()

    def bounds(self) -> tuple[float, float, float, float]:
        """(x0, y0, x1, y1) on paper in millimetres; all zero for an empty drawing."""
        if not self.lines:
            return (0.0, 0.0, 0.0, 0.0)
        boxes = [line.points for line in self.lines if line.curve is None]
        arcs = [line.curve for line in self.lines if isinstance(line.curve, Arc)]
        chains = [line.curve for line in self.lines if isinstance(line.curve, Bezier)]
        boxes += [arc_bounds(arcs)] if arcs else []
        boxes += [bezier_bounds(chains)] if chains else []
        points = np.concatenate(boxes)
        low, high = points.min(axis=0), points.max(axis=0)
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))

    def save(self, path: str | Path) -> Path:
        """Write SVG, PDF or JSON, by the ending of `path`.

        Raises WriteError where the ending is unknown or the file cannot be written.
        """
        from hlr.writers import write

        return write(self, path)
