"""What a source hands to the scene: parts as meshes whose triangles and edges keep their B-rep identity."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Protocol

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Color = tuple[float, float, float]
Progress = Callable[[str, float], None]
"""Called with a stage's name and the fraction done (0..1)."""


class EdgeClass(IntEnum):
    """Why an edge is drawn; the names are those of the exchange format."""

    SHARP = 0
    SMOOTH = 1
    SEAM = 2
    BOUNDARY = 3
    OUTLINE = 4
    INTERSECTION = 5


@dataclass(frozen=True, slots=True)
class PartMesh:
    """One part, tessellated, in model coordinates (placements applied).

    points            (n, 3) float64; a node on an edge is one node, shared by the faces that meet there
    triangles         (m, 3) int32 into points; counter-clockwise seen from outside
    triangle_face     (m,)   int32: index of the face in the part's TopExp face map; 0 for meshes
    face_planar       (k,)   bool per face of that map (a planar face has no outline of its own)
    edge_nodes        (p,)   int32 into points: the polylines of all edges, one after another
    edge_offsets      (e+1,) int32 into edge_nodes
    edge_index        (e,)   int32: index of the edge in the part's TopExp edge map
    edge_class        (e,)   uint8: EdgeClass (SHARP, SMOOTH, SEAM or BOUNDARY)

    A mesh without B-rep leaves the four edge arrays empty and sets `brep` to False: creases and borders are then
    found by the scene. Free edges (belonging to no face) are edges of class SHARP whose nodes no triangle uses.
    """

    name: str
    color: Color | None
    transform: Floats
    points: Floats
    triangles: Ints
    triangle_face: Ints
    face_planar: npt.NDArray[np.bool_]
    edge_nodes: Ints
    edge_offsets: Ints
    edge_index: Ints
    edge_class: npt.NDArray[np.uint8]
    brep: bool


@dataclass(frozen=True, slots=True)
class Frame:
    """How model coordinates lie in the drawing's world (millimetres, z up)."""

    unit: float = 1.0
    up: tuple[tuple[float, float, float], ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class PartInfo:
    """What `hlr info` says of one part before it is meshed."""

    name: str
    faces: int
    edges: int
    solids: int


@dataclass(slots=True)
class Meshed:
    """All parts of a source, tessellated."""

    parts: list[PartMesh]
    notes: list[str] = field(default_factory=list)


class Source(Protocol):
    """An opened source: read once, meshed as finely as each request needs."""

    @property
    def name(self) -> str:
        """Base name, as the drawing states it."""

    @property
    def kind(self) -> str:
        """step, iges, brep, script, object, stl, obj, ply, off, 3mf, glb, mesh."""

    @property
    def frame(self) -> Frame:
        """Unit and up axis of the model's coordinates: world = unit * up * model."""

    @property
    def notes(self) -> list[str]:
        """Warnings met while reading; parts that could not be read are named here."""

    def bounds(self) -> Floats:
        """(2, 3) lower and upper corner in model coordinates; cheap, may be a little too large."""

    def infos(self) -> list[PartInfo]:
        """Every part's counts, in the order of the parts."""

    def mesh(self, deflection: float, angle: float, progress: Progress | None = None) -> Meshed:
        """Tessellate: chord error at most `deflection` (model units), turning at most `angle` (radians)."""
