"""A depth image by rays: what a viewer of the paper sees at any point of it.

It is a `RayCaster`'s mesh that is seen, which knows nothing of the drawing; the drawing only says where the camera
stands.
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
MARGIN = 5
"""Pixels around what is drawn."""


@dataclass(frozen=True)
class Hits:
    """What rays (...) meet first.

    depth   (...) millimetres on paper; inf: nothing
    normal  (..., 3) turned to the viewer
    slope   (..., 2) by how much the depth grows to the right and upward
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
        """The chosen ones of these (n,), the rest from `other`."""
        wide = chosen[:, None]
        return Hits(
            np.where(chosen, self.depth, other.depth),
            np.where(wide, self.normal, other.normal),
            np.where(wide, self.slope, other.slope),
        )


@dataclass(frozen=True)
class Sheet:
    """The grid of pixels: centres of the lower left one, size of one in millimetres, columns and rows."""

    low: Floats
    pixel: float
    columns: int
    rows: int

    @classmethod
    def of(cls, drawing: Exchange, model: Floats, pixels: int = PIXELS) -> Sheet:
        """What is drawn and, in a parallel view, all of the model (n, 3): lines may be missing at its border."""
        found = [line.points for line in drawing.lines]
        if drawing.camera.eye is None or not found:
            found.append(drawing.on_paper(model))
        points = np.concatenate(found)
        points = points[np.isfinite(points).all(axis=1)]
        low, high = points.min(axis=0), points.max(axis=0)
        pixel = float((high - low).max()) / pixels or 1.0
        # A place of its own within the pixel: lines that are parallel to the grid fall between its rows.
        low = low - (MARGIN + np.array([0.3819, 0.2361])) * pixel
        columns, rows = (int(n) for n in np.ceil((high - low) / pixel) + MARGIN)
        return cls(low, pixel, columns, rows)

    @cached_property
    def centres(self) -> Floats:
        """(rows, columns, 2) on paper."""
        x = self.low[0] + self.pixel * np.arange(self.columns)
        y = self.low[1] + self.pixel * np.arange(self.rows)
        return np.stack(np.meshgrid(x, y), axis=2)

    def index(self, paper: Floats) -> npt.NDArray[np.int64]:
        """(n, 2): row and column of the pixel in which each point lies, clipped to the sheet."""
        at = np.rint((paper - self.low) / self.pixel).astype(np.int64)[:, ::-1]
        return np.asarray(np.clip(at, 0, [self.rows - 1, self.columns - 1]))


class Depths:
    """Casts rays through points on the paper of one drawing."""

    def __init__(self, drawing: Exchange, caster: RayCaster) -> None:
        self.drawing, self._caster = drawing, caster
        self._back = 2 * caster.diagonal + float(caster.centre @ drawing.camera.direction)

    def at(self, paper: Floats) -> Hits:
        """What is seen at points (..., 2)."""
        flat = paper.reshape(-1, 2)
        starts, toward = self.drawing.rays(flat, self._back)
        far, triangle = self._caster.first(starts, toward)
        normal = self._caster.normals[triangle]
        normal = np.where((normal * toward).sum(axis=1)[:, None] > 0, -normal, normal)
        met = triangle >= 0
        depth = np.full(len(flat), np.inf)
        if met.any():
            place = starts[met] + far[met, None] * toward[met]
            depth[met] = far[met] * self.drawing.magnification(place)
        facing = np.minimum((normal * toward).sum(axis=1), -STEEPEST)
        camera = self.drawing.camera
        slope = -np.stack([normal @ camera.right, normal @ camera.up], axis=1) / facing[:, None]
        shape = paper.shape[:-1]
        return Hits(depth.reshape(shape), normal.reshape(*shape, 3), slope.reshape(*shape, 2))
