"""A straight edge whose faces are tangent at its ends and its middle, and meet at up to 56 degrees in between.

Such an edge has two nodes, and its faces agree at both: only the surfaces along it tell that it is sharp. Where
the angle is there along a part of the edge only, that part is drawn, to where the angle begins.
"""

from __future__ import annotations

import numpy as np
import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_Sewing
from OCP.Geom import Geom_BSplineSurface
from OCP.gp import gp_Pnt

import hlr
from hlr.source.cad.occt_collections import new_collection
from support.at_size import ALL_LINES, AT_SIZE

LONG, WIDE = 100.0, 20.0
FLAT = [0.0] * 9
WAVY = [0, 0, -30, -30, 0, -30, -30, 0, 0]
"""Heights of poles along the far rim: tangent to the plane at both ends, and hardly at an angle in the middle."""
HALF = [0, 0, 0, 0, 0, -10, -30, -30, -30]
BELOW = [-30.0] * 9


def strip(heights, side, size):
    """A spline face from the x axis to a rim at these heights; cubic along x, straight across."""
    n, degree = len(heights), 3
    knots = np.linspace(0.0, 1.0, n - degree + 1)
    repeats = [degree + 1, *[1] * (len(knots) - 2), degree + 1]
    flat = np.repeat(knots, repeats)
    poles = new_collection("point_net", 1, n, 1, 2)
    for i, height in enumerate(heights):
        x = LONG * flat[i + 1 : i + 1 + degree].mean()
        poles.SetValue(i + 1, 1, gp_Pnt(size * x, 0, 0))
        poles.SetValue(i + 1, 2, gp_Pnt(size * x, size * side * WIDE, size * height))
    u, v = (_filled("reals", [float(k) for k in values]) for values in (knots, (0.0, 1.0)))
    counts = (_filled("integers", values) for values in (repeats, (2, 2)))
    surface = Geom_BSplineSurface(poles, u, v, *counts, degree, 1)
    return BRepBuilderAPI_MakeFace(surface, 1e-7).Face()


def _filled(kind, values):
    result = new_collection(kind, 1, len(values))
    for i, value in enumerate(values):
        result.SetValue(i + 1, value)
    return result


def sheet(heights, size=1.0):
    """A plane strip and the one with these heights, sewn along the x axis."""
    sewing = BRepBuilderAPI_Sewing(1e-6 * size)
    sewing.Add(strip(FLAT, -1, size))
    sewing.Add(strip(heights, 1, size))
    sewing.Perform()
    return sewing.SewedShape()


def ridge(drawing, size=1.0):
    """(kind, first x, last x) of the lines along the x axis, lengths in those of the sheet of size 1."""
    found = []
    for line in drawing.lines:
        if np.abs(line.points3[:, 1:]).max() < 1e-6 * size and line.visible:
            x = line.points3[:, 0] / size
            found.append((line.kind, round(float(x.min()), 2), round(float(x.max()), 2)))
    return sorted(found, key=lambda row: row[1])


@pytest.mark.slow
@pytest.mark.parametrize("size", [1.0, 0.01, 1000.0])
def test_sharp_between_places_where_it_is_tangent(size, picture):
    drawing = hlr.draw(sheet(WAVY, size), "iso", fit=(150, 150), **ALL_LINES)
    assert ridge(drawing, size) == [("sharp", 0.0, LONG)]
    if size == 1.0:
        picture(drawing)


@pytest.mark.parametrize("accuracy", [0.02, 0.5])
@pytest.mark.parametrize("smooth", [False, True])
def test_sharp_as_far_as_there_is_an_angle(accuracy, smooth):
    """The strip is plane up to x = 33.3; that it stands at 0.01 radians against the other begins at 41.33."""
    x = np.linspace(0.0, 1.0, 100_001)[:-1]
    knots = np.concatenate([[0.0] * 3, np.linspace(0.0, 1.0, 7), [1.0] * 3])
    height = sum(h * _basis(knots, i, 3, x) for i, h in enumerate(HALF))
    along = LONG * x[np.flatnonzero(np.abs(np.arctan2(height, WIDE)) <= 0.01)[-1]]
    drawing = hlr.draw(sheet(HALF), "iso", accuracy=accuracy, smooth=smooth, scale=1.0, hidden=True)
    *rest, (kind, begin, end) = ridge(drawing)
    assert (kind, end) == ("sharp", LONG) and begin == pytest.approx(along, abs=0.05)
    assert rest == ([("smooth", 0.0, begin)] if smooth else [])
    assert {line.edge for line in drawing.lines if line.kind in ("sharp", "smooth")} == {1}


def _basis(knots, i, degree, x):
    if degree == 0:
        return ((knots[i] <= x) & (x < knots[i + 1])).astype(float)
    result = np.zeros_like(x)
    for a, b, c, k in ((knots[i], knots[i + degree], 1.0, i), (knots[i + degree + 1], knots[i + 1], -1.0, i + 1)):
        if a != b:
            result += c * (x - a) / (c * (b - a)) * _basis(knots, k, degree - 1, x)
    return result


@pytest.mark.parametrize(("heights", "expected"), [(FLAT, []), (BELOW, [("sharp", 0.0, LONG)])])
def test_of_one_kind_throughout(heights, expected):
    assert ridge(hlr.draw(sheet(heights), "iso", **AT_SIZE)) == expected


def test_the_callers_shape_keeps_its_vertices():
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp

    shape = sheet(HALF)
    counts = []
    for _ in range(2):
        found = new_collection("shape_map")
        TopExp.MapShapes_s(shape, TopAbs_ShapeEnum.TopAbs_VERTEX, found)
        counts.append(found.Extent())
        hlr.draw(shape, "iso", **AT_SIZE)
    assert counts[0] == counts[1]
