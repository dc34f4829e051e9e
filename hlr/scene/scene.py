"""The scene: all parts in one set of arrays, every mesh edge tied to its triangles, every drawn edge to its source."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.distinct import distinct
from hlr.common.types import Floats, Ints
from hlr.drawing.notes import Note
from hlr.scene.scene_parts import SceneParts
from hlr.source.model import Curves, Surfaces


@dataclass(frozen=True, slots=True)
class TrueSurfaces:
    """Where the triangles of B-rep parts lie on the surfaces of their faces; faces of all parts are numbered together.

    corner (t, 3) into uv (k, 2): parameters at the corners, -1 for parts without B-rep
    first (p,) the number of each part's first face; number (f,) of its surface in `surfaces`
    place (f, 3, 4) from the surface's frame into the model; inward (f,) bool; curved (f,) bool: may show an outline
    planar (f,) bool; curved_faces, planar_faces: how many are
    """

    corner: Ints
    uv: Floats
    first: Ints
    number: Ints
    place: Floats
    inward: npt.NDArray[np.bool_]
    curved: npt.NDArray[np.bool_]
    planar: npt.NDArray[np.bool_]
    curved_faces: int
    planar_faces: int
    surfaces: Surfaces

    def of(self, wanted: npt.NDArray[np.bool_], face: Ints) -> _kernel.TrueSurfaces:
        """As the kernel takes them. wanted (f,) bool: faces whose surfaces are included; face (t,) of each triangle."""
        known = wanted & (self.number >= 0)
        chosen = self.number[known]
        used = distinct(chosen)
        number = np.full(len(known), -1, np.int32)
        number[known] = np.searchsorted(used, chosen)
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
class IntersectionCurves:
    """The true curves of n intersection lines.

    rise (n,): how far each rises above the chords between its points, model units
    points (k, 3): the first k points of the geometry, with those of intersection lines moved onto the true surfaces
    """

    curves: Curves
    rise: Floats
    points: Floats


@dataclass(frozen=True, slots=True)
class Geometry:
    """All parts in one set of arrays: what a scene is made of, and an image of it.

    points (n, 3) model coordinates; triangles (t, 3); edges (e, 2), lower vertex first.
    triangle_part, triangle_group, triangle_face (t,): whose each triangle is.
    triangle_origin (t,): the triangle of the source, numbered within its part, that each is or is a piece of.
    turned (t,) bool: the source listed the corners the other way round, because its surface was inside out.
    incident[offsets[i]:offsets[i + 1]] are the triangles at edge i. Edges without triangles are wires, or intersection
    lines, which belong to a group of their own, or outlines of true surfaces, which belong to their part's group.
    edge_kind (e,): an EdgeClass or INTERIOR; edge_curved (e,) bool: a curved surface may show its outline there.
    true_surfaces: None where no part has a B-rep.
    walks: edges of the source, creases and borders of meshes, intersection lines and outlines as walks over edges.
    has_faces (p,) bool: the part has faces of a B-rep.
    convex: everything is one convex body, as far as floating point tells.
    intersections: None where no intersection line is curved.
    crossed (m, 2): the last m edges are intersection lines, and these the two triangles that cross there; None: no such
    line, or outlines and cut edges have been added since.
    through_themselves: numbers of parts whose surfaces pass through themselves.
    facets (t, 3): normals of parts without B-rep, zero where the coordinates are too coarse; None: all is B-rep.
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
    groups: _kernel.Groups
    walks: _kernel.Walks
    has_faces: npt.NDArray[np.bool_]
    parts: SceneParts
    true_surfaces: TrueSurfaces | None = None
    convex: bool = False
    facets: Floats | None = None
    intersections: IntersectionCurves | None = None
    crossed: Ints | None = None
    through_themselves: frozenset[int] = frozenset()

    def mesh(self) -> _kernel.Mesh:
        """Points, triangles and edges as the kernel takes them; the arrays are not copied."""
        return _kernel.Mesh(self.points, self.triangles, self.edges, self.offsets, self.incident)

    def true_points(self) -> Floats | None:
        """(n, 3) the points with those of intersection lines on the true surfaces; None where they are all the same."""
        if self.intersections is None:
            return None
        known = self.intersections.points
        return np.concatenate([known, self.points[len(known) :]])

    def all_faces(self) -> Ints:
        """(t,) the face of each triangle, numbered through all parts. Raises ValueError without true surfaces."""
        if self.true_surfaces is None:
            raise ValueError("no face of this scene has a surface")
        return (self.true_surfaces.first[self.triangle_part] + self.triangle_face).astype(np.int32)


@dataclass(frozen=True, slots=True)
class Scene(Geometry):
    """All parts of a source, meshed; the same for every view. notes: what is wrong with them."""

    notes: tuple[Note, ...] = ()
