"""A depth image by rays: what a viewer of the paper sees at any point of it.

The rays meet the mesh of a `RayCaster`, which does not depend on the drawing; only the camera is the drawing's.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from support.referee.exchange import Exchange, Floats
from support.referee.judge import RayCaster

PIXELS = 1000
"""Along the longer side of the paper."""
STEEPEST = 1e-6
"""Cosine between sight and normal of what is as good as edge-on."""
AT_ONCE = 8192
"""Rays: what is computed of so many stays in the cache of a processor."""
MARGIN = 5
"""Pixels around what is drawn."""


@dataclass(frozen=True)
class Hits:
    """The first hits of an array of rays, of any shape.

    depth   (...) millimetres on paper; inf: no hit
    normal  (..., 3) of the surface, turned to the viewer
    slope   (..., 2) growth of the depth per millimetre to the right and upward
    """

    depth: Floats
    normal: Floats
    slope: Floats

    @property
    def met(self) -> npt.NDArray[np.bool_]:
        return np.isfinite(self.depth)

    def __getitem__(self, index: object) -> Hits:
        return Hits(*(each[index] for each in (self.depth, self.normal, self.slope)))  # type: ignore[call-overload]

    def where(self, chosen: npt.NDArray[np.bool_], other: Hits) -> Hits:
        """These hits where `chosen` (n,) is true, those of `other` elsewhere."""
        wide = chosen[:, None]
        return Hits(
            np.where(chosen, self.depth, other.depth),
            np.where(wide, self.normal, other.normal),
            np.where(wide, self.slope, other.slope),
        )


@dataclass(frozen=True)
class Sheet:
    """The grid of pixels: centre of the lower left one, size of one in millimetres, numbers of columns and rows."""

    low: Floats
    pixel: float
    columns: int
    rows: int

    @classmethod
    def of(cls, drawing: Exchange, model: Floats, pixels: int = PIXELS) -> Sheet:
        """The sheet around a drawing and, in a parallel view, around all points of the model (n, 3)."""
        found = [line.points for line in drawing.lines]
        if drawing.camera.eye is None or not found:
            found.append(drawing.on_paper(model))
        points = np.concatenate(found)
        points = points[np.isfinite(points).all(axis=1)]
        low, high = points.min(axis=0), points.max(axis=0)
        pixel = float((high - low).max()) / pixels or 1.0
        # An odd offset within the pixel, so that lines parallel to the grid fall between its rows.
        low = low - (MARGIN + np.array([0.3819, 0.2361])) * pixel
        columns, rows = (int(n) for n in np.ceil((high - low) / pixel) + MARGIN)
        return cls(low, pixel, columns, rows)

    @cached_property
    def centres(self) -> Floats:
        """(rows, columns, 2) the centres of the pixels on paper, millimetres."""
        x = self.low[0] + self.pixel * np.arange(self.columns)
        y = self.low[1] + self.pixel * np.arange(self.rows)
        return np.stack(np.meshgrid(x, y), axis=2)

    def index(self, paper: Floats) -> npt.NDArray[np.int64]:
        """(n, 2): row and column of the pixel in which each point lies, clipped to the sheet."""
        at = np.rint((paper - self.low) / self.pixel).astype(np.int64)[:, ::-1]
        return np.asarray(np.clip(at, 0, [self.rows - 1, self.columns - 1]))


def dots(a: Floats, b: Floats) -> Floats:
    """Scalar products along the last axis: faster than a sum over so few numbers."""
    return np.asarray(np.einsum("...i,...i->...", a, b))


class Depths:
    """Casts rays through points on the paper of one drawing."""

    def __init__(self, drawing: Exchange, caster: RayCaster) -> None:
        self.drawing, self._caster = drawing, caster
        self._back = 2 * caster.diagonal + float(caster.centre @ drawing.camera.direction)

    def at(self, paper: Floats) -> Hits:
        """The first hits at points (..., 2) on paper."""
        flat, shape = paper.reshape(-1, 2), paper.shape[:-1]
        hits = Hits(np.empty(len(flat)), np.empty((len(flat), 3)), np.empty((len(flat), 2)))
        for start in range(0, len(flat), AT_ONCE):
            part = slice(start, start + AT_ONCE)
            self._cast(flat[part], hits[part])
        return Hits(hits.depth.reshape(shape), hits.normal.reshape(*shape, 3), hits.slope.reshape(*shape, 2))

    def _cast(self, paper: Floats, into: Hits) -> None:
        """Write the first hits at points (n, 2) into arrays."""
        starts, toward = self.drawing.rays(paper, self._back)
        far, triangle = self._caster.first(starts, toward)
        normal = self._caster.normals[triangle]
        away = dots(normal, toward)
        np.multiply(normal, np.where(away > 0, -1.0, 1.0)[:, None], out=into.normal)
        met = triangle >= 0
        into.depth[:] = np.inf
        if met.any():
            place = starts[met] + far[met, None] * toward[met]
            into.depth[met] = far[met] * self.drawing.magnification(place)
        facing = np.minimum(-np.abs(away), -STEEPEST)
        camera = self.drawing.camera
        into.slope[:] = into.normal @ np.stack([camera.right, camera.up], axis=1) / -facing[:, None]
