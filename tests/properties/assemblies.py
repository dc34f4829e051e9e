"""Random assemblies: solids on a small lattice, which touch, cross, nest and stand flush, some turned.

A `Piece` is written down in a few integers, so that a failing example is a line to be copied into a test.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st
from properties.frozen import Frozen

from hlr.source.mesh.open_objects import open_meshes
from hlr.source.model import PartMesh
from hlr.tables.line_classes import EdgeClass

Vector = tuple[int, int, int]
ROUND = 24
"""Corners of a cylinder: folded by 15 degrees, which is no crease."""
SIZE = 10
"""No piece that is not turned reaches beyond 0..SIZE."""
KINDS = ("box", "tetrahedron", "wedge", "pentagon", "cylinder")


@dataclass(frozen=True)
class Piece:
    """A solid of a kind in the box low..low + size, then turned by so many degrees about an axis through its middle."""

    kind: str
    low: Vector
    size: Vector
    axis: Vector = (0, 0, 1)
    degrees: int = 0


@dataclass(frozen=True)
class Hull:
    """A convex solid in the unit cube: its faces as loops of corners, seen from outside counter-clockwise.

    side: the number of loops, counted from the first, that make up one curved face.
    """

    corners: np.ndarray
    loops: tuple[tuple[int, ...], ...]
    side: int = 0


def _extruded(outline: Sequence[tuple[float, float]], curved: bool = False) -> Hull:
    n = len(outline)
    corners = [(x, y, z) for z in (0.0, 1.0) for x, y in outline]
    sides = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    caps = [tuple(range(n))[::-1], tuple(range(n, 2 * n))]
    return Hull(np.array(corners), (*sides, *caps), n if curved else 0)


def _regular(n: int) -> list[tuple[float, float]]:
    angles = [2 * math.pi * i / n for i in range(n)]
    return [(0.5 + 0.5 * math.cos(a), 0.5 + 0.5 * math.sin(a)) for a in angles]


HULLS = {
    "box": _extruded([(0, 0), (1, 0), (1, 1), (0, 1)]),
    "wedge": _extruded([(0, 0), (1, 0), (0, 1)]),
    "pentagon": _extruded(_regular(5)),
    "cylinder": _extruded(_regular(ROUND), curved=True),
    "tetrahedron": Hull(
        np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float), ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))
    ),
}


def rotation(axis: Sequence[float], degrees: float) -> np.ndarray:
    """(3, 3). Quarter turns about the axes are exact."""
    u = np.asarray(axis, float) / math.sqrt(sum(float(a) * float(a) for a in axis))
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    if degrees % 90 == 0:
        c, s = float(round(c)), float(round(s))
    x, y, z = u
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return c * np.eye(3) + s * skew + (1 - c) * np.outer(u, u)


def corners(piece: Piece) -> np.ndarray:
    """(n, 3) where the piece's corners stand."""
    points = np.asarray(piece.low) + HULLS[piece.kind].corners * np.asarray(piece.size)
    if piece.degrees == 0:
        return points
    middle = np.asarray(piece.low) + np.asarray(piece.size) / 2
    return (points - middle) @ rotation(piece.axis, piece.degrees).T + middle


def part(piece: Piece, number: int, brep: bool) -> PartMesh:
    """The piece as a mesh, or as a B-rep solid with its faces, edges and seam."""
    hull = HULLS[piece.kind]
    face_of = [0 if hull.side and i < hull.side else i - max(hull.side - 1, 0) for i in range(len(hull.loops))]
    triangles = [(loop[0], *pair) for loop in hull.loops for pair in pairwise(loop[1:])]
    faces = [face for face, loop in zip(face_of, hull.loops, strict=True) for _ in loop[2:]]
    walks = _walks(hull) if brep else []
    planar = [not (hull.side and face == 0) for face in range(max(face_of) + 1)]
    return PartMesh(
        name=f"part{number}",
        color=None,
        transform=np.eye(4),
        points=corners(piece),
        triangles=np.array(triangles, np.int32),
        triangle_face=np.array(faces if brep else [0] * len(faces), np.int32),
        face_planar=np.array(planar if brep else [False]),
        edge_nodes=np.array([node for _, nodes in walks for node in nodes], np.int32),
        edge_offsets=np.cumsum([0, *(len(nodes) for _, nodes in walks)]).astype(np.int32),
        edge_index=np.arange(len(walks), dtype=np.int32),
        edge_class=np.array([kind for kind, _ in walks], np.uint8),
        brep=brep,
    )


