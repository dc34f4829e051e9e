"""Types that sources return: part meshes whose triangles and edges keep their B-rep identity, colours, curves."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from inspect import signature
from typing import Protocol

import numpy as np
import numpy.typing as npt

from hlr.common.types import Color, Floats, Ints, Progress, Rgba
from hlr.drawing.notes import Note

DEFAULT_COLOR: Rgba = (0.70, 0.74, 0.79, 1.0)
"""Colour and opacity of parts without a colour."""


class Surfaces(Protocol):
    """The surfaces under a source's faces, as the kernel's records."""

    def records(self, numbers: Sequence[int]) -> SurfaceRecords:
        """The records of the faces with these numbers, in this order."""

    def spindles(self) -> list[tuple[int, float, float]]:
        """Faces on tori whose tube reaches beyond their axis: number, major and minor radius."""


@dataclass(frozen=True, slots=True)
class SurfaceRecords:
    """kind (n,) uint8 as the kernel's `brep/src/geometry/surface.rs` numbers them, 0 where it is not known; the numbers
    of record i are data[offsets[i]:offsets[i + 1]]."""

    kind: npt.NDArray[np.uint8]
    offsets: Ints
    data: Floats


@dataclass(frozen=True, slots=True)
class SurfaceParameters:
    """Where a part's mesh lies on the surfaces of its faces.

    corner    (m, 3)    int32 into uv: a node on an edge has different parameters on each of its faces
    uv        (k, 2)    parameters on the surface
    number    (f,)      per face of the part's TopExp face map: its number in `surfaces`
    place     (f, 3, 4) from the surface's frame to the part's own, before the part's placement
    reversed  (f,) bool: the surface's normal points inward
    """

    corner: Ints
    uv: Floats
    number: Ints
    place: Floats
    reversed: npt.NDArray[np.bool_]
    surfaces: Surfaces


@dataclass(frozen=True, slots=True)
class PartMesh:
    """One part, tessellated, in model coordinates (placements applied).

    points            (n, 3) float64; a node on an edge is one node, shared by the faces that meet there
    triangles         (m, 3) int32 into points; counter-clockwise seen from outside
    triangle_face     (m,)   int32: index of the face in the part's TopExp face map; 0 where a file knows no faces
    face_planar       (k,)   bool per face of that map (a planar face has no outline of its own)
    edge_nodes        (p,)   int32 into points: the polylines of all edges, one after another
    edge_offsets      (e+1,) int32 into edge_nodes
    edge_index        (e,)   int32: index of the edge in the part's TopExp edge map
    edge_class        (e,)   uint8: EdgeClass (SHARP, SMOOTH, SEAM or BOUNDARY)
    surface_parameters       where the triangles lie on their true surfaces; None where there are none
    precision         how far rounding may have moved the coordinates of a mesh, in model units
    joined            bool: no two points are in one place
    origin            (m,) int32, of a mesh that the scene has repaired: the source's own triangle that each one is, or
                      is a piece of; None: triangles are those of the source

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
    surface_parameters: SurfaceParameters | None = None
    precision: float = 0.0
    joined: bool = False
    origin: Ints | None = None


@dataclass(frozen=True, slots=True)
class Appearance:
    """How one part looks.

    whole    the part's own colour; None where the source says nothing
    faces    by index in the part's TopExp face map, where a face has its own
    corners  (m, 3, 4) float32 sRGB and opacity at the corners of the part's triangles, of meshes that are painted
             finer than by part; `points` and `triangles` are those of the part as it was meshed
    """

    whole: Rgba | None = None
    faces: Mapping[int, Rgba] = field(default_factory=dict)
    corners: npt.NDArray[np.float32] | None = None
    points: Floats | None = None
    triangles: Ints | None = None


def rgba(color: Color | None, opacity: float) -> Rgba | None:
    """A colour with its opacity; None where there is no colour."""
    return None if color is None else (*color, opacity)


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


@dataclass(frozen=True, slots=True)
class Curves:
    """Records of n curves.

    kind    (n,) uint8, 0 where the curve is not known
    range   (n, 2) first and last parameter; the curve is run through in rising order
    offsets (n+1,) into values: the numbers of each record, as `hlr.source.curve_records` describes them
    """

    kind: npt.NDArray[np.uint8]
    range: Floats
    offsets: Ints
    values: Floats


@dataclass(frozen=True, slots=True)
class EdgeCurves:
    """Curves of m edges: edge i is that of record which[i], moved by places[place[i]].

    which (m,), place (m,); places (p, 3, 4)
    """

    curves: Curves
    which: Ints
    place: Ints
    places: Floats


