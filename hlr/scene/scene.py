"""The scene: all parts in one set of arrays, every mesh edge tied to its triangles, every drawn edge to its source."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Color, Floats, Ints
from hlr.drawing.notes import Note
from hlr.source.model import Curves, Surfaces

INTERIOR = 255
"""Kind of a mesh edge that no source edge runs along."""


@dataclass(frozen=True, slots=True)
class Groups:
    """Surfaces that the visibility pass may treat as one: a B-rep part, or a connected piece of a mesh.

    closed   (g,) bool: every edge is used as often in one direction as in the other
    cull     (g,) bool: closed, and turned outward: faces turned away need not be looked at
    inward   (g,) bool: closed, and turned inward, as a cavity is
    sound    (g,) bool: does not pass through itself, as far as its source vouches for it
    bare     (g,) bool: a piece of a mesh without B-rep
    tight    (g,) bool: lines that lie exactly on other groups' triangles
    planar   (g,) bool: nothing but planar faces: exact, but for what the file rounds
    extent   (g,) float64: its thickness, or the smallest side of its box where that is less or it is open; model units
    low, high (g, 3) float64: its box
    """

    closed: npt.NDArray[np.bool_]
    cull: npt.NDArray[np.bool_]
    inward: npt.NDArray[np.bool_]
    sound: npt.NDArray[np.bool_]
    bare: npt.NDArray[np.bool_]
    tight: npt.NDArray[np.bool_]
    planar: npt.NDArray[np.bool_]
    extent: Floats
    low: Floats
    high: Floats


@dataclass(frozen=True, slots=True)
class TrueSurfaces:
    """Where the triangles of B-rep parts lie on the surfaces of their faces; faces of all parts are numbered together.

    corner (t, 3) into uv (k, 2): parameters at the corners, -1 for parts without B-rep
    first (p,) the number of each part's first face; number (f,) of its surface in `surfaces`
    place (f, 3, 4) from the surface's frame into the model; inward (f,) bool; curved (f,) bool: may show an outline
    planar (f,) bool
    """

    corner: Ints
    uv: Floats
    first: Ints
    number: Ints
    place: Floats
    inward: npt.NDArray[np.bool_]
    curved: npt.NDArray[np.bool_]
    planar: npt.NDArray[np.bool_]
    surfaces: Surfaces

    def of(self, wanted: npt.NDArray[np.bool_], face: Ints) -> _kernel.TrueSurfaces:
        """As the kernel takes them, with the surfaces of the faces that are wanted (f,); face (t,) of each triangle."""
        known = wanted & (self.number >= 0)
        used, which = np.unique(self.number[known], return_inverse=True)
        number = np.full(len(known), -1, np.int32)
        number[known] = which
        records = self.surfaces.records(used.tolist())
        return _kernel.TrueSurfaces(
            face,
            self.corner,
            self.uv,
            _kernel.Surfaces(records.kind, records.offsets, records.data),
            number,
            np.ascontiguousarray(self.place.reshape(-1, 12)),
            self.inward,
            self.curved,
        )


@dataclass(frozen=True, slots=True)
class OwnFaces:
    """Edges whose own faces are seen nearly edge-on, or stretches of them between places where a face turns over.

    edge (s,) ascending, range (s, 2): parameters of the stretch on the edge's image; line (s,): the edge that is the
    stretch, beside (s,) uint8: its faces, those of a closed body, show it (1), hide it (2), or it is not known (0),
    dented (s,) bool: its own triangles fold over there, though the faces do not
    offsets (s + 1,): its faces are face (k,) of all parts' faces, off (k,): the edge that is the stretch off that face.
    Of line and off none has triangles or is ever drawn, but where the stretch is all of the edge.
    first (p,) the number of each part's first face; sheet (f,) one number for faces that go on smoothly into others
    """

    edge: Ints
    range: Floats
    line: Ints
    beside: npt.NDArray[np.uint8]
    dented: npt.NDArray[np.bool_]
    offsets: Ints
    face: Ints
    off: Ints
    first: Ints
    sheet: Ints

    @staticmethod
    def none() -> OwnFaces:
        """Of a scene without curved faces."""
        no = np.zeros(0, np.int32)
        few, never = no.astype(np.uint8), no.astype(bool)
        return OwnFaces(no, np.zeros((0, 2)), no, few, never, np.zeros(1, np.int32), no, no, no, no)


@dataclass(frozen=True, slots=True)
class Silhouettes:
    """What the scene knows of the outlines of its true surfaces, which are lines without triangles among its edges.

    lift (n, 3): how far points are moved before visibility is decided: an outline runs within the tolerance of its own
    facets, which must not hide it. hidden (e,) bool: the outline's own body hides it.
    number (e,): of the outline to which an edge belongs, -1 for none
    curves of the outlines; NONE where one is straight, or runs along an edge of the model: source (o,) int32, else -1
    own: the faces that edges and outlines bound, where these are seen nearly edge-on
    """

    lift: Floats
    hidden: npt.NDArray[np.bool_]
    own: OwnFaces
    number: Ints
    curves: Curves
    source: Ints


@dataclass(frozen=True, slots=True)
class Chains:
    """Source edges as walks over mesh edges, sorted by part, then source edge.

    offsets (c+1,), edges (k,) mesh edges, reversed (k,) bool: walked from second to first vertex
    kind (c,) uint8 EdgeClass, part (c,) int32, index (c,) int32 in the part's TopExp edge map, -1 for meshes
    other (c,) int32: of an intersection line the second part, else -1
    face (c,) int32: of an outline the face, in the part's TopExp face map, else -1
    straight (c,) bool: two planar faces meet there at an angle; two planes have a straight line in common
    """

    offsets: Ints
    edges: Ints
    reversed: npt.NDArray[np.bool_]
    kind: npt.NDArray[np.uint8]
    part: Ints
    index: Ints
    other: Ints
    face: Ints
    straight: npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class ScenePart:
    """A part's identity and what was found out about it."""

    name: str
    color: Color | None
    transform: Floats
    faces: int
    edges: int
    triangles: int
    closed: bool
    oriented: bool
    defects: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Scene:
    """points (n, 3) model coordinates; triangles (t, 3); edges (e, 2), lower vertex first.

    incident[offsets[i]:offsets[i + 1]] are the triangles at edge i. edge_kind is an EdgeClass or INTERIOR;
    edge_curved tells the edges at which a curved surface may show its outline; convex: all there is is one convex body,
    as far as floating point tells. Edges without triangles are wires, or
    intersection lines; those belong to a group of their own; or outlines of true surfaces, of their part's group.
    facets (t, 3): normals of bare meshes as far as their coordinates support any, zero where none; None: all is B-rep.
    turned (t,) bool: listed the other way round by the source, which had the surface inside out.
    triangle_origin (t,): which triangle of its part each is, or is a piece of, of those that the source handed over.
    """

    points: Floats
    triangles: Ints
    triangle_part: Ints
    triangle_group: Ints
    triangle_face: Ints
    triangle_origin: Ints
    turned: npt.NDArray[np.bool_]
    edges: Ints
    offsets: Ints
    incident: Ints
    edge_part: Ints
    edge_group: Ints
    edge_kind: npt.NDArray[np.uint8]
    edge_curved: npt.NDArray[np.bool_]
    groups: Groups
    chains: Chains
    parts: tuple[ScenePart, ...]
    notes: tuple[Note, ...]
    true_surfaces: TrueSurfaces | None = None
    silhouettes: Silhouettes | None = None
    convex: bool = False
    facets: Floats | None = None

    def mesh(self) -> _kernel.Mesh:
        """Points, triangles and edges as the kernel takes them; the arrays are not copied."""
        return _kernel.Mesh(self.points, self.triangles, self.edges, self.offsets, self.incident)

    def all_faces(self) -> Ints:
        """(t,) of each triangle its face, numbered through all parts; only where there are true surfaces."""
        if self.true_surfaces is None:
            raise ValueError("no face of this scene has a surface")
        return (self.true_surfaces.first[self.triangle_part] + self.triangle_face).astype(np.int32)
