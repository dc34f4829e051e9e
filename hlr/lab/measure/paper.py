"""From model coordinates to paper as the exchange format describes it, not as the pipeline computes it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing
from hlr.image.camera import NEAR


@dataclass(frozen=True, slots=True)
class Paper:
    """The projection of one drawing. rows (3, 4): from (x, y, z, 1) in the model to (x w, y w, w); origin (2,) in mm.

    toward (3,): unit vector toward the viewer; eye (3,) or None; per_model: millimetres on paper per model unit, in
    perspective at the distance of the target; nearest: distance of the near plane from the eye
    """

    rows: Floats
    origin: Floats
    toward: Floats
    eye: Floats | None
    per_model: float
    nearest: float = 0.0

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
        return cls(rows, np.array(drawing.origin), toward, eye, factor, NEAR * view.distance)

    def __call__(self, points: Floats) -> Floats:
        """Project points (n, 3) of the model to points (n, 2) on paper, in mm; NaN behind the eye."""
        found = points @ self.rows[:, :3].T + self.rows[:, 3]
        with np.errstate(all="ignore"):
            return np.asarray(found[:, :2] / _ahead(found[:, 2:]) - self.origin)

    def chords(self, starts: Floats, ends: Floats) -> tuple[Floats, Floats]:
        """(n, 4) images of straight lines from starts to ends (n, 3), NaN behind the eye; and which share has one.

        Of a line that passes the eye only the part before the near plane has an image: shares (n, 2) of its length.
        """
        w = np.stack([p @ self.rows[2, :3] + self.rows[2, 3] - self.nearest for p in (starts, ends)], axis=1)
        with np.errstate(all="ignore"):
            at = w[:, 0] / (w[:, 0] - w[:, 1])
        shares = np.stack([np.where(w[:, 0] < 0.0, at, 0.0), np.where(w[:, 1] < 0.0, at, 1.0)], axis=1)
        shares[(w < 0.0).all(axis=1)] = np.nan
        # An end that is not cut keeps its place to the last bit.
        a = np.where(w[:, :1] < 0.0, starts + shares[:, :1] * (ends - starts), starts)
        b = np.where(w[:, 1:] < 0.0, starts + shares[:, 1:] * (ends - starts), ends)
        return np.concatenate([self(a), self(b)], axis=1), shares

    def derived(self, jet: Floats) -> Floats:
        """Project point, first and second derivative (n, 3, 3) of curves in the model to (n, 3, 2) on paper.

        NaN behind the eye.
        """
        # Not by BLAS: for so few numbers, starting its threads costs more than the product.
        x = np.einsum("nkj,ij->nki", jet, self.rows[:, :3])
        x[:, 0] += self.rows[:, 3]
        with np.errstate(all="ignore"):
            w, dw, ddw = _ahead(x[:, 0, 2:]), x[:, 1, 2:], x[:, 2, 2:]
            p = x[:, 0, :2] / w
            d = (x[:, 1, :2] - p * dw) / w
            dd = (x[:, 2, :2] - 2.0 * d * dw - p * ddw) / w
        return np.stack([p - self.origin, d, dd], axis=1)

    def sight(self, points: Floats) -> Floats:
        """(n, 3) vectors from points (n, 3) to the eye; in a parallel view, unit vectors toward the viewer."""
        return np.broadcast_to(self.toward, points.shape) if self.eye is None else self.eye - points

    def magnified(self, points: Floats) -> Floats:
        """(n,) millimetres on paper per model unit at points (n, 3), across the line of sight; NaN behind the eye."""
        if self.eye is None:
            return np.full(len(points), self.per_model)
        # The rows of x and y contain the factor from model to paper and the distance already.
        size = float(np.linalg.norm(self.rows[0, :3]))
        return np.asarray(size / _ahead(points @ self.rows[2, :3] + self.rows[2, 3]))


def _ahead(w: Floats) -> Floats:
    """How far points lie before the eye's plane; NaN where they lie behind it and have no image."""
    return np.where(w > 0.0, w, np.nan)
