"""Records of edges' curves, read through OpenCASCADE. The lab compares the kernel's records with them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.source.curve_records import ELLIPSE, HYPERBOLA, LINE, NONE, PARABOLA, SPLINE, UNKNOWN, Record
from hlr.source.model import Curves
from hlr.source.transforms import transform_points

APPROXIMATION = 1e-6
"""Model units: tolerance for curves of other kinds, which become B-splines."""


MOST_SEGMENTS, MOST_DEGREE = 500, 8
"""Limits of such a B-spline; a curve that needs more is UNKNOWN."""


def edge_record(edge: Any) -> Record:
    """The record of a TopoDS_Edge with its placement; UNKNOWN where it has no 3-D curve."""
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
    return transform_record(record, np.array([[move.Value(i, j) for j in range(1, 5)] for i in range(1, 4)]))


def transform_record(record: Record, matrix: Floats) -> Record:
    """A record transformed by a (3, 4) or (4, 4) matrix."""
    kind, first, last, values = record
    if kind == NONE:
        return record
    result = values.copy()
    if kind == SPLINE:
        poles = result[-4 * int(values[1]) :].reshape(-1, 4)
        poles[:, :3] = transform_points(poles[:, :3], matrix)
    else:
        turn = np.array(matrix[:3, :4])
        turn[:, 3] = 0.0
        result[:3] = transform_points(values[None, :3], matrix)[0]
        result[3:] = transform_points(values[3:].reshape(2, 3), turn).ravel()
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
        return spline_record(
            curve.Degree(), knots, np.array(multiplicities), _poles(curve), curve.IsPeriodic(), first, last
        )
    if name == "Geom_BezierCurve":
        ends = np.array([curve.Degree() + 1] * 2)
        return spline_record(curve.Degree(), np.array([0.0, 1.0]), ends, _poles(curve), False, first, last)
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


def spline_record(
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
    """Flat knots and poles of a periodic B-spline, repeated to cover the parameters first..last.

    begin: the multiplicity of the first knot. One period is `flat` without the copies of the last knot.
    """
    count = len(poles)
    ring = flat[:count]
    low = int(np.floor((first - ring[0]) / period)) - 1
    high = int(np.ceil((last - ring[0]) / period)) + 1
    turns = np.arange(low, high + 1)
    long = (ring[None, :] + turns[:, None] * period).ravel()
    # The span after the last copy of the first knot depends on the poles 0..degree.
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


def evaluate_curves(curves: Curves, which: Ints, parameters: Floats) -> Floats:
    """(m, 3, 3) point, first and second derivative of the curves `which` (m,) at `parameters` (m,)."""
    from hlr import _kernel

    return _kernel.curve_points(
        _kernel.Curves(curves.kind, np.ascontiguousarray(curves.range), curves.offsets, curves.values),
        np.ascontiguousarray(which, np.int32),
        np.ascontiguousarray(parameters, np.float64),
    )