@dataclass(slots=True)
class Tessellation:
    """All parts of a source, tessellated.

    edge_curves: the curves of edges, given as (m,) parts and (m,) indices in their TopExp edge maps; None for meshes
    rescued, lost: how many underlying faces were mended or meshed by OpenCASCADE, and how many nobody could mesh
    surface_parts: the names of parts that are faces outside all solids, which may be open; asked only where one is
    touching: (p,) of B-reps, how many faces of each part are meshed more finely, as they may touch others; empty: none
    """

    parts: Sequence[PartMesh]
    notes: list[Note] = field(default_factory=list)
    rescued: int = 0
    lost: int = 0
    edge_curves: Callable[[Ints, Ints], EdgeCurves] | None = None
    surface_parts: Callable[[], Collection[str]] = frozenset
    touching: Ints = field(default_factory=lambda: np.zeros(0, np.int32))


Choice = tuple[tuple[str, ...], tuple[str, ...]]
"""Patterns of parts that are drawn, and of those that are left out."""


class Source(Protocol):
    """An opened source: read once, meshed as finely as each request needs.

    Any object that follows this protocol can be drawn. Beyond it, a source may have two methods that save work:
    `reach(right, up)`, (2, 2): from where to where the model extends along two directions of length 1, or a little
    further; and `is_one_sphere()`: there is one part, and it is one whole sphere. Its `mesh` may take one thing more,
    `finer`: the names of parts of which all faces are meshed as finely as where they touch others.
    """

    @property
    def name(self) -> str:
        """Base name, as the drawing states it."""

    @property
    def kind(self) -> str:
        """As `hlr.tables.readers` has it: step, iges, brep, script, stl, obj, ply, off, 3mf or glb; object for other
        B-reps, mesh for other triangles, mixed for both. A kind that no reader has counts as a mesh."""

    @property
    def frame(self) -> Frame:
        """Unit and up axis of the model's coordinates: world = unit * up * model."""

    @property
    def notes(self) -> list[Note]:
        """Warnings met while reading; parts that could not be read are named here."""

    def bounds(self) -> Floats:
        """(2, 3) lower and upper corner in model coordinates; cheap, may be a little too large."""

    def names(self) -> list[str]:
        """The names of all parts, in the order of the parts."""

    def infos(self) -> list[PartInfo]:
        """The counts of all parts, in the order of the parts."""

    def boxes(self) -> list[Floats]:
        """(k, 3) corners of every part in model coordinates, in the order of the parts; cheap, may be too far out."""

    def of_parts(self, names: Collection[str], choice: Choice) -> Source:
        """The source with these parts only; `choice`: the patterns that chose them."""

    def mesh(self, deflection: float, angle: float, progress: Progress | None = None) -> Tessellation:
        """Tessellate: chord error at most `deflection` (model units), turning at most `angle` (radians)."""

    def transparent(self) -> bool:
        """Some part may be transparent; cheap, and sure where it says no."""

    def appearances(self) -> Mapping[str, Appearance]:
        """How the parts look, by name; gathered only when asked for, because most drawings do not need it."""


MEMBERS = tuple(name for name in vars(Source) if not name.startswith("_"))
"""The names that the protocol `Source` asks for."""


def mesh_finely(
    source: Source, deflection: float, angle: float, progress: Progress | None, finer: Collection[str]
) -> Tessellation:
    """Mesh a source; where its `mesh` has such an argument, parts of the names `finer` are meshed more finely."""
    mesh: Callable[..., Tessellation] = source.mesh
    if finer and _has_finer(mesh):
        return mesh(deflection, angle, progress, finer=finer)
    return mesh(deflection, angle, progress)


def _has_finer(mesh: Callable[..., Tessellation]) -> bool:
    try:
        # What a decorator stands for may have the argument where the decorator has not.
        return "finer" in signature(mesh, follow_wrapped=False).parameters
    except ValueError:  # Compiled code need not say.
        return False


def is_source(thing: object) -> bool:
    """Whether an object follows the protocol `Source`."""
    return next(missing_of_source(thing), None) is None


def missing_of_source(thing: object) -> Iterator[str]:
    """What an object lacks of the protocol `Source`, by name; nothing is called, and no property read."""
    places = [getattr(thing, "__dict__", ()), *map(vars, type(thing).__mro__)]
    # A proxy forwards the attributes that it does not have itself.
    forwards = hasattr(type(thing), "__getattr__")
    for name in MEMBERS:
        for place in places:
            if name in place:
                break
        else:
            if not (forwards and hasattr(thing, name)):
                yield name
