"""Distance of written outlines from the silhouette of the true surface, by OpenCASCADE's evaluation.

A point q of a written outline is projected onto the surface of its face. The surface point is then moved until

    g(u, v) = N . V = 0          the surface is seen edge-on
    h(u, v) = (p - q) . t = 0    its image p on paper is beside q, at a right angle to the line's direction t

by Newton's method, with the shortest step that solves the linear system. |p - q| is then the error: never less than the
distance to the true outline. Where the face folds along one of its edges, that edge is the true outline.

::

           true outline  ----------p---------
                                   |  error
           written       ----------q-----> t
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.chords import Index
from hlr.drawing.drawing import Drawing
from hlr.lab.measure.edges import TrueEdges
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.written import Written, in_model
from hlr.request.accuracy import MEASURED_RETRY, MEASURED_STEP

ITERATIONS = 30
EDGE_ON = 1e-9
"""|N . V| of unit vectors below which a point counts as edge-on."""
FARTHER = tuple(side * 2**k for k in range(7) for side in (1, -1))
"""Where a search begins anew, in longest steps along the line of sight toward the viewer."""
SETTLED = 1e-13
"""Steps and remainders below which a search has ended, in longest steps and accuracies."""


def outline_errors(
    opened: Any, drawing: Drawing, drawn: Written, paper: Paper, samples: int
) -> tuple[Floats, list[str]]:
    """(n,) error, mm on paper, of points of written outlines, about `samples` at most; and the names of their lines."""
    wanted = np.array([x.kind == "outline" and x.face is not None for x in drawing.lines], bool)
    mine = np.flatnonzero(wanted[drawn.line])
    mine = mine[:: max(1, len(mine) // max(samples, 1))]
    if len(mine) == 0:
        return np.zeros(0), []
    q, line = drawn.points[mine], drawn.line[mine]
    way = _directions(drawn, mine)
    near = in_model(drawing, q, line)
    accuracy = drawing.accuracy.used
    faces: dict[tuple[int, int], list[int]] = defaultdict(list)
    for i, number in enumerate(line.tolist()):
        of = drawing.lines[number]
        faces[of.part, of.face or 0].append(i)
    off = np.full(len(mine), np.inf)
    for (part, face), those in faces.items():
        of = drawing.parts[part]
        judge = _Face(opened.face_shape(of.name, face), of.transform, paper, accuracy)
        off[those] = judge.errors(near[those], q[those], way[those])
    far = np.flatnonzero(off > MEASURED_RETRY * accuracy)
    if len(far):
        off[far] = np.minimum(off[far], _to_folds(opened, drawing, paper, q[far], line[far]))
    names = [f"{drawing.parts[drawing.lines[i].part].name}, outline of face {drawing.lines[i].face}" for i in line]
    return off, names


def _directions(drawn: Written, which: Index) -> Floats:
    """(n, 2) unit vectors along the lines at the points `which` (n,)."""
    last = len(drawn.points) - 1
    after = np.minimum(which + 1, last)
    before = np.maximum(which - 1, 0)
    after = np.where(drawn.line[after] == drawn.line[which], after, which)
    before = np.where(drawn.line[before] == drawn.line[which], before, which)
    way = drawn.points[after] - drawn.points[before]
    size = np.hypot(way[:, 0], way[:, 1])[:, None]
    return np.asarray(np.divide(way, size, out=np.zeros_like(way), where=size > 0.0))


class _Face:
    """One face's surface, with the placement of its part."""

    def __init__(self, face: Any, transform: Floats, paper: Paper, accuracy: float) -> None:
        from OCP.BRep import BRep_Tool
        from OCP.ShapeAnalysis import ShapeAnalysis_Surface

        self._surface = BRep_Tool.Surface_s(face)
        self._find = ShapeAnalysis_Surface(self._surface)
        self._turn, self._shift = transform[:3, :3], transform[:3, 3]
        self._back = np.linalg.inv(self._turn)
        self._paper = paper
        self._most = MEASURED_STEP * accuracy / paper.per_model
        self._enough = MEASURED_RETRY * accuracy
        self._accuracy = accuracy

    def errors(self, near: Floats, q: Floats, way: Floats) -> Floats:
        """(n,) distance, mm, on paper from q (n, 2) to the edge-on points beside them; infinity where none is found."""
        from OCP.gp import gp_Pnt

        start = [self._find.ValueOfUV(gp_Pnt(*p), 1e-9) for p in ((near - self._shift) @ self._back.T).tolist()]
        at = np.array([(p.X(), p.Y()) for p in start])
        # Search beside q first. At a cusp, where the outline runs along the line of sight, search in all directions.
        best = self._search(at, q, way, True)
        again = np.flatnonzero(best > self._enough)
        best[again] = np.minimum(best[again], self._search(at[again], q[again], way[again], False))
        # Where the surface is nearly edge-on over a long way, |g| may be least at a place that is none. Search from
        # farther along the line of sight.
        for steps in FARTHER:
            again = np.flatnonzero(best > self._enough)
            if len(again) == 0:
                break
            start = at[again] + steps * self._most * self._along_sight(at[again])
            best[again] = np.fmin(best[again], self._search(start, q[again], way[again], True))
        return best

    def _along_sight(self, at: Floats) -> Floats:
        """(n, 2) steps of u and v per length in the model along the line of sight, projected into the tangent plane."""
        point, su, sv, *_ = self._jets(at).transpose(1, 0, 2)
        sight = self._paper.sight(point)
        with np.errstate(all="ignore"):
            rows = np.stack([np.stack([dot(a, b) for b in (su, sv)], axis=1) for a in (su, sv)], axis=1)
            right = np.stack([dot(su, sight), dot(sv, sight)], axis=1) / np.sqrt(dot(sight, sight))[:, None]
            return _least(rows, right, True)

    def _search(self, start: Floats, q: Floats, way: Floats, beside: bool) -> Floats:
        """(n,) the least errors at edge-on points that Newton's method reaches; steps that make it worse are halved.

        Worse is what would take a longer step still, by the derivatives before the step (P. Deuflhard, "Newton Methods
        for Nonlinear Problems", 2004: natural monotonicity). Sizes of g and h themselves do not compare: where two
        branches of an outline meet, g grows only with the product of the distances from both.
        """
        n = len(q)
        best, going = np.full(n, np.inf), np.arange(n)
        at, step = start.copy(), np.zeros((n, 2))
        # Of the last place that was no worse: derivatives, lengths of du and dv, and the length of the step from there.
        before, speed, least = np.full((n, 2, 2), np.nan), np.ones((n, 2)), np.full(n, np.inf)
        for _ in range(ITERATIONS):
            if len(going) == 0:
                break
            jet = self._jets(at[going])
            point, su, sv, suu, svv, suv = (jet[:, k] for k in range(6))
            sight = self._paper.sight(point)
            normal = cross(su, sv)
            with np.errstate(all="ignore"):
                size = np.sqrt(dot(normal, normal) * dot(sight, sight))
                g = dot(normal, sight) / size
                rows = np.empty((len(going), 2, 2))
                rows[:, 0, 0] = dot(cross(suu, sv) + cross(su, suv), sight) / size
                rows[:, 0, 1] = dot(cross(suv, sv) + cross(su, svv), sight) / size
                along = [self._paper.derived(np.stack([point, s, suv], axis=1)) for s in (su, sv)]
                off = along[0][:, 0] - q[going]
                value = np.stack([g, dot(off, way[going]) / self._accuracy], axis=1)
                for k in (0, 1):
                    rows[:, 1, k] = dot(along[k][:, 1], way[going]) / self._accuracy
                found = np.where(np.abs(g) < EDGE_ON, np.sqrt(dot(off, off)), np.inf)
                best[going] = np.fmin(best[going], found)
                wrong = np.sqrt(dot(value, value)) if beside else np.abs(g)
                still = _least(before[going], value, beside) * speed[going]
                astray = np.sqrt(dot(still, still)) > least[going]
                new = _least(rows, value, beside)
                speeds = np.sqrt(np.stack([dot(su, su), dot(sv, sv)], axis=1))
                moved = np.sqrt(dot(su * new[:, :1] + sv * new[:, 1:], su * new[:, :1] + sv * new[:, 1:]))
                full = np.sqrt(dot(new * speeds, new * speeds))
                new *= np.minimum(1.0, self._most / moved)[:, None]
            # Go back by half of the last step, or make a new step.
            step[going] = np.where(astray[:, None], 0.5 * step[going], new)
            move = np.where(astray[:, None], step[going], -step[going])
            kept = going[~astray]
            before[kept], speed[kept], least[kept] = rows[~astray], speeds[~astray], full[~astray]
            settled = ~np.isfinite(moved) | (~astray & ((wrong < SETTLED) | (moved < SETTLED * self._most)))
            going, move = going[~settled], move[~settled]
            at[going] += move
        return best

    def _jets(self, at: Floats) -> Floats:
        """(n, 6, 3) points and derivatives du, dv, duu, dvv, duv in the model; NaN where they do not exist."""
        from OCP.gp import gp_Pnt, gp_Vec

        p, d = gp_Pnt(), [gp_Vec() for _ in range(5)]
        out = np.full((len(at), 6, 3), np.nan)
        with suppress(Exception):  # OpenCASCADE's exceptions derive from Exception alone
            for i, (u, v) in enumerate(at.tolist()):
                self._surface.D2(u, v, p, *d)
                out[i] = [p.Coord(), *[w.Coord() for w in d]]
        moved = np.asarray(np.einsum("ij,nkj->nki", self._turn, out))
        moved[:, 0] += self._shift
        return np.asarray(moved, np.float64)


def dot(a: Floats, b: Floats) -> Floats:
    """Dot product row by row."""
    return np.asarray((a * b).sum(axis=1))


def cross(a: Floats, b: Floats) -> Floats:
    """Cross product row by row."""
    x, y = a.T, b.T
    return np.stack([x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]], axis=1)


def _least(rows: Floats, values: Floats, both: bool) -> Floats:
    """(n, 2) the solutions x of rows (n, 2, 2) . x = values (n, 2); or the shortest x that solves the first row."""
    a, b, c, d = rows[:, 0, 0], rows[:, 0, 1], rows[:, 1, 0], rows[:, 1, 1]
    g, h = values.T
    if not both:
        return np.asarray(np.stack([a, b], axis=1) * (g / (a * a + b * b))[:, None])
    return np.asarray(np.stack([d * g - b * h, a * h - c * g], axis=1) / (a * d - b * c)[:, None])


def _to_folds(opened: Any, drawing: Drawing, paper: Paper, q: Floats, line: Index) -> Floats:
    """(n,) distance of q (n, 2), mm on paper, to the nearest edge of the outline's face."""
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
            best[mine] = np.minimum(best[mine], true.distance(q[mine], which)[0])
    return best


__all__: Sequence[str] = ["outline_errors"]
