"""Lines of a drawing as OpenCASCADE edges in the XY plane."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np

from hlr.drawing.curve import Arc, Bezier
from hlr.drawing.line import Line, Points
from hlr.source.cad.occt_collections import new_collection

CIRCLE_TOLERANCE = 1e-9
"""Share of the major radius: an ellipse whose radii differ by no more is written as a circle."""

SHORTEST_EDGE = 1e-7
"""Model units: OpenCASCADE makes no edge between points closer than this."""


@cache
def _occt() -> SimpleNamespace:
    """What makes edges, imported once: an import statement for each line takes as long as some edges."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
    from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Elips, gp_Pnt

    return SimpleNamespace(
        make=BRepBuilderAPI_MakeEdge, place=gp_Ax2, circle=gp_Circ, way=gp_Dir, ellipse=gp_Elips, point=gp_Pnt
    )


def occt_edges(line: Line, shift: Points) -> list[Any]:
    """The TopoDS_Edges of one line, moved by `shift` (2,): one for a curve, for a polyline one per segment.

    A curve too short for OpenCASCADE gives none. The parameter of an edge rises, whatever the direction of the line.
    """
    curve = line.curve
    if isinstance(curve, Arc):
        made = _arc(curve, shift)
    elif isinstance(curve, Bezier):
        made = _bezier(curve, shift)
    else:
        return _polyline(line.points + shift)
    return [] if made is None else [made]


def occt_compound(lines: Iterable[Line], shift: Points) -> Any:
    """A TopoDS_Compound of the edges of all lines; an empty one where there are none."""
    from hlr.source.cad.shapes import make_compound as compound_of

    return compound_of([edge for line in lines for edge in occt_edges(line, shift)])


def _polyline(points: Points) -> list[Any]:
    make, point = _occt().make, _occt().point
    made = []
    x0, y0 = points[0].tolist()
    for x, y in points[1:].tolist():
        if math.hypot(x - x0, y - y0) <= SHORTEST_EDGE:
            continue
        made.append(make(point(x0, y0, 0.0), point(x, y, 0.0)).Edge())
        x0, y0 = x, y
    return made


def _arc(arc: Arc, shift: Points) -> Any:
    """A trimmed circle or ellipse about +z, the longer axis first, as exporters expect it."""
    occt = _occt()
    major, minor = arc.radii
    if minor <= SHORTEST_EDGE:
        return None
    x, y = (arc.centre + shift).tolist()
    (ux, uy), (vx, vy) = arc.axes.tolist()
    # Axes that turn clockwise: the same curve with t running backward.
    sign = 1.0 if ux * vy - uy * vx > 0.0 else -1.0
    start, end = sorted(sign * t for t in arc.angles.tolist())
    turn = math.floor(start / math.tau) * math.tau
    start, end = start - turn, end - turn
    place = occt.place(occt.point(x, y, 0.0), occt.way(0.0, 0.0, 1.0), occt.way(ux, uy, 0.0))
    circle = major - minor <= CIRCLE_TOLERANCE * major
    conic = occt.circle(place, major) if circle else occt.ellipse(place, major, minor)
    maker = occt.make(conic) if arc.whole else occt.make(conic, start, end)
    return maker.Edge() if maker.IsDone() else None


def _bezier(chain: Bezier, shift: Points) -> Any:
    """One piece as a Bezier curve, several as a B-spline with the pieces' ends as knots."""
    from OCP.Geom import Geom_BezierCurve, Geom_BSplineCurve

    occt = _occt()
    moved = chain.points + shift
    poles = new_collection("points", 1, len(moved))
    for i, (x, y) in enumerate(moved.tolist(), 1):
        poles.SetValue(i, occt.point(x, y, 0.0))
    if np.ptp(moved, axis=0).max() <= SHORTEST_EDGE:
        return None
    degree = chain.degree
    count = (len(moved) - 1) // degree
    if count == 1:
        curve: Any = Geom_BezierCurve(poles)
    else:
        knots = new_collection("reals", 1, count + 1)
        multiplicities = new_collection("integers", 1, count + 1)
        for i in range(count + 1):
            knots.SetValue(i + 1, float(i))
            multiplicities.SetValue(i + 1, degree + 1 if i in (0, count) else degree)
        curve = Geom_BSplineCurve(poles, knots, multiplicities, degree)
    maker = occt.make(curve)
    return maker.Edge() if maker.IsDone() else None
