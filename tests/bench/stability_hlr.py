"""A drawing by hlr of a model whose mesh was disturbed before any other stage sees it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import Options
from hlr.drawing.drawing import Drawing
from hlr.source import open_source
from hlr.source.model import Appearance, PartMesh, Source, Tessellation
from support.at_size import ALL_LINES
from support.stand_ins import draw_source

Floats = npt.NDArray[np.float64]

FIT = (277.0, 190.0)
"""Millimetres: the inside of an A4 sheet."""


def nodes(parts: Sequence[Floats], reach: float, seed: int) -> list[Floats]:
    """Every coordinate of every node moves by itself, by at most `reach`.

    The directions depend on the seed alone: a larger reach moves the nodes farther along the same ways.
    """
    ways = np.random.default_rng(seed)
    return [points + reach * ways.uniform(-1.0, 1.0, points.shape) for points in parts]


def turn(reach: float, size: float, seed: int) -> Floats:
    """(3, 3) rotation about a random axis that moves points at half the model's size from the axis by `reach`."""
    axis = np.random.default_rng(seed).normal(size=3)
    x, y, z = axis / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = 2.0 * reach / size
    return np.asarray(np.eye(3) + np.sin(angle) * k + 2.0 * np.sin(angle / 2.0) ** 2 * (k @ k))


class Disturbed:
    """A source that hands over given points instead of its own: same triangles, edges, names and bounds."""

    def __init__(self, source: Source, meshed: Tessellation, points: Sequence[Floats]) -> None:
        self.name, self.kind, self.frame, self.notes = source.name, source.kind, source.frame, source.notes
        self._source = source
        pairs = zip(meshed.parts, points, strict=True)
        parts = [replace(part, points=moved) for part, moved in pairs]
        self._meshed = Tessellation(parts, list(meshed.notes), touching=meshed.touching)

    def bounds(self) -> Floats:
        return self._source.bounds()

    def names(self) -> list[str]:
        return self._source.names()

    def infos(self) -> Any:
        return self._source.infos()

    def boxes(self) -> list[Floats]:
        return self._source.boxes()

    def transparent(self) -> bool:
        return False

    def appearances(self) -> dict[str, Appearance]:
        return {}

    def mesh(self, *_: Any) -> Tessellation:
        return self._meshed


class Model:
    """A model opened and meshed once, for one view and one scale.

    size       diagonal of the tessellation, model units
    per_model  millimetres on paper per model unit
    accuracy   millimetres on paper
    deflection of the tessellation, model units
    """

    def __init__(self, thing: Any, view: Any = "iso", fit: tuple[float, float] | None = FIT) -> None:
        self.source = open_source(str(thing) if isinstance(thing, Path) else thing)
        self._view = view
        first = draw_source(self.source, view, Options(scale=None if fit else 1.0, fit=fit, **ALL_LINES))
        self._options = Options(scale=first.scale, **ALL_LINES)
        self.view, self.scale = first.view, first.scale
        self.per_model = first.scale * first.unit
        self.accuracy = first.accuracy.used
        self.deflection = first.accuracy.deflection
        # Mesh again: a drawing that was fitted to a sheet does not hold its mesh.
        self.meshed = self._mesh()
        every = np.concatenate(self.points)
        low, high = every.min(axis=0), every.max(axis=0)
        self.size, self.centre = float(np.linalg.norm(high - low)), (low + high) / 2.0

    def _mesh(self) -> Tessellation:
        from hlr.request.accuracy import ANGLE

        return self.source.mesh(self.deflection, ANGLE)

    @property
    def points(self) -> list[Floats]:
        return [part.points for part in self.meshed.parts]

    @property
    def parts(self) -> list[PartMesh]:
        return self.meshed.parts

    def jiggled(self, amount: float, seed: int) -> Drawing:
        """Every node moved by itself; amount: of the model's size."""
        return self.drawn(nodes(self.points, amount * self.size, seed))

    def turned(self, amount: float, seed: int) -> Drawing:
        """The whole model turned a little before the same camera."""
        rotation = turn(amount * self.size, self.size, seed)
        return self.drawn([(points - self.centre) @ rotation.T + self.centre for points in self.points])

    def drawn(self, points: Sequence[Floats]) -> Drawing:
        return draw_source(Disturbed(self.source, self.meshed, points), self._view, self._options)
