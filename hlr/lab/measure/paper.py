"""From model coordinates to paper as the exchange format describes it, not as the pipeline computes it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing


@dataclass(frozen=True, slots=True)
class Paper:
    """The projection of one drawing. rows (3, 4): from (x, y, z, 1) in the model to (x w, y w, w); origin (2,) in mm.

    toward (3,): unit vector toward the viewer; eye (3,) or None; per_model: millimetres on paper per model unit, in
    perspective at the distance of the target
    """

    rows: Floats
    origin: Floats
    toward: Floats
    eye: Floats | None
    per_model: float

    @classmethod
    def of(cls, drawing: Drawing) -> Paper:
        """The paper of a drawing."""
        view, factor = drawing.view, drawing.unit * drawing.scale
        right, up, toward = (np.array(v) for v in (view.right, view.up, view.direction))
        rows = np.zeros((3, 4))
        if view.eye is None or view.distance is None:
            rows[0, :3], rows[1, :3], rows[2, 3] = right * factor, up * factor, 1.0
            return cls(rows, np.array(drawing.origin), toward, None, factor)
        eye = np.array(view.eye)
        rows[:, :3] = right * (factor * view.distance), up * (factor * view.distance), -toward
        rows[:, 3] = -rows[:, :3] @ eye
        return cls(rows, np.array(drawing.origin), toward, eye, factor)

    def __call__(self, points: Floats) -> Floats:
        """Project points (n, 3) of the model to points (n, 2) on paper, in mm."""
        found = points @ self.rows[:, :3].T + self.rows[:, 3]
        with np.errstate(all="ignore"):
            return np.asarray(found[:, :2] / found[:, 2:] - self.origin)

    def derived(self, jet: Floats) -> Floats:
        """Project point, first and second derivative (n, 3, 3) of curves in the model to (n, 3, 2) on paper."""
        # Not by BLAS: for so few numbers, starting its threads costs more than the product.
        x = np.einsum("nkj,ij->nki", jet, self.rows[:, :3])
        x[:, 0] += self.rows[:, 3]
        with np.errstate(all="ignore"):
            w, dw, ddw = x[:, 0, 2:], x[:, 1, 2:], x[:, 2, 2:]
            p = x[:, 0, :2] / w
            d = (x[:, 1, :2] - p * dw) / w
            dd = (x[:, 2, :2] - 2.0 * d * dw - p * ddw) / w
        return np.stack([p - self.origin, d, dd], axis=1)

    def sight(self, points: Floats) -> Floats:
        """(n, 3) vectors from points (n, 3) to the eye; in a parallel view, unit vectors toward the viewer."""
        return np.broadcast_to(self.toward, points.shape) if self.eye is None else self.eye - points

    def magnified(self, points: Floats) -> Floats:
        """(n,) millimetres on paper per model unit at points (n, 3), across the line of sight."""
        if self.eye is None:
            return np.full(len(points), self.per_model)
        # The rows of x and y contain the factor from model to paper and the distance already.
        size = float(np.linalg.norm(self.rows[0, :3]))
        return np.asarray(size / np.maximum(points @ self.rows[2, :3] + self.rows[2, 3], 1e-300))
