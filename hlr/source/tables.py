"""The meshed B-rep as flat arrays: what either way of reading OpenCASCADE's structures delivers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.source.locations import Locations
from hlr.source.model import Floats, Ints

Bools = npt.NDArray[np.bool_]
Bytes = npt.NDArray[np.uint8]

COMPOUND, COMPSOLID, SOLID, SHELL, FACE, WIRE, EDGE, VERTEX = range(8)
FORWARD, REVERSED, INTERNAL, EXTERNAL = range(4)

G1 = 1
"""GeomAbs_Shape from here on is tangent: G1, C1, G2, C2, C3, CN."""


@dataclass(slots=True)
class Tables:
    """Underlying shapes (TShapes), each once, children before parents; the last one is the root compound. Its first
    child is a compound of bare faces (they bring the normals), the others are the parts.

    kind          (n,)   TopAbs_ShapeEnum
    degenerated   (n,)   bool, edges: a pole
    face_tri      (n,)   faces: number of the triangulation, else -1
    smooth        (n,)   edges: the best continuity recorded for two faces, -1 where none is
    sub_start     (n+1,) into the three arrays of sub-shapes: sub_shape, sub_orient, sub_loc
    rep_*         (r,)   edge polygons on triangulations: edge, triangulation, location of the face seen from the edge,
                  polygon, second polygon (-1: none)
    free_*        (f,)   edge polygons in space: edge, location, polygon
    poly_start    (p+1,) into poly_nodes: node numbers, 0-based within the triangulation
    line_start    (q+1,) into line_points (.., 3): polygons in space
    node_start    (t+1,) into nodes (.., 3), uv (.., 2; NaN where none is known) and normals (.., 3; zero where the
                  surface was not asked)
    tri_start     (t+1,) into triangles (.., 3): node numbers, 0-based within the triangulation
    """

    kind: Bytes
    degenerated: Bools
    face_tri: Ints
    smooth: Ints
    sub_start: Ints
    sub_shape: Ints
    sub_orient: Bytes
    sub_loc: Ints
    rep_edge: Ints
    rep_tri: Ints
    rep_loc: Ints
    rep_poly: Ints
    rep_poly2: Ints
    free_edge: Ints
    free_loc: Ints
    free_poly: Ints
    poly_start: Ints
    poly_nodes: Ints
    line_start: Ints
    line_points: Floats
    node_start: Ints
    nodes: Floats
    uv: Floats
    normals: npt.NDArray[np.float32]
    tri_start: Ints
    triangles: Ints
    locations: Locations


def starts(counts: Ints | list[int]) -> Ints:
    """(n+1,) running sums from 0: where each of n consecutive groups begins."""
    result = np.zeros(len(counts) + 1, dtype=np.int64)
    np.cumsum(counts, out=result[1:])
    if result[-1] >= 2**31:
        raise MemoryError("more than 2^31 items in one table")
    return result.astype(np.int32)


def ranges(first: Ints, counts: Ints) -> Ints:
    """first[0], first[0]+1, ... (counts[0] of them), then those of first[1], and so on."""
    total = int(counts.sum())
    if total == 0:
        return np.empty(0, dtype=np.int32)
    begin = np.cumsum(counts) - counts
    result: Ints = np.repeat((first - begin).astype(np.int32), counts)
    result += np.arange(total, dtype=np.int32)
    return result
