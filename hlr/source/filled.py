"""Whether the triangles of a face fill its outline: no more and no less.

OpenCASCADE's meshers now and then leave out part of a face, or all but a little of it, and report success. The nodes'
parameters tell, without any surface: in the (u, v) plane the areas of the triangles add up to what the polygons of the
face's edges enclose, exactly but for rounding.

    ::

         +--------+        +--------+        outline, from the polygons       1.00
         |\\      /|        |\\       |        triangles, each taken positive   1.00 | 0.75: a part is missing
         |  \\  /  |        |  \\     |                                              | 1.25: they overlap
         |  /  \\  |        |  /  \\  |
         |/______\\|        |/______\\|
"""

from __future__ import annotations

import numpy as np

from hlr.source import tables as t
from hlr.source.conform import representation
from hlr.source.model import Floats, Ints
from hlr.source.tables import Bools, Tables, ranges

ROUNDING = 1e-9
"""Share of the square of a face's extent in (u, v) that two sums of areas may differ by."""

MATTERS = 0.1
"""In deflections: a face is filled where what is missing or too much is less than this along the whole outline."""

LEAP = 0.6
"""Of a period: no chord of a curve is as long in (u, v)."""


def unfilled(tables: Tables, deflection: float, periods: Floats) -> Ints:
    """Numbers, among the faces of `tables`, of those whose triangles do not fill their outline, or have none.

    periods: (n, 2) of the surfaces of the last n faces, along u and v; infinite where there is none. Faces that have
    no wires, or no parameters at their nodes, are not judged.
    """
    count = len(tables.tri_start) - 1
    uv = _from_corner(tables)
    owner = np.repeat(np.arange(count, dtype=np.int32), np.diff(tables.tri_start))
    corner = tables.triangles + tables.node_start[owner][:, None]
    p, q, r = (uv[corner[:, k]] for k in range(3))
    parts = 0.5 * _cross(q - p, r - p)
    filled = np.bincount(owner, np.abs(parts), count)
    signed = np.abs(np.bincount(owner, parts, count))
    faces = np.flatnonzero(tables.kind == t.FACE)
    tri = tables.face_tri[faces]
    period = np.full((count + 1, 2), np.inf)
    period[tri[len(tri) - len(periods) :]] = periods
    enclosed, length, broken = _outlines(tables, uv, signed, period)

    off = np.maximum(np.abs(signed - enclosed), filled - signed)
    size = np.zeros(count)
    some = np.flatnonzero(np.diff(tables.node_start))
    size[some] = np.maximum.reduceat((uv**2).sum(axis=1), tables.node_start[some])
    doubtful = off > ROUNDING * size
    if doubtful.any():
        # What that is in space, by the mean ratio of the areas.
        mine = doubtful[owner]
        a, b, c = (tables.nodes[corner[mine][:, k]] for k in range(3))
        area = np.bincount(owner[mine], 0.5 * np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1)), count)
        bare = ~(area > 0.0) | ~(filled > 0.0)
        ratio = area / np.where(bare, 1.0, filled)
        doubtful &= bare | (off * ratio > MATTERS * deflection * length)
    bad = (length > 0.0) & np.isfinite(size) & (doubtful | broken)
    return np.flatnonzero((tri >= 0) & np.append(bad, False)[tri]).astype(np.int32)


def _from_corner(tables: Tables) -> Floats:
    """(u, v) of every node, from the first of its triangulation: areas are then no differences of large numbers."""
    counts = np.diff(tables.node_start)
    first = np.zeros((len(counts), 2))
    some = np.flatnonzero(counts)
    first[some] = tables.uv[tables.node_start[some]]
    return tables.uv - np.repeat(first, counts, axis=0)


def _cross(a: Floats, b: Floats) -> Floats:
    result: Floats = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return result


def _outlines(tables: Tables, uv: Floats, expected: Floats, period: Floats) -> tuple[Floats, Floats, Bools]:
    """Per triangulation: the area that the polygons of its edges enclose, their length in space, whether they gape.

    A seam has two polygons, and OpenCASCADE does not always keep to its rule which is which: they are taken as they
    come nearer to the expected area. Where curves in (u, v) do not meet, it pulls the ends of polygons together, round
    the whole surface if it must: a chord of most of a period is such a leap.
    """
    count = len(tables.tri_start) - 1
    rep, reverse, tri, lacking = _uses(tables)
    seam = tables.rep_poly2[rep] >= 0
    poly = np.where(reverse & seam, tables.rep_poly2[rep], tables.rep_poly[rep])
    chords = tables.poly_start[poly + 1] - tables.poly_start[poly] - 1
    first = ranges(tables.poly_start[poly], chords)
    owner = np.repeat(tri, chords)
    sign = np.repeat(np.where(reverse, -1.0, 1.0), chords)
    a = tables.poly_nodes[first] + tables.node_start[owner]
    b = tables.poly_nodes[first + 1] + tables.node_start[owner]

    def total(values: Floats) -> Floats:
        return np.bincount(owner, values, count).astype(np.float64, copy=False)

    swept = 0.5 * sign * _cross(uv[a], uv[b])
    plain = total(swept)
    swapped = np.abs(plain - 2.0 * total(np.where(np.repeat(seam, chords), swept, 0.0)))
    plain = np.abs(plain)
    enclosed = np.where(np.abs(swapped - expected) < np.abs(plain - expected), swapped, plain)
    # Closed: as many chords begin in a node as end there, whichever way they run.
    odd = np.flatnonzero(np.bincount(np.concatenate((a, b)), minlength=len(uv)) % 2)
    pole = np.repeat(tables.degenerated[tables.rep_edge[rep]], chords)
    leaps = owner[(np.abs(uv[b] - uv[a]) > LEAP * period[owner]).any(axis=1) & ~pole]
    broken = lacking
    broken[np.searchsorted(tables.node_start, odd, side="right") - 1] = True
    broken[leaps] = True
    return enclosed, total(np.sqrt(((tables.nodes[b] - tables.nodes[a]) ** 2).sum(axis=1))), broken


def _uses(tables: Tables) -> tuple[Ints, Bools, Ints, Bools]:
    """Edges in the wires of meshed faces: rep_* entry, whether run through backwards, triangulation.

    And per triangulation: whether some edge has no polygon on it.
    """
    counts = np.diff(tables.sub_start)
    faces = np.flatnonzero((tables.kind == t.FACE) & (tables.face_tri >= 0)).astype(np.int32)
    wire = ranges(tables.sub_start[faces], counts[faces])
    of_face = np.repeat(faces, counts[faces])
    wires = tables.kind[tables.sub_shape[wire]] == t.WIRE
    wire, of_face = wire[wires], of_face[wires]
    inner = counts[tables.sub_shape[wire]]
    edge = ranges(tables.sub_start[tables.sub_shape[wire]], inner)
    wire, of_face = np.repeat(wire, inner), np.repeat(of_face, inner)
    bounds = (tables.sub_orient[wire] <= t.REVERSED) & (tables.sub_orient[edge] <= t.REVERSED)
    wire, edge, of_face = wire[bounds], edge[bounds], of_face[bounds]
    loc = tables.locations.products(tables.sub_loc[wire], tables.sub_loc[edge])
    tri = tables.face_tri[of_face]
    here = np.zeros_like(loc)
    rep = representation(tables, tables.sub_shape[edge], tri, tables.locations.quotients(loc, here))
    lacking = np.bincount(tri[rep < 0], minlength=len(tables.tri_start) - 1) > 0
    found = rep >= 0
    reverse = tables.sub_orient[wire] != tables.sub_orient[edge]
    return rep[found], reverse[found], tri[found], lacking
