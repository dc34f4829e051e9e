"""Distance of written curves from the true curves of the model's edges, projected.

The curve of an edge is taken from its record. The record is checked against OpenCASCADE's own evaluation, and the
difference of the two is added to the distance. The nearest point is found by Newton's method on paper, from the nearest
chord of a dense polyline. A wrong start makes the distance larger, never smaller.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.drawing.drawing import Drawing
from hlr.lab.measure.occt_curves import edge_record, evaluate_curves, transform_record
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.written import Written
from hlr.request.accuracy import MEASURED_EDGE_CHORD
from hlr.source.curve_records import NONE, SPLINE, UNKNOWN, Record, pack_curves
from hlr.source.model import Curves
from hlr.source.transforms import transform_points

Edge = tuple[int, int]
"""A part of the drawing, and the index of an edge in it."""

CHORDS = 96
"""Chords per edge; a spline has a twelfth of them per span, if that is more."""
MOST_FINER = 64
"""Largest factor by which the number of chords is raised above `CHORDS`."""
CHECKS = 9
"""Number of points at which a record is compared with OpenCASCADE."""
FREE = 2000
"""Number of points of an edge whose curve has no record."""
ITERATIONS = 12


class TrueEdges:
    """The true curves of k edges, to measure distances to.

    known (k,) bool: the edge has a curve in space
    """

    def __init__(self, opened: Any, drawing: Drawing, edges: Sequence[Edge], paper: Paper) -> None:
        self._paper = paper
        self.number = {edge: i for i, edge in enumerate(edges)}
        records, self._off, chords, owner, spans = [], np.zeros(len(edges)), [], [], []
        for i, (part, index) in enumerate(edges):
            of = drawing.parts[part]
            shape = opened.edge_shape(of.name, index)
            record = transform_record(edge_record(shape), of.transform)
            records.append(record)
            places = _places(record)
            truth = _evaluated(shape, of.transform, record)
            if record[0] == NONE or len(truth) == 0:
                record = records[-1] = UNKNOWN
                points, ends = truth, np.full((max(len(truth) - 1, 0), 2), np.nan)
            else:
                curve = pack_curves([record])
                here = evaluate_curves(curve, np.zeros(CHECKS, np.int32), np.linspace(*record[1:3], CHECKS))[:, 0]
                off = np.linalg.norm(here - truth, axis=1) * paper.magnified(here)
                self._off[i] = float(np.fmax.reduce(off, initial=0.0))
                points = evaluate_curves(curve, np.zeros(len(places), np.int32), places)[:, 0]
                finer = _finer(paper(points), MEASURED_EDGE_CHORD * drawing.accuracy.used)
                if finer > 1:
                    places = np.linspace(places[0], places[-1], (len(places) - 1) * finer + 1)
                    points = evaluate_curves(curve, np.zeros(len(places), np.int32), places)[:, 0]
                ends = np.stack([places[:-1], places[1:]], axis=1)
            segments, shares = paper.chords(points[:-1], points[1:])
            ends = np.where(np.isfinite(shares), ends[:, :1] + shares * (ends[:, 1:] - ends[:, :1]), ends)
            # Points behind the eye have no image on paper.
            good = np.isfinite(segments).all(axis=1)
            chords.append(segments[good])
            spans.append(ends[good])
            owner.append(np.full(int(good.sum()), i, np.int32))
        self._curves: Curves = pack_curves(records)
        self.chords: Floats = np.concatenate(chords) if chords else np.zeros((0, 4))
        self.owner: Ints = np.concatenate(owner) if owner else np.zeros(0, np.int32)
        self._spans: Floats = np.concatenate(spans) if spans else np.zeros((0, 2))

    def distance(self, points: Floats, which: Ints) -> tuple[Floats, Floats]:
        """(n,) distance of points (n, 2) on paper to the curves of edges `which` (n,), mm; and the parameter (n,)."""
        near, chord = _kernel.nearest(
            np.ascontiguousarray(points),
            np.ascontiguousarray(which, np.int32),
            self.chords,
            self.owner,
            np.inf,
        )
        best, t = near.copy(), np.full(len(points), np.nan)
        exact = np.flatnonzero((chord >= 0) & (self._curves.kind[which] != NONE))
        if len(exact):
            a, b, t0 = self.chords[chord[exact], :2], self.chords[chord[exact], 2:], self._spans[chord[exact]]
            way, q = b - a, points[exact]
            with np.errstate(all="ignore"):
                s = np.clip(np.nan_to_num(((q - a) * way).sum(axis=1) / (way * way).sum(axis=1)), 0.0, 1.0)
            best[exact], t[exact] = self._newton(q, which[exact], t0[:, 0] + s * (t0[:, 1] - t0[:, 0]))
        return best + self._off[which], t

    def _newton(self, points: Floats, which: Ints, start: Floats) -> tuple[Floats, Floats]:
        """The least distances (n,) that Newton's method finds, and their parameters (n,)."""
        low, high = self._curves.range[which].T
        low, high = np.minimum(low, high), np.maximum(low, high)
        t, best, at = start, np.full(len(points), np.inf), start
        for _ in range(ITERATIONS):
            p = self._paper.derived(evaluate_curves(self._curves, which, t))
            off = p[:, 0] - points
            found = np.hypot(off[:, 0], off[:, 1])
            better = found < best
            best, at = np.where(better, found, best), np.where(better, t, at)
            slope = (p[:, 1] * p[:, 1]).sum(axis=1)
            full = slope + (off * p[:, 2]).sum(axis=1)
            with np.errstate(all="ignore"):
                step = (off * p[:, 1]).sum(axis=1) / np.where(full > 0.1 * slope, full, slope)
            t = np.clip(t - np.nan_to_num(step, nan=0.0, posinf=0.0, neginf=0.0), low, high)
        return best, at


