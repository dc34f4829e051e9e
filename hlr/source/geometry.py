"""The curves of B-rep edges as flat records that the kernel evaluates without OpenCASCADE.

All curves are affine forms, so that a placement, a mirror image or a scale moves their vectors and nothing else:

    LINE        p + t a                        p, a, 0
    ELLIPSE     p + cos t a + sin t b          p, a, b; circles as well
    PARABOLA    p + t^2 a + t b                p, a, b
    HYPERBOLA   p + cosh t a + sinh t b        p, a, b
    SPLINE      B-spline                       degree, poles, rational, flat knots, then x y z w per pole;
                                               rational 2: places of another curve, which it follows closely

Bezier curves become B-splines, periodic B-splines are unrolled as far as the edge goes, offset curves are approximated.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.source.locations import moved
from hlr.source.model import Curves

NONE, LINE, ELLIPSE, PARABOLA, HYPERBOLA, SPLINE = range(6)

APPROXIMATION = 1e-6
"""Model units: how closely curves of other kinds are approximated."""

MOST_SEGMENTS, MOST_DEGREE = 500, 8
"""Of such an approximation; a curve that needs more stays unknown."""


Record = tuple[int, float, float, Floats]
"""(kind, first, last, values) of one curve."""

UNKNOWN: Record = (NONE, 0.0, 0.0, np.zeros(0))


def starts(counts: Ints | list[int]) -> Ints:
    """(n+1,) running sums from 0: where each of n consecutive groups begins."""
    result = np.zeros(len(counts) + 1, dtype=np.int64)
    np.cumsum(counts, out=result[1:])
    if result[-1] >= 2**31:
        raise MemoryError("more than 2^31 items in one table")
    return result.astype(np.int32)


def packed(records: Sequence[Record]) -> Curves:
    """Records of single curves as one."""
    return Curves(
        kind=np.array([r[0] for r in records], np.uint8),
        range=np.array([(r[1], r[2]) for r in records], np.float64).reshape(-1, 2),
        offsets=starts([len(r[3]) for r in records]),
        values=np.concatenate([np.zeros(0), *[r[3] for r in records]]),
    )


def together(one: Curves, other: Curves) -> Curves:
    """The records of one, then those of the other."""
    return Curves(
        kind=np.concatenate([one.kind, other.kind]),
        range=np.concatenate([one.range, other.range]),
        offsets=np.concatenate([one.offsets, other.offsets[1:] + one.offsets[-1]]).astype(np.int32),
        values=np.concatenate([one.values, other.values]),
    )


def edge_record(edge: Any) -> Record:
    """The record of a TopoDS_Edge where it stands; UNKNOWN where it has no curve in space."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    try:
        adaptor = BRepAdaptor_Curve(edge)
        if not adaptor.Is3DCurve():
            return UNKNOWN
        record = curve_record(adaptor.Curve().Curve(), adaptor.FirstParameter(), adaptor.LastParameter())
        move = adaptor.Trsf()
    except Exception:  # OpenCASCADE's exceptions derive from Exception alone; such an edge keeps its polygon
        return UNKNOWN
    if move.Form().value == 0:  # gp_Identity
        return record
    return moved_record(record, np.array([[move.Value(i, j) for j in range(1, 5)] for i in range(1, 4)]))


def moved_record(record: Record, matrix: Floats) -> Record:
    """A record moved by a (3, 4) or (4, 4) matrix."""
    kind, first, last, values = record
    if kind == NONE:
        return record
    result = values.copy()
    if kind == SPLINE:
        poles = result[-4 * int(values[1]) :].reshape(-1, 4)
        poles[:, :3] = moved(poles[:, :3], matrix)
    else:
        turn = np.array(matrix[:3, :4])
        turn[:, 3] = 0.0
        result[:3] = moved(values[None, :3], matrix)[0]
        result[3:] = moved(values[3:].reshape(2, 3), turn).ravel()
    return kind, first, last, result


