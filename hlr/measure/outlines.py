"""Distance of written outlines from where the true surface is seen edge-on, by OpenCASCADE's evaluation.

A point q of a written outline is put on the surface of its face, and moved there until

    g(u, v) = N . V = 0          the surface is seen edge-on
    h(u, v) = (p - q) . t = 0    its place p on paper is beside q, square to the line's direction t

by Newton's method, in the least step that would do. |p - q| is then the error: never less than the distance to the true
outline. Where a fold lies on an edge of the face, that edge is the true outline.

::

           true outline  ----------p---------
                                   |  error
           written       ----------q-----> t
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from typing import Any

import numpy as np

from hlr.drawing import Drawing
from hlr.measure.edges import TrueEdges
from hlr.measure.paper import Paper
from hlr.measure.written import Index, Written, in_model
from hlr.source.model import Floats

ITERATIONS = 30
EDGE_ON = 1e-9
"""|N . V| of unit vectors below which a place counts as edge-on."""
STEP = 10.0
"""In accuracies: the longest step on a surface. What is farther away is another outline."""
ENOUGH = 0.25
"""Of the accuracy: where an error is larger, other places are tried, and folds along edges."""


def outline_errors(
    opened: Any, drawing: Drawing, drawn: Written, paper: Paper, samples: int, threads: int
) -> tuple[Floats, list[str]]:
    """(n,) error of points of written outlines, at most about `samples` of them, and names for them."""
    wanted = np.array([x.kind == "outline" and x.face is not None for x in drawing.lines], bool)
    mine = np.flatnonzero(wanted[drawn.line])
    mine = mine[:: max(1, len(mine) // max(samples, 1))]
    if len(mine) == 0:
        return np.zeros(0), []
    q, line = drawn.points[mine], drawn.line[mine]
    way = _directions(drawn, mine)
    near = in_model(drawing, q, line, threads)
    accuracy = float(drawing.accuracy["used"])
    faces: dict[tuple[int, int], list[int]] = defaultdict(list)
    for i, number in enumerate(line.tolist()):
        of = drawing.lines[number]
        faces[of.part, of.face or 0].append(i)
    off = np.full(len(mine), np.inf)
    for (part, face), those in faces.items():
        of = drawing.parts[part]
        judge = _Face(opened.face_shape(of.name, face), of.transform, paper, accuracy)
        for i in those:
            off[i] = judge.error(near[i], q[i], way[i])
    far = np.flatnonzero(off > ENOUGH * accuracy)
    if len(far):
        off[far] = np.minimum(off[far], _to_folds(opened, drawing, paper, q[far], line[far], threads))
    names = [f"{drawing.parts[drawing.lines[i].part].name}, outline of face {drawing.lines[i].face}" for i in line]
    return off, names


def _directions(drawn: Written, which: Index) -> Floats:
    """(n, 2) unit vectors along the lines at some of their points."""
    last = len(drawn.points) - 1
    after = np.minimum(which + 1, last)
    before = np.maximum(which - 1, 0)
    after = np.where(drawn.line[after] == drawn.line[which], after, which)
    before = np.where(drawn.line[before] == drawn.line[which], before, which)
    way = drawn.points[after] - drawn.points[before]
    size = np.hypot(way[:, 0], way[:, 1])[:, None]
    return np.asarray(np.divide(way, size, out=np.zeros_like(way), where=size > 0.0))


class _Face:
    """One face's surface, where its part stands."""

    def __init__(self, face: Any, transform: Floats, paper: Paper, accuracy: float) -> None:
        from OCP.BRep import BRep_Tool
        from OCP.ShapeAnalysis import ShapeAnalysis_Surface

        self._surface = BRep_Tool.Surface_s(face)
        self._find = ShapeAnalysis_Surface(self._surface)
        self._turn, self._shift = transform[:3, :3], transform[:3, 3]
        self._back = np.linalg.inv(self._turn)
        self._paper = paper
        self._most = STEP * accuracy / paper.per_model
        self._enough = ENOUGH * accuracy
        self._accuracy = accuracy

    def error(self, near: Floats, q: Floats, way: Floats) -> float:
        """Distance on paper between q (2,) and an edge-on place beside it; infinity where none is found."""
        from OCP.gp import gp_Pnt

        start = self._find.ValueOfUV(gp_Pnt(*(self._back @ (near - self._shift)).tolist()), 1e-9)
        at = np.array([start.X(), start.Y()])
        best = np.inf
        # First toward the place beside q; where the outline runs along the sight, at a cusp, to any place nearby.
        for beside in (True, False):
            best = min(best, self._search(at, q, way, beside))
            if best < self._enough:
                break
        return best

    def _search(self, at: Floats, q: Floats, way: Floats, beside: bool) -> float:
        """The least error among the edge-on places that Newton's method comes by; steps that lead astray are halved."""
        best, least, step = np.inf, np.inf, np.zeros(2)
        for _ in range(ITERATIONS):
            try:
                point, (su, sv, suu, svv, suv) = self._jet(at)
            except Exception:  # OpenCASCADE's exceptions derive from Exception alone
                return best
            normal = np.cross(su, sv)
            sight = self._paper.sight(point[None])[0]
            size = float(np.linalg.norm(normal) * np.linalg.norm(sight))
            if not size > 0.0:
                return best
            slope = [np.cross(suu, sv) + np.cross(su, suv), np.cross(suv, sv) + np.cross(su, svv)]
            flat = self._paper.derived(np.array([[point, su, suv], [point, sv, suv]]))
            off = flat[0, 0] - q
            rows, values = [np.array(slope) @ sight / size], [float(normal @ sight) / size]
            if beside:
                rows.append(flat[:, 1] @ way / self._accuracy)
                values.append(float(off @ way) / self._accuracy)
            if abs(values[0]) < EDGE_ON:
                best = min(best, math.hypot(*off.tolist()))
            wrong = math.hypot(*values) if beside else abs(values[0])
            if wrong > least:
                step = 0.5 * step
                at = at + step
                continue
            least = wrong
            step = _least(np.array(rows), np.array(values))
            moved = float(np.linalg.norm(su * step[0] + sv * step[1]))
            if not moved > 0.0 or not np.isfinite(moved):
                return best
            step = step * min(1.0, self._most / moved)
            at = at - step
        return best

    def _jet(self, at: Floats) -> tuple[Floats, list[Floats]]:
        """Point and derivatives du, dv, duu, dvv, duv in the model."""
        from OCP.gp import gp_Pnt, gp_Vec

        p, d = gp_Pnt(), [gp_Vec() for _ in range(5)]
        self._surface.D2(float(at[0]), float(at[1]), p, *d)
        return self._turn @ p.Coord() + self._shift, [self._turn @ v.Coord() for v in d]


