"""Faces that OpenCASCADE's meshers leave coarse, refined in place.

Both of its algorithms put too few nodes inside some curved faces, cones near their apex most of all, and join nodes of
different generators across the face: outlines, which follow the mesh, come out dented. Asking for less deflection moves
the nodes of the boundary and hardly those inside. So the triangulation itself is mended, in a few passes of two steps:

    ::

             apex                      apex                    r                    r
             /|\\                       /|\\                    /|\\                  /|\\
            / | \\      a secant       / | \\                  / | \\                / | \\
           /  i  \\     is turned     /  i  \\                /  |  \\    a chord    /  |  \\
          / /   \\ \\    into a       / / | \\ \\              p---+---q   too high  p---m---q
         /__-----__\\   generator   /_/  |  \\_\\              \\  |  /    is split   \\  |  /
        a     b     c             a     b     c              \\ s /    on the       \\ s /
                                                                      surface

Edges of the face (seams and poles as well) keep their nodes and their numbers: neighbours and the edges' polygons stay
what they were, and a closed mesh stays closed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hlr.source.model import Floats, Ints
from hlr.source.quality import heights
from hlr.source.tables import Bools

ENOUGH = 1.5
"""Deflections that a chord may stay off the surface: the middle of a triangle, a third more, is then off by 2."""

PASSES = 8
"""Each halves chords and so quarters their heights."""

SWEEPS = 24
"""Rounds of turning edges in one pass."""

MOST_NODES = 200_000
"""Nodes of a face beyond which no pass begins."""

UPRIGHT = 0.5
"""Least cosine between a turned triangle and the surface normals at its nodes: neither folds nor slivers."""


def refine(face: Any, triangles: Ints, fixed: Ints, deflection: float) -> bool:
    """Bring the chords inside a meshed face near the surface; whether anything was changed.

    face        TopoDS_Face, whose Poly_Triangulation is changed in place
    triangles   (n, 3) its triangles, nodes counted from 0
    fixed       (m, 2) pairs of nodes that stand for edges inside the face, which must stay

    Nodes are only added, at the end. A face without parameters at its nodes is left alone.
    """
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    # The triangulation lies in the frame of the face before its placement: there the surface is asked, too.
    here = TopoDS.Face(face.Located(TopLoc_Location(), False))
    triangulation = BRep_Tool.Triangulation_s(here, TopLoc_Location())
    if triangulation is None or not triangulation.HasUVNodes():
        return False
    surface = BRepAdaptor_Surface(here, False)
    mesh = _Mesh.read(triangulation, surface, triangles, fixed)
    limit = ENOUGH * deflection
    changed = False
    for _ in range(PASSES):
        turned = mesh.turn(limit)
        split = len(mesh.points) < MOST_NODES and mesh.split(limit, surface)
        changed |= turned or split
        if not split:
            break
    else:
        mesh.turn(limit)
    if changed:
        mesh.write(triangulation)
    return changed


@dataclass(slots=True)
class _Edges:
    """Edges inside the mesh: (n, 2) nodes p, q; the nodes opposite to them; the two triangles, p-q and q-p."""

    ends: Ints
    opposite: Ints
    sides: Ints
    height: Floats


@dataclass(slots=True)
class _Mesh:
    """Nodes with their places, parameters, normals (none at poles), and for each parameter whether it means nothing."""

    points: Floats
    uv: Floats
    normals: Floats
    idle: Bools
    triangles: Ints
    fixed: Ints
    same: Ints
    sign: float

    @classmethod
    def read(cls, triangulation: Any, surface: Any, triangles: Ints, fixed: Ints) -> _Mesh:
        numbers = range(1, triangulation.NbNodes() + 1)
        places = (triangulation.Node(i) for i in numbers)
        points = np.array([(p.X(), p.Y(), p.Z()) for p in places])
        parameters = (triangulation.UVNode(i) for i in numbers)
        uv = np.array([(p.X(), p.Y()) for p in parameters])
        _, normals, idle = _with_normals(surface, uv)
        # Both sides of a seam, and all nodes of a pole, are one place.
        _, same = np.unique(points, axis=0, return_inverse=True)
        triangles = triangles.copy()
        a, b, c = (points[triangles[:, k]] for k in range(3))
        upright = (np.cross(b - a, c - a) * normals[triangles].sum(axis=1)).sum()
        return cls(
            points,
            uv,
            normals,
            idle,
            triangles,
            _keys(fixed),
            same.ravel().astype(np.int32),
            1.0 if upright >= 0.0 else -1.0,
        )

    def edges(self) -> _Edges:
        """Edges with a triangle on either side, outside the fixed ones."""
        t = self.triangles
        ends = np.concatenate((t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]))
        keys = _keys(ends)
        order = np.argsort(keys, kind="stable")
        unique, first, counts = np.unique(keys[order], return_index=True, return_counts=True)
        first = first[(counts == 2) & ~np.isin(unique, self.fixed)]
        one, two = order[first], order[first + 1]
        opposed = ends[one, 0] == ends[two, 1]
        one, two = one[opposed], two[opposed]
        third = np.concatenate((t[:, 2], t[:, 0], t[:, 1]))
        return _Edges(
            ends=ends[one],
            opposite=np.stack((third[one], third[two]), axis=1),
            sides=np.stack((one, two), axis=1) % len(t),
            height=self.height(ends[one]),
        )

    def height(self, ends: Ints) -> Floats:
        return heights(self.points, self.normals, ends[:, 0], ends[:, 1])

    def length2(self, ends: Ints) -> Floats:
        result: Floats = ((self.points[ends[:, 0]] - self.points[ends[:, 1]]) ** 2).sum(axis=1)
        return result

    def turn(self, limit: float) -> bool:
        """Replace high chords by the other diagonal of their two triangles, where that one is far lower."""
        changed = False
        for _ in range(SWEEPS):
            edges = self.edges()
            high = np.flatnonzero(edges.height > limit)
            p, q = edges.ends[high].T
            r, s = edges.opposite[high].T
            other = self.height(edges.opposite[high])
            better = (other < 0.5 * edges.height[high]) & (self.same[r] != self.same[s])
            better &= self.upright(p, s, r) & self.upright(s, q, r)
            t = self.triangles
            present = _keys(self.same[np.concatenate((t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]))])
            wanted = _keys(self.same[edges.opposite[high]])
            better &= ~np.isin(wanted, present)
            # One turn per triangle and per new edge: the highest chord first.
            rank = np.lexsort((high, -edges.height[high]))
            rank = rank[better[rank]]
            rank = rank[np.sort(np.unique(wanted[rank], return_index=True)[1])]
            if not len(rank):
                break
            best = np.full(len(t), len(rank))
            sides = edges.sides[high[rank]]
            place = np.arange(len(rank))
            np.minimum.at(best, sides[:, 0], place)
            np.minimum.at(best, sides[:, 1], place)
            go = (best[sides] == place[:, None]).all(axis=1)
            rank, sides = rank[go], sides[go]
            t[sides[:, 0]] = np.stack((p[rank], s[rank], r[rank]), axis=1)
            t[sides[:, 1]] = np.stack((s[rank], q[rank], r[rank]), axis=1)
            changed = True
        return changed

    def upright(self, a: Ints, b: Ints, c: Ints) -> Bools:
        """Whether triangles stand like the surface at their corners."""
        points, normals = self.points, self.normals
        facing = self.sign * np.cross(points[b] - points[a], points[c] - points[a])
        normal = normals[a] + normals[b] + normals[c]
        size = np.sqrt((facing**2).sum(axis=1) * (normal**2).sum(axis=1))
        result: Bools = (facing * normal).sum(axis=1) > UPRIGHT * size
        return result

    def split(self, limit: float, surface: Any) -> bool:
        """Put a node on the surface amid every high chord, and divide the triangles beside it."""
        edges = self.edges()
        # A chord shorter than twice its height would be a turn beyond a right angle: a fold, which no node mends.
        high = np.flatnonzero((edges.height > limit) & (self.length2(edges.ends) > (2.0 * limit) ** 2))
        if not len(high):
            return False
        a, b = edges.ends[high].T
        # A parameter that means nothing at a pole is the other end's.
        first, second = self.uv[a], self.uv[b]
        uv = 0.5 * (np.where(self.idle[a], second, first) + np.where(self.idle[b], first, second))
        points, normals, idle = _with_normals(surface, uv)
        count = len(self.points)
        self.same = np.concatenate((self.same, self.same.max() + 1 + np.arange(len(high))))
        self.points = np.concatenate((self.points, points))
        self.uv = np.concatenate((self.uv, uv))
        self.normals = np.concatenate((self.normals, normals))
        self.idle = np.concatenate((self.idle, idle))

        t = self.triangles
        keys = _keys(edges.ends[high])  # ascending, as the edges are
        corner = _keys(np.stack((t, np.roll(t, -1, axis=1)), axis=2).reshape(-1, 2))
        at = np.minimum(np.searchsorted(keys, corner), len(keys) - 1)
        middle = np.where(keys[at] == corner, count + at, -1).reshape(-1, 3)
        marks = (middle >= 0).sum(axis=1)
        # Turned so that a lone marked edge comes first, and a lone unmarked one last.
        begin = np.where(marks == 1, (middle >= 0).argmax(axis=1), ((middle < 0).argmax(axis=1) + 1) % 3)
        turn = (begin[:, None] + np.arange(3)) % 3
        a, b, c = np.take_along_axis(t, turn, axis=1).T
        m, n, o = np.take_along_axis(middle, turn, axis=1).T
        # Two marked edges leave a quadrangle a m n c: its lower diagonal, the shorter one of equals.
        k = np.flatnonzero(marks == 2)
        plain, other = np.stack((m[k], c[k]), axis=1), np.stack((a[k], n[k]), axis=1)
        one, two = self.height(plain), self.height(other)
        crossed = np.zeros(len(t), dtype=bool)
        crossed[k] = (two < one) | ((two == one) & (self.length2(other) < self.length2(plain)))
        pieces = [t[marks == 0]]
        for where, corners in (
            (marks == 1, ((a, m, c), (m, b, c))),
            ((marks == 2) & ~crossed, ((m, b, n), (a, m, c), (m, n, c))),
            ((marks == 2) & crossed, ((m, b, n), (a, m, n), (a, n, c))),
            (marks == 3, ((a, m, o), (m, b, n), (o, n, c), (m, n, o))),
        ):
            pieces += [np.stack([nodes[where] for nodes in piece], axis=1) for piece in corners]
        self.triangles = np.concatenate(pieces)
        return True

    def write(self, triangulation: Any) -> None:
        """Back into the Poly_Triangulation; its normals are to be computed anew."""
        from OCP.gp import gp_Pnt, gp_Pnt2d
        from OCP.Poly import Poly_Triangle

        known = triangulation.NbNodes()
        triangulation.RemoveNormals()
        triangulation.ResizeNodes(len(self.points), True)
        rows = zip(self.points[known:].tolist(), self.uv[known:].tolist(), strict=True)
        for i, (place, parameters) in enumerate(rows, known + 1):
            triangulation.SetNode(i, gp_Pnt(*place))
            triangulation.SetUVNode(i, gp_Pnt2d(*parameters))
        triangulation.ResizeTriangles(len(self.triangles), True)
        for i, corners in enumerate((self.triangles + 1).tolist(), 1):
            triangulation.SetTriangle(i, Poly_Triangle(*corners))


def _keys(pairs: Ints) -> Any:
    """One number per pair of nodes, whichever comes first."""
    ordered = np.sort(pairs.astype(np.int64), axis=1)
    return ordered[:, 0] << 32 | ordered[:, 1]


def evaluated(surface: Any, uv: Floats) -> tuple[Floats, Floats, Floats]:
    """Points, and derivatives along u and v, of a BRepAdaptor_Surface at (n, 2) parameters; (n, 3) each."""
    from OCP.gp import gp_Pnt, gp_Vec

    place, along, across = gp_Pnt(), gp_Vec(), gp_Vec()
    values = np.empty((len(uv), 9))
    for row, (u, v) in zip(values, uv.tolist(), strict=True):
        surface.D1(u, v, place, along, across)
        row[:] = (
            *(place.X(), place.Y(), place.Z()),
            *(along.X(), along.Y(), along.Z()),
            *(across.X(), across.Y(), across.Z()),
        )
    return values[:, :3], values[:, 3:6], values[:, 6:]


def _with_normals(surface: Any, uv: Floats) -> tuple[Floats, Floats, Bools]:
    """Points, unit normals (0 at poles), and which parameters mean nothing there."""
    points, along, across = evaluated(surface, uv)
    d = np.stack((along, across), axis=1)
    size = np.sqrt((d**2).sum(axis=2))
    normals = np.cross(along, across)
    area = np.sqrt((normals**2).sum(axis=1))
    sound = area > 1e-9 * size.max(initial=0.0, axis=0).prod()
    normals[~sound] = 0.0
    normals[sound] /= area[sound, None]
    # Where both derivatives are there but parallel, neither parameter is to blame.
    idle = ~sound[:, None] & (size <= 1e-9 * size.max(initial=0.0, axis=0))
    return points, normals, idle