def curve_record(curve: Any, first: float, last: float) -> Record:
    """The record of a Geom_Curve between two parameters; UNKNOWN where it is of no known kind."""
    name = type(curve).__name__
    while name == "Geom_TrimmedCurve":
        curve = curve.BasisCurve()
        name = type(curve).__name__
    if name == "Geom_Line":
        frame = curve.Position()
        return _conic(LINE, first, last, frame.Location(), (1.0, frame.Direction()), (0.0, frame.Direction()))
    if name in ("Geom_Circle", "Geom_Ellipse", "Geom_Hyperbola", "Geom_Parabola"):
        place = curve.Position()
        centre, x, y = place.Location(), place.XDirection(), place.YDirection()
        if name == "Geom_Circle":
            return _conic(ELLIPSE, first, last, centre, (curve.Radius(), x), (curve.Radius(), y))
        if name == "Geom_Parabola":
            return _conic(PARABOLA, first, last, centre, (0.25 / curve.Focal(), x), (1.0, y))
        kind = ELLIPSE if name == "Geom_Ellipse" else HYPERBOLA
        return _conic(kind, first, last, centre, (curve.MajorRadius(), x), (curve.MinorRadius(), y))
    if name == "Geom_BSplineCurve":
        knots = np.array([curve.Knot(i) for i in range(1, curve.NbKnots() + 1)])
        multiplicities = [curve.Multiplicity(i) for i in range(1, curve.NbKnots() + 1)]
        return spline(curve.Degree(), knots, np.array(multiplicities), _poles(curve), curve.IsPeriodic(), first, last)
    if name == "Geom_BezierCurve":
        ends = np.array([curve.Degree() + 1] * 2)
        return spline(curve.Degree(), np.array([0.0, 1.0]), ends, _poles(curve), False, first, last)
    return _approximated(curve, first, last)


def _conic(kind: int, first: float, last: float, origin: Any, a: tuple[float, Any], b: tuple[float, Any]) -> Record:
    values = [origin.X(), origin.Y(), origin.Z()]
    for size, direction in (a, b):
        values += [size * direction.X(), size * direction.Y(), size * direction.Z()]
    return kind, first, last, np.array(values)


def _poles(curve: Any) -> Floats:
    """(n, 4) x, y, z, weight."""
    count = curve.NbPoles()
    poles = np.ones((count, 4))
    poles[:, :3] = [curve.Pole(i).Coord() for i in range(1, count + 1)]
    if curve.IsRational():
        poles[:, 3] = [curve.Weight(i) for i in range(1, count + 1)]
    return poles


def spline(
    degree: int,
    knots: Floats,
    multiplicities: npt.NDArray[Any],
    poles: Floats,
    periodic: bool,
    first: float,
    last: float,
) -> Record:
    """The record of a B-spline as OpenCASCADE keeps it: distinct knots and their multiplicities."""
    flat = np.repeat(knots, multiplicities)
    if periodic:
        flat, poles = _unrolled(degree, flat, int(multiplicities[0]), poles, knots[-1] - knots[0], first, last)
    rational = bool((poles[:, 3] != poles[0, 3]).any())
    if not rational:
        poles[:, 3] = 1.0
    values = np.concatenate(([degree, len(poles), rational], flat, poles.ravel()))
    return SPLINE, first, last, values


def _unrolled(
    degree: int, flat: Floats, begin: int, poles: Floats, period: float, first: float, last: float
) -> tuple[Floats, Floats]:
    """Flat knots and poles of a periodic B-spline, repeated as far as first..last goes.

    begin: how often the first knot stands there. One period is `flat` without the last knot's copies.
    """
    count = len(poles)
    ring = flat[:count]
    low = int(np.floor((first - ring[0]) / period)) - 1
    high = int(np.ceil((last - ring[0]) / period)) + 1
    turns = np.arange(low, high + 1)
    long = (ring[None, :] + turns[:, None] * period).ravel()
    # The span after the last copy of the first knot is that of poles 0..degree.
    shift = degree + 1 - begin
    many = len(long) - degree - 1
    index = np.arange(many) + shift
    return long, poles[index % count].copy()


def _approximated(curve: Any, first: float, last: float) -> Record:
    from OCP.Geom import Geom_TrimmedCurve
    from OCP.GeomAbs import GeomAbs_Shape
    from OCP.GeomConvert import GeomConvert_ApproxCurve

    part = Geom_TrimmedCurve(curve, first, last)
    found = GeomConvert_ApproxCurve(part, APPROXIMATION, GeomAbs_Shape.GeomAbs_C1, MOST_SEGMENTS, MOST_DEGREE)
    if not found.HasResult() or found.MaxError() > 10.0 * APPROXIMATION:
        return UNKNOWN
    result = found.Curve()
    return curve_record(result, result.FirstParameter(), result.LastParameter())


def evaluated(curves: Curves, which: Ints, parameters: Floats) -> Floats:
    """(m, 3, 3) point, first and second derivative of the curves `which` (m,) at `parameters` (m,)."""
    from hlr import _kernel

    return _kernel.curve_points(
        _kernel.Curves(curves.kind, np.ascontiguousarray(curves.range), curves.offsets, curves.values),
        np.ascontiguousarray(which, np.int32),
        np.ascontiguousarray(parameters, np.float64),
    )