def _places(record: Record) -> Floats:
    kind, first, last, values = record
    spans = int(values[1]) - int(values[0]) if kind == SPLINE else 1
    return np.linspace(first, last, max(CHORDS, CHORDS // 12 * spans) + 1)


def _finer(flat: Floats, close: float) -> int:
    """By what factor to increase the number of points (n, 2), so that their chords are within `close` of the curve.

    Where a curve crosses itself on paper, a search that starts on a coarser chord could end on the other branch.
    """
    bulge = np.hypot(*(flat[:-2] - 2.0 * flat[1:-1] + flat[2:]).T) / 8.0
    worst = float(bulge[np.isfinite(bulge)].max(initial=0.0))
    return int(min(np.ceil(np.sqrt(worst / close)), MOST_FINER))


def _evaluated(shape: Any, transform: Floats, record: Record) -> Floats:
    """OpenCASCADE's points along an edge: few to check a record, many without one; none if it has no curve."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    try:
        adaptor = BRepAdaptor_Curve(shape)
        first, last = (adaptor.FirstParameter(), adaptor.LastParameter()) if record[0] == NONE else record[1:3]
        count = FREE if record[0] == NONE else CHECKS
        values = [adaptor.Value(float(t)) for t in np.linspace(first, last, count)]
    except Exception:  # OpenCASCADE's exceptions derive from Exception alone
        return np.zeros((0, 3))
    return transform_points(np.array([(p.X(), p.Y(), p.Z()) for p in values]), transform)


def edge_errors(true: TrueEdges, drawing: Drawing, drawn: Sequence[Written]) -> tuple[Floats, list[str]]:
    """(n,) the largest distance, mm on paper, of each line of an edge in each written form, and the lines' names."""
    values: list[Floats] = []
    names: list[str] = []
    number = np.array(
        [-1 if x.edge is None else true.number.get((x.part, x.edge), -1) for x in drawing.lines], np.int32
    )
    for form in drawn:
        mine = np.flatnonzero(number[form.line] >= 0)
        line = form.line[mine]
        off, _ = true.distance(form.points[mine], number[line])
        # Edges without a curve in space, and points behind the eye, cannot be measured.
        mine, line, off = mine[np.isfinite(off)], line[np.isfinite(off)], off[np.isfinite(off)]
        first = np.flatnonzero(np.append(True, line[1:] != line[:-1])[: len(line)])
        values.append(np.maximum.reduceat(off, first) if len(off) else off)
        names += [_name(drawing, i) for i in line[first].tolist()]
    return (np.concatenate(values) if values else np.zeros(0)), names


def _name(drawing: Drawing, line: int) -> str:
    of = drawing.lines[line]
    return f"{drawing.parts[of.part].name}, edge {of.edge}"
