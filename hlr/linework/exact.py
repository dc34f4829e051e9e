"""Lines of B-rep edges as intervals of their edges' true curves; rims of meshes as intervals of circles.

The visibility pass works on mesh edges. What it found stays what decides: each polyline becomes the interval of its
edge's curve between its two ends, on paper an arc, a chain of Bezier curves or a straight line.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.curve import Arc, Bezier, Curve
from hlr.source.geometry import evaluated, packed, together
from hlr.source.model import Curves, EdgeCurves, Floats, Ints
from hlr.tolerance import CLOSED, CURVE_CHORD, Tolerances
from hlr.view.camera import Camera, Vector

EdgeCurveLookup = Callable[[Ints, Ints], EdgeCurves] | None
"""The curves of edges, given their parts and indices; None where the source has none."""

POLYLINE, STRAIGHT, ARC, QUADRATIC, CUBIC = range(5)
"""Forms of lines, as the kernel names them."""

NO_CURVES = packed([])

Row = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Loose:
    """Curves that belong to no edge of a B-rep, and lie where they are: outlines of true surfaces, circles of meshes.

    curves: n records; number (lines,) of each line's own, -1 for none
    bulge (n,): the most that a curve rises above the chords that it was found on, millimetres on paper; the points of
    what rises are its own, not those of its chords
    """

    curves: Curves
    number: Ints
    bulge: Floats


@dataclass(frozen=True, slots=True)
class DrawnLines:
    """Lines on paper: polylines, and what they are exactly.

    offsets (n+1,) into flat (.., 2) and space (.., 3); form (n,); data_offsets (n+1,) into data; bounds (n, 2, 2)
    """

    offsets: Ints
    flat: Floats
    space: Floats
    form: Ints
    data_offsets: Ints
    data: Floats
    bounds: Floats

    def low(self, keep: npt.NDArray[Any]) -> Floats:
        """(2,) lower left corner of some of the lines."""
        corner: Floats = self.bounds[keep, 0].min(axis=0)
        return corner

    def curves(self, low: Floats) -> dict[int, Curve]:
        """The curves of lines that have one, by line, with `low` as origin."""
        result: dict[int, Curve] = {}
        form, start = self.form, self.data_offsets.tolist()
        for i in np.flatnonzero(form == ARC).tolist():
            values = self.data[start[i] : start[i + 1]]
            result[i] = Arc(values[:2] - low, values[2:6].reshape(2, 2), values[6:8])
        for i in np.flatnonzero(form >= QUADRATIC).tolist():
            values = self.data[start[i] : start[i + 1]]
            result[i] = Bezier(2 if form[i] == QUADRATIC else 3, values.reshape(-1, 2) - low)
        return result


def on_curves(
    offsets: Ints,
    flat: Floats,
    space: Floats,
    part: Ints,
    edge: Ints,
    loose: Loose,
    chain: Ints,
    visible: npt.NDArray[np.bool_],
    border: npt.NDArray[np.uint8],
    edge_curves: EdgeCurveLookup,
    camera: Camera,
    per_model: float,
    tolerances: Tolerances,
    threads: int,
) -> DrawnLines:
    """Lines (n) with points flat and space [offsets[i]:offsets[i + 1]], of edges of parts (n,), or on loose curves.

    edge (n,): -1 for none; border (n,): 1 where others may disappear behind an edge, 2 behind an outline
    """
    which, place = np.full(len(edge), -1, np.int32), np.zeros(len(edge), np.int32)
    curves, places = NO_CURVES, np.eye(3, 4)[None]
    tied = np.flatnonzero(edge >= 0)
    if edge_curves is not None:
        found = edge_curves(part[tied], edge[tied])
        which[tied], place[tied] = found.which, found.place
        curves, places = found.curves, np.concatenate([found.places, places])
    # Loose ones lie where they are: no place moves them.
    own = np.flatnonzero((edge < 0) & (loose.number >= 0))
    which[own], place[own] = loose.number[own] + len(curves.kind), len(places) - 1
    bulge = np.zeros(len(edge))
    bulge[own] = loose.bulge[loose.number[own]]
    curves = together(curves, loose.curves)
    drawn = _kernel.true_lines(
        curves.kind,
        np.ascontiguousarray(curves.range),
        curves.offsets,
        curves.values,
        np.ascontiguousarray(places),
        projection(camera, per_model),
        which,
        place,
        offsets,
        flat,
        space,
        chain,
        visible,
        border,
        bulge,
        camera.eye or (0.0, 0.0, 0.0),
        (-camera.direction[0], -camera.direction[1], -camera.direction[2]),
        tolerances.accuracy,
        CLOSED * tolerances.accuracy / per_model,
        tolerances.contact,
        threads,
    )
    form = drawn["form"].astype(np.int32)
    offsets, flat, space = _with_true_ends(offsets, flat, space, drawn["inner"], drawn["flat"], drawn["space"])
    risen = np.flatnonzero((bulge > 0.0) & (form != POLYLINE))
    if len(risen):
        size = per_model, tolerances.accuracy
        offsets, flat, space = _along(risen, curves, which, drawn["interval"], camera, *size, offsets, flat, space)
    return DrawnLines(offsets, flat, space, form, drawn["offsets"], drawn["data"], drawn["bounds"])


def projection(camera: Camera, per_model: float) -> tuple[Row, Row, Row]:
    """The matrix from (x, y, z, 1) in the model to (x w, y w, w) on paper, as Camera.project maps."""
    if camera.eye is None or camera.distance is None:
        right, up = (_row(v, per_model, (0.0, 0.0, 0.0)) for v in (camera.right, camera.up))
        return right, up, (0.0, 0.0, 0.0, 1.0)
    factor = camera.distance * per_model
    right, up = (_row(v, factor, camera.eye) for v in (camera.right, camera.up))
    return right, up, _row(camera.direction, -1.0, camera.eye)


def _row(v: Vector, factor: float, origin: Vector) -> Row:
    x, y, z = (c * factor for c in v)
    return x, y, z, -(x * origin[0] + y * origin[1] + z * origin[2])


def _with_true_ends(
    offsets: Ints, flat: Floats, space: Floats, inner: Ints, ends: Floats, space_ends: Floats
) -> tuple[Ints, Floats, Floats]:
    """Polylines that end where their curves do; inner (n, 2): the points between that are kept, from and to."""
    first, last = offsets[:-1], offsets[1:] - 1
    flat, space = flat.copy(), space.copy()
    for at, k in ((first, 0), (last, 1)):
        flat[at] = ends[:, k]
        space[at] = space_ends[:, k]
    place = np.arange(len(flat)) - np.repeat(first, np.diff(offsets))
    kept = np.repeat(inner, np.diff(offsets), axis=0)
    keep = (place >= kept[:, 0]) & (place < kept[:, 1])
    keep[first] = True
    keep[last] = True
    counts = np.add.reduceat(keep, first, dtype=np.int64) if len(first) else np.zeros(0, np.int64)
    result = np.zeros(len(offsets), np.int32)
    np.cumsum(counts, out=result[1:])
    return result, flat[keep], space[keep]


def _along(
    lines: npt.NDArray[np.intp],
    curves: Curves,
    which: Ints,
    interval: Floats,
    camera: Camera,
    per_model: float,
    accuracy: float,
    offsets: Ints,
    flat: Floats,
    space: Floats,
) -> tuple[Ints, Floats, Floats]:
    """The polylines, those of some lines with points along their circles, close enough for the accuracy."""
    first, last = offsets[:-1][lines], offsets[1:][lines] - 1
    bounds = np.stack([f(flat, offsets[:-1])[lines] for f in (np.maximum.reduceat, np.minimum.reduceat)])
    reach = (bounds[0] - bounds[1]).max(axis=1)
    # The chord of a step s rises by r s^2 / 8; perspective may stretch a step to twice its share.
    step = np.sqrt(8.0 * CURVE_CHORD * accuracy / reach) * (1.0 if camera.eye is None else 0.5)
    begin, end = interval[lines].T
    inner = np.ceil(np.abs(end - begin) / step).astype(np.int64)
    place = np.arange(inner.sum()) - np.repeat(np.cumsum(inner) - inner, inner) + 1
    t = np.repeat(begin, inner) + np.repeat((end - begin) / (inner + 1), inner) * place
    points = evaluated(curves, np.repeat(which[lines], inner), t)[:, 0]
    # Sorted by line and place: first points, those along the circle, last points, and all others as they are.
    line = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    keep = ~np.isin(line, lines)
    keep[first] = keep[last] = True
    rank = np.where(np.isin(np.arange(len(flat)), last), np.inf, np.arange(len(flat)) - offsets[line])
    owner = np.concatenate([line[keep], np.repeat(lines, inner)])
    order = np.lexsort((np.concatenate([rank[keep], place]), owner))
    on_paper = camera.project(points)[:, :2] * per_model
    result = np.searchsorted(owner[order], np.arange(len(offsets))).astype(np.int32)
    return result, np.concatenate([flat[keep], on_paper])[order], np.concatenate([space[keep], points])[order]


def polylines(offsets: Ints, flat: Floats, space: Floats) -> DrawnLines:
    """Lines without curves."""
    first = offsets[:-1]
    bounds = np.stack([np.minimum.reduceat(flat, first), np.maximum.reduceat(flat, first)], axis=1)
    count = len(first)
    none = np.zeros(count, np.int32)
    return DrawnLines(offsets, flat, space, none, np.zeros(count + 1, np.int32), np.zeros(0), bounds)
