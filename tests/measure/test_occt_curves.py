"""Curve records against OpenCASCADE's own evaluation."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from hlr.lab.measure.occt_curves import curve_record, edge_record, evaluate_curves, transform_record
from hlr.source.curve_records import ELLIPSE, LINE, NONE, SPLINE, UNKNOWN, pack_curves
from hlr.source.transforms import transform_points

pytest.importorskip("OCP")


def _frame() -> Any:
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    return gp_Ax2(gp_Pnt(1, -2, 3), gp_Dir(1, 2, 2), gp_Dir(2, -2, 1))


def _spline(rational: bool, periodic: bool, degree: int = 3, multiplicity: int = 1) -> Any:
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt
    from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

    knots = [0.0, 1.0, 2.5, 3.0, 4.5, 6.0]
    multiplicities = [multiplicity] * 6 if periodic else [degree + 1, *[multiplicity] * 4, degree + 1]
    count = sum(multiplicities) - (multiplicity if periodic else degree + 1)
    poles, weights = TColgp_Array1OfPnt(1, count), TColStd_Array1OfReal(1, count)
    for i in range(count):
        angle = 2.0 * math.pi * i / count
        poles.SetValue(i + 1, gp_Pnt(5 * math.cos(angle), 4 * math.sin(angle), i % 3))
        weights.SetValue(i + 1, 1.0 + 0.3 * (i % 2) if rational else 1.0)
    k, m = TColStd_Array1OfReal(1, 6), TColStd_Array1OfInteger(1, 6)
    for i in range(6):
        k.SetValue(i + 1, knots[i])
        m.SetValue(i + 1, multiplicities[i])
    return Geom_BSplineCurve(poles, weights, k, m, degree, periodic)


def _curves() -> dict[str, tuple[Any, float, float]]:
    from OCP.Geom import (
        Geom_BezierCurve,
        Geom_Circle,
        Geom_Ellipse,
        Geom_Hyperbola,
        Geom_Line,
        Geom_OffsetCurve,
        Geom_Parabola,
        Geom_TrimmedCurve,
    )
    from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt

    frame = _frame()
    poles = TColgp_Array1OfPnt(1, 5)
    for i in range(5):
        poles.SetValue(i + 1, gp_Pnt(i, i * i % 3, -i))
    return {
        "line": (Geom_Line(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 1, 0))), -2.0, 5.0),
        "circle": (Geom_Circle(frame, 4.0), 1.0, 7.0),
        "ellipse": (Geom_Ellipse(frame, 4.0, 2.5), 0.0, 2 * math.pi),
        "hyperbola": (Geom_Hyperbola(frame, 4.0, 2.5), -1.0, 1.5),
        "parabola": (Geom_Parabola(frame, 1.7), -3.0, 2.0),
        "bezier": (Geom_BezierCurve(poles), 0.2, 0.9),
        "spline": (_spline(False, False), 0.0, 6.0),
        "rational": (_spline(True, False), 0.5, 5.0),
        "periodic": (_spline(False, True), 0.0, 6.0),
        "rational periodic across its seam": (_spline(True, True), 4.0, 9.5),
        "periodic with double knots before its seam": (_spline(True, True, 4, 2), -5.0, 0.5),
        "trimmed": (Geom_TrimmedCurve(Geom_Circle(frame, 4.0), 1.0, 2.0), 1.0, 2.0),
        "offset": (Geom_OffsetCurve(Geom_Ellipse(frame, 4.0, 2.5), 0.5, gp_Dir(1, 2, 2)), 0.0, 3.0),
    }


@pytest.mark.parametrize("name", list(_curves()))
def test_a_record_runs_as_its_curve(name: str) -> None:
    from OCP.gp import gp_Pnt, gp_Vec

    curve, first, last = _curves()[name]
    curves = pack_curves([UNKNOWN, curve_record(curve, first, last)])
    kind, begin, end = int(curves.kind[1]), *curves.range[1]
    assert kind != NONE and begin == pytest.approx(first) and end == pytest.approx(last)
    parameters = np.linspace(first, last, 41)
    found = evaluate_curves(curves, np.ones(41, np.int32), parameters)
    place, one, two = gp_Pnt(), gp_Vec(), gp_Vec()
    for t, values in zip(parameters, found, strict=True):
        curve.D2(float(t), place, one, two)
        wanted = [[v.X(), v.Y(), v.Z()] for v in (place, one, two)]
        if name == "offset":  # approximated: its point only
            assert values[0] == pytest.approx(wanted[0], abs=1e-5)
        elif t in (1.0, 2.5, 3.0, 4.5):
            assert values[0] == pytest.approx(wanted[0], abs=1e-12)
        else:
            assert values == pytest.approx(np.array(wanted), abs=1e-10)
    assert np.isnan(evaluate_curves(curves, np.zeros(1, np.int32), np.zeros(1))).all()


@pytest.mark.parametrize("name", ["line", "hyperbola", "rational"])
def test_a_moved_record_is_the_curve_of_moved_points(name: str) -> None:
    mirror = np.array([[0.0, -2.0, 0.0, 1.0], [2.0, 0.0, 0.0, -3.0], [0.0, 0.0, -2.0, 5.0]])
    record = curve_record(*_curves()[name])
    parameters = np.linspace(record[1], record[2], 9)
    plain, away = (
        evaluate_curves(pack_curves([r]), np.zeros(9, np.int32), parameters)
        for r in (record, transform_record(record, mirror))
    )
    assert away[:, 0] == pytest.approx(transform_points(plain[:, 0], mirror), abs=1e-12)


def test_edges_stand_where_their_shape_does() -> None:
    import cadquery as cq
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    body = cq.Workplane().box(4, 3, 2).edges("|Z").fillet(0.5).rotate((0, 0, 0), (1, 2, 3), 40).translate((5, 6, 7))
    edges = [edge.wrapped for edge in body.edges().vals()]
    records = [edge_record(edge) for edge in edges]
    assert {r[0] for r in records} == {LINE, ELLIPSE}
    curves = pack_curves(records)
    for i, edge in enumerate(edges):
        adaptor = BRepAdaptor_Curve(edge)
        for t in np.linspace(*curves.range[i], 5):
            point = adaptor.Value(float(t))
            found = evaluate_curves(curves, np.array([i], np.int32), np.array([t]))[0, 0]
            assert found == pytest.approx([point.X(), point.Y(), point.Z()], abs=1e-12)


def test_an_edge_without_a_curve_is_unknown() -> None:
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Edge

    edge = TopoDS_Edge()
    BRep_Builder().MakeEdge(edge)
    assert edge_record(edge) is UNKNOWN
    assert SPLINE != NONE
