"""What `hlr info` says of a model."""

from __future__ import annotations

from dataclasses import dataclass

from hlr.drawing.notes import Note

Corner = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class PartReport:
    """One part. color: sRGB 0..1; defects in words, empty for a sound part."""

    name: str
    color: Corner | None
    solids: int
    faces: int
    edges: int
    triangles: int
    closed: bool
    oriented: bool
    defects: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ModelInfo:
    """A model: where it came from, how large it is (model units), and its parts."""

    source: str
    kind: str
    unit: float
    bounds: tuple[Corner, Corner]
    parts: tuple[PartReport, ...]
    notes: tuple[Note, ...]
