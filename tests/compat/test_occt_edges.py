"""Lines become OpenCASCADE edges: the same points, the same kind of curve."""

import math

import numpy as np
import pytest

from hlr.compat.occt_edges import occt_compound, occt_edges
from hlr.drawing.curve import Arc, Bezier
from hlr.drawing.line import Line

pytest.importorskip("OCP")
SHIFT = np.array([3.0, -7.0])
FRACTIONS = np.linspace(0.0, 1.0, 9)


def line(curve, points=((0.0, 0.0), (1.0, 0.0))):
    return Line("sharp", True, 0, 0, None, np.array(points), np.zeros((len(points), 3)), None, curve)


def adaptor(edge):
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    return BRepAdaptor_Curve(edge)


def places(edge, fractions=FRACTIONS):
    """(n, 2) points of an edge at fractions of its parameter range; it lies in the XY plane."""
    curve = adaptor(edge)
    first, last = curve.FirstParameter(), curve.LastParameter()
    points = np.array([(p.X(), p.Y(), p.Z()) for p in (curve.Value(first + (last - first) * f) for f in fractions)])
    assert (points[:, 2] == 0.0).all()
    return points[:, :2]


def kind(edge):
    return adaptor(edge).GetType().name.removeprefix("GeomAbs_")


@pytest.mark.parametrize("turned", [1.0, -1.0], ids=["counter-clockwise", "clockwise"])
@pytest.mark.parametrize("angles", [(0.3, 2.0), (2.0, 0.3), (-9.0, -4.5), (5.5, 8.0), (20.0, 17.0)])
@pytest.mark.parametrize("minor", [2.0, 5.0])
def test_arcs(turned, angles, minor):
    cosine, sine = math.cos(0.7), math.sin(0.7)
    axes = np.array([[5.0 * cosine, 5.0 * sine], [-turned * minor * sine, turned * minor * cosine]])
    arc = Arc(np.array([1.0, 2.0]), axes, np.array(angles))
    (edge,) = occt_edges(line(arc), SHIFT)
    assert kind(edge) == ("Circle" if minor == 5.0 else "Ellipse")
    expected = arc.at(np.array(angles)[0] + FRACTIONS * (angles[1] - angles[0])) + SHIFT
    forward = turned * (angles[1] - angles[0]) > 0.0
    assert places(edge) == pytest.approx(expected if forward else expected[::-1], abs=1e-12)


@pytest.mark.parametrize("minor", [2.0, 5.0])
def test_whole_circles_and_ellipses_close(minor):
    arc = Arc(np.array([1.0, 2.0]), np.array([[0.0, 5.0], [minor, 0.0]]), np.array([1.0, 1.0 + math.tau]))
    (edge,) = occt_edges(line(arc), SHIFT)
    assert adaptor(edge).IsClosed()
    first, last = places(edge, [0.0, 1.0])
    assert first == pytest.approx(last, abs=1e-12)
    offset = (places(edge) - SHIFT - arc.centre) / [minor, 5.0]
    assert (offset**2).sum(axis=1) == pytest.approx(1.0)


@pytest.mark.parametrize("degree", [2, 3])
@pytest.mark.parametrize("count", [1, 3])
def test_bezier_curves(degree, count):
    chain = Bezier(degree, np.random.default_rng(degree).uniform(-5.0, 5.0, (degree * count + 1, 2)))
    (edge,) = occt_edges(line(chain), SHIFT)
    assert kind(edge) == ("BezierCurve" if count == 1 else "BSplineCurve")
    assert adaptor(edge).Degree() == degree
    assert places(edge) == pytest.approx(chain.at(FRACTIONS * count) + SHIFT, abs=1e-12)


def test_polylines_are_their_segments():
    points = [(0.0, 0.0), (3.0, 4.0), (3.0, 4.0), (3.0, 10.0)]
    made = occt_edges(line(None, points), SHIFT)
    assert [kind(edge) for edge in made] == ["Line", "Line"]
    ends = np.concatenate([places(edge, [0.0, 1.0]) for edge in made]) - SHIFT
    assert ends.tolist() == [[0.0, 0.0], [3.0, 4.0], [3.0, 4.0], [3.0, 10.0]]


def test_what_has_no_length_gives_no_edge():
    assert occt_edges(line(None, [(1.0, 1.0), (1.0, 1.0)]), SHIFT) == []
    assert occt_edges(line(Bezier(2, np.ones((3, 2)))), SHIFT) == []
    flat = Arc(np.zeros(2), np.array([[5.0, 0.0], [0.0, 0.0]]), np.array([0.0, 1.0]))
    assert occt_edges(line(flat), SHIFT) == []


def test_a_compound_of_nothing_is_empty():
    empty = occt_compound([], SHIFT)
    assert not empty.IsNull() and empty.NbChildren() == 0
    assert occt_compound([line(None), line(None)], SHIFT).NbChildren() == 2
