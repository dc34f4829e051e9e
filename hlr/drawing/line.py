"""A line of a drawing, and the bounding rectangle of lines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from hlr.common.values import ByValue
from hlr.drawing.curve import Curve
from hlr.tables.line_classes import Kind

Points = npt.NDArray[np.float64]


class Bounds(NamedTuple):
    """A rectangle on paper, millimetres, y up.

    x0, y0  lower left corner
    x1, y1  upper right corner

    >>> import hlr
    >>> bounds = hlr.draw("part.step", view="top", scale=1).bounds
    >>> bounds.width, bounds.height
    (30.0, 20.0)
    """

    x0: float
    y0: float
    x1: float
    y1: float

    @property
    def width(self) -> float:
        """Millimetres."""
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        """Millimetres."""
        return self.y1 - self.y0


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Line(ByValue):
    """One visible or hidden piece of one edge. Lines are equal where all their fields are, number by number.

    kind     the name of a class in `hlr.tables.line_classes`: sharp, smooth, seam, outline, boundary, intersection or
             hatch, of a cut face
    visible  whether nothing is in front of it
    part     index into Drawing.parts
    edge     index in the part's TopExp edge map; None for meshes and outlines
    face     index in the part's TopExp face map for outlines and hatches; else None
    points   (n, 2) millimetres on paper, y up; along a curve within the accuracy
    points3  (n, 3) model coordinates, same count
    curve    the exact curve on paper, in millimetres; None: the polyline of its points
    other    of an intersection line: index of the second part (the same one where a part meets itself); else None

    >>> import hlr
    >>> line = hlr.draw("part.step", view="top").visible[0]
    >>> line
    <Line sharp, visible, part 0, edge 3, 2 points>
    >>> line.points.shape, line.points3.shape
    ((2, 2), (2, 3))
    >>> sorted({round(line.length_mm) for line in hlr.draw("part.step", view="top", scale=1).visible})
    [20, 25, 30]
    """

    kind: Kind
    visible: bool
    part: int
    edge: int | None
    face: int | None
    points: Points
    points3: Points
    other: int | None = None
    curve: Curve | None = None

    @property
    def length_mm(self) -> float:
        """Millimetres on paper: along the exact curve to five digits, else along the points."""
        if self.curve is not None:
            return self.curve.length_mm
        steps = np.diff(self.points, axis=0)
        return float(np.hypot(steps[:, 0], steps[:, 1]).sum())

    def __repr__(self) -> str:
        seen = "visible" if self.visible else "hidden"
        whose = "".join(
            f", {name} {n}"
            for name, n in (("part", self.part), ("edge", self.edge), ("face", self.face), ("other", self.other))
            if n is not None
        )
        shape = "" if self.curve is None else f", {self.curve!r}"
        return f"<Line {self.kind}, {seen}{whose}, {len(self.points)} points{shape}>"