def _walks(hull: Hull) -> list[tuple[EdgeClass, list[int]]]:
    """Every border between two faces once: sides of loops, or, round a curved side, the two rims and the seam."""
    if hull.side:
        n = hull.side
        rims = [[*range(n), 0], [*range(n, 2 * n), n]]
        return [(EdgeClass.SHARP, rims[0]), (EdgeClass.SHARP, rims[1]), (EdgeClass.SEAM, [0, n])]
    sides = {tuple(sorted(s)) for loop in hull.loops for s in zip(loop, (*loop[1:], loop[0]), strict=True)}
    return [(EdgeClass.SHARP, list(side)) for side in sorted(sides)]


def assembly(pieces: Sequence[Piece], brep: bool = True) -> Frozen:
    """All pieces, one part each."""
    return Frozen(tuple(part(piece, i, brep) for i, piece in enumerate(pieces)), brep)


@cache
def drilled(pieces: tuple[Piece, ...]) -> Frozen:
    """The first piece without what the others take away, as a mesh of one part."""
    import manifold3d as m3

    def solid(piece: Piece) -> Any:
        mesh = part(piece, 0, False)
        return m3.Manifold(m3.Mesh(mesh.points.astype(np.float32), mesh.triangles.astype(np.uint32)))

    rest = solid(pieces[0])
    for piece in pieces[1:]:
        rest -= solid(piece)
    return Frozen(tuple(open_meshes(rest).mesh(1.0, 1.0).parts), False)


coordinate = st.integers(0, 6)
length = st.integers(1, 4)
axes = st.tuples(*[st.integers(-2, 2)] * 3).filter(any)
VIEWS = ("front", "left", "top", "iso")
directions = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)
views = st.one_of(st.sampled_from(VIEWS), directions)
"""Along an axis, where nearly everything coincides; and askew, where no face of a lattice is seen under less than
12 degrees unless edge-on."""


def examples(count: int) -> settings:
    """So many in the ordinary run; where a profile searches at random, as many as that profile says."""
    return settings(max_examples=count if settings.default.derandomize else settings.default.max_examples)


def pieces(degrees: st.SearchStrategy[int]) -> st.SearchStrategy[Piece]:
    """Solids turned by any of the given angles."""
    triple = st.tuples(coordinate, coordinate, coordinate)
    return st.builds(Piece, st.sampled_from(KINDS), triple, st.tuples(length, length, length), axes, degrees)


upright = pieces(st.just(0))
turned = pieces(st.sampled_from((0, 0, 0, 90, 45, 30, 17)))


def assemblies(of: st.SearchStrategy[Piece] = turned, most: int = 5) -> st.SearchStrategy[tuple[Piece, ...]]:
    """One to so many pieces."""
    return st.lists(of, min_size=1, max_size=most).map(tuple)


@st.composite
def standing_apart(draw: st.DrawFn, kinds: Sequence[str], most: int = 6) -> tuple[Piece, ...]:
    """Upright solids in different cells of a lattice, none touching another."""
    cells = draw(st.lists(st.integers(0, 26), min_size=1, max_size=most, unique=True))
    sizes = st.tuples(length, length, length)
    lows = [(5 * (c % 3), 5 * (c // 3 % 3), 5 * (c // 9)) for c in cells]
    return tuple(Piece(draw(st.sampled_from(kinds)), low, draw(sizes)) for low in lows)
