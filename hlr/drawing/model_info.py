"""The result of `hlr info`: a report on a model and its parts."""

from __future__ import annotations

from dataclasses import dataclass

from hlr.drawing.notes import Note

Corner = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class PartReport:
    """One part, as `hlr info` lists it.

    name       of the part, unique in the model
    color      sRGB, 0 to 1; None: the source gives none
    solids     how many; 0 for meshes
    faces      of the B-rep; 0 for meshes
    edges      of the B-rep; of a mesh the edges along its creases and borders
    triangles  after meshing
    closed     every side of a triangle has a neighbour: the part bounds a volume
    oriented   neighbouring triangles face the same way
    defects    in words; empty for a sound part
    """

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
    """A model: where it came from, how large it is, and its parts.

    source  base name of the file, or of what was given instead
    kind    step, iges, brep, script, object, stl, obj, ply, off, 3mf, glb or mesh
    unit    millimetres per model unit
    bounds  lower and upper corner, model units
    parts   in the order of the source
    notes   warnings and remarks

    >>> import hlr
    >>> model = hlr.info("part.step")
    >>> model.kind, model.unit, len(model.parts)
    ('step', 1.0, 1)
    """

    source: str
    kind: str
    unit: float
    bounds: tuple[Corner, Corner]
    parts: tuple[PartReport, ...]
    notes: tuple[Note, ...]
