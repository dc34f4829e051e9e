"""Finds the depth of the flat pieces that OpenCASCADE's polygonal algorithm returns."""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from support.referee.exchange import Camera
from support.referee.reference import Floats, Reference

CELLS = 200
"""Cells of the search grid along the longer side of the image."""


class Lifter:
    """Finds the triangle edge that a flat piece was cut from.

    Outlines are not found where the algorithm has moved them into the inside of a triangle; they are left out.
    """

    def __init__(self, reference: Reference, camera: Camera) -> None:
        corners = reference.points[reference.triangles]
        a = corners.reshape(-1, 3)
        b = corners[:, [1, 2, 0]].reshape(-1, 3)
        frame = np.stack([camera.right, camera.up, camera.direction], axis=1)
        self._frame = frame
        ends = np.stack([a @ frame, b @ frame], axis=1)
        first = np.round(ends / (reference.diagonal * 1e-9))
        swap = [tuple(p) > tuple(q) for p, q in first]
        ends[swap] = ends[swap][:, ::-1]
        _, keep = np.unique(np.round(ends.reshape(-1, 6) / (reference.diagonal * 1e-9)), axis=0, return_index=True)
        self._ends = ends[keep]
        self._tolerance = reference.diagonal * 1e-6
        flat = self._ends[:, :, :2].reshape(-1, 2)
        self._low = flat.min(axis=0)
        self._cell = float((flat.max(axis=0) - self._low).max()) / CELLS
        self._grid: dict[tuple[int, int], list[int]] = defaultdict(list)
        self._fill()

    def _fill(self) -> None:
        for number, (p, q) in enumerate(self._ends[:, :, :2]):
            steps = int(np.abs(q - p).max() / self._cell * 2) + 2
            along = np.linspace(0, 1, steps)[:, None]
            for cell in {tuple(c) for c in self._cells(p + along * (q - p))}:
                self._grid[cell].append(number)

    def _cells(self, points: Floats) -> list[list[int]]:
        cells: list[list[int]] = np.floor((points - self._low) / self._cell).astype(int).tolist()
        return cells

    def lift(self, piece: Floats, nearest: bool) -> Floats | None:
        """The piece (2, 2) in model coordinates; of several edges over one another the nearest or the farthest."""
        (column, row) = self._cells(piece.mean(axis=0)[None])[0]
        near = [self._grid.get((column + i, row + j), []) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        numbers = np.unique(np.concatenate(near).astype(int))
        if not len(numbers):
            return None
        start, end = self._ends[numbers, 0], self._ends[numbers, 1]
        way = (end - start)[:, :2]
        length = np.sqrt((way**2).sum(axis=1))
        long_enough = length > self._tolerance
        start, end, way, length = (each[long_enough] for each in (start, end, way, length))
        along = np.stack([((p - start[:, :2]) * way).sum(axis=1) / length**2 for p in piece])
        aside = np.stack(
            [np.abs((p - start[:, :2])[:, 0] * way[:, 1] - (p - start[:, :2])[:, 1] * way[:, 0]) for p in piece]
        )
        slack = self._tolerance / length
        fits = ((aside / length < self._tolerance) & (along > -slack) & (along < 1 + slack)).all(axis=0)
        if not fits.any():
            return None
        lifted = start + along[:, :, None] * (end - start)
        choices = np.flatnonzero(fits)
        height = lifted[:, choices, 2].sum(axis=0)
        chosen = choices[np.argmax(height) if nearest else np.argmin(height)]
        result: Floats = lifted[:, chosen] @ self._frame.T
        return result