def _least(rows: Floats, values: Floats) -> Floats:
    """The shortest x (2,) with rows (k, 2) . x = values (k,), k 1 or 2; NaN where there is none."""
    with np.errstate(all="ignore"):
        if len(rows) == 1:
            return np.asarray(rows[0] * (values[0] / (rows[0] @ rows[0])))
        (a, b), (c, d) = rows
        return np.asarray(np.array([d * values[0] - b * values[1], a * values[1] - c * values[0]]) / (a * d - b * c))


def _to_folds(opened: Any, drawing: Drawing, paper: Paper, q: Floats, line: Index, threads: int) -> Floats:
    """(n,) distance to the nearest edge of each outline's face."""
    edges: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for number in np.unique(line).tolist():
        of = drawing.lines[number]
        key = of.part, of.face or 0
        if key not in edges:
            edges[key] = [(of.part, e) for e in opened.face_edges(drawing.parts[of.part].name, key[1])]
    true = TrueEdges(opened, drawing, sorted({e for those in edges.values() for e in those}), paper)
    best = np.full(len(q), np.inf)
    keys = [(drawing.lines[i].part, drawing.lines[i].face or 0) for i in line.tolist()]
    for key, own in edges.items():
        mine = np.array([i for i, k in enumerate(keys) if k == key], np.int64)
        for edge in own:
            which = np.full(len(mine), true.number[edge], np.int32)
            best[mine] = np.minimum(best[mine], true.distance(q[mine], which, threads)[0])
    return best


__all__: Sequence[str] = ["outline_errors"]
