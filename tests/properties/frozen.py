"""Models whose triangles are fixed, so that only the change under test makes a difference.

A STEP file meshed twice, once turned, gives other triangles: what then differs says more of the mesher than of the
drawing. So a model is meshed once, and the mesh is turned, shuffled, split and drawn as if it had just been read.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hlr import Drawing, Options
from hlr.source import open_source
from hlr.source.model import Appearance, Frame, PartInfo, PartMesh, Tessellation
from support.at_size import AT_SIZE
from support.stand_ins import draw_source

BREP = ("step", "iges", "brep", "script", "object")
ANGLE = 0.5


@dataclass(frozen=True)
class Frozen:
    """A source that hands over the same parts however finely it is asked to mesh; parts are named part0, part1..."""

    parts: tuple[PartMesh, ...]
    brep: bool = True
    frame: Frame = Frame()  # noqa: RUF009
    name: str = "frozen"

    @property
    def kind(self) -> str:
        return "object" if self.brep else "mesh"

    @property
    def notes(self) -> list[str]:
        return []

    def transparent(self) -> bool:
        return False

    def appearances(self) -> dict[str, Appearance]:
        return {}

    @property
    def points(self) -> np.ndarray:
        return np.concatenate([part.points for part in self.parts])

    @property
    def diagonal(self) -> float:
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))

    def bounds(self) -> np.ndarray:
        return np.stack([self.points.min(axis=0), self.points.max(axis=0)])

    def names(self) -> list[str]:
        return [part.name for part in self.parts]

    def infos(self) -> list[PartInfo]:
        return [PartInfo(part.name, len(part.face_planar), len(part.edge_index), 1) for part in self.parts]

    def boxes(self) -> list[np.ndarray]:
        return [part.points for part in self.parts]

    def mesh(self, deflection: float, angle: float, progress: Any = None) -> Tessellation:
        return Tessellation(parts=list(self.parts))


def freeze(thing: Any, fineness: float) -> Frozen:
    """Open and mesh once, with a chord error of the diagonal / fineness."""
    source = open_source(thing)
    low, high = source.bounds()
    meshed = source.mesh(float(np.linalg.norm(high - low)) / fineness, ANGLE)
    parts = [replace(part, name=f"part{i}") for i, part in enumerate(meshed.parts)]
    return Frozen(tuple(parts), source.kind in BREP, source.frame, "frozen")


def draw(model: Frozen, view: str | Sequence[float], accuracy: float, **options: Any) -> Drawing:
    """The accuracy is always given: by default it follows from the model's upright box, which turning changes."""
    return draw_source(model, view, Options(accuracy=accuracy, **AT_SIZE | options))
