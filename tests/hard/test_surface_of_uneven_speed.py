"""B-spline curves and surfaces whose parameter runs a thousand times faster at one end than at the other.

OpenCASCADE's exact algorithm takes such a border for part of the outline, because it measures normals by their length
averaged over the face, and then draws what is hidden behind material as visible (OCCT#1517). And whoever interpolates
the place of a cut by parameter puts it elsewhere in the model than on paper.
"""

from __future__ import annotations

from itertools import pairwise

import cadquery as cq
import numpy as np
import pytest
from hard.brep import compound, faultless, like, walk

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

POLES = np.array([[0, 0], [0.02, 0.0], [0.5, 12], [100, 30]], float)
"""A Bezier curve in x and z: slow at its start."""
DEPTH = 20.0
WALL = (20.0, 60.0)
"""From x to x; stands before the solid and is higher than it."""


def bezier(t):
    t = np.asarray(t, float)[..., None]
    weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    return sum(w * p for w, p in zip(weights, POLES, strict=True))


def parameter(x):
    """Where the curve passes x, by bisection: x grows all along."""
    low, high = 0.0, 1.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if bezier(middle)[0] < x else (low, middle)
    return low


def solid():
    """What is below the curve, from y = 0 to DEPTH; its top is a B-spline surface."""
    from OCP.Geom import Geom_BezierCurve
    from OCP.GeomConvert import GeomConvert
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt

    poles = TColgp_Array1OfPnt(1, 4)
    for i, (x, z) in enumerate(POLES):
        poles.SetValue(i + 1, gp_Pnt(x, 0, z))
    curve = GeomConvert.CurveToBSplineCurve_s(Geom_BezierCurve(poles))
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge

    top = cq.Edge(BRepBuilderAPI_MakeEdge(curve).Edge())
    corners = [cq.Vector(100, 0, 30), cq.Vector(100, 0, -10), cq.Vector(0, 0, -10), cq.Vector(0, 0, 0)]
    sides = [cq.Edge.makeLine(a, b) for a, b in pairwise(corners)]
    face = cq.Face.makeFromWires(cq.Wire.assembleEdges([top, *sides]))
    return cq.Solid.extrudeLinear(face, cq.Vector(0, DEPTH, 0))


def wall():
    return cq.Solid.makeBox(WALL[1] - WALL[0], 5, 60, cq.Vector(WALL[0], -10, -20))


def test_the_edge_is_cut_where_the_wall_begins(picture):
    drawing = hlr.draw(compound(solid(), wall()), "front", **AT_SIZE)
    t0, t1 = (parameter(x) for x in WALL)

    def between(a, b):
        return walk([(x, 0, z) for x, z in bezier(np.linspace(a, b, 400))])

    low, high = (WALL[0], -10, -20), (WALL[1], -10, 40)
    frame = [(low[0], low[2]), (high[0], low[2]), (high[0], high[2]), (low[0], high[2]), (low[0], low[2])]
    seen = [*between(0, t0), *between(t1, 1), *walk([(x, -10, z) for x, z in frame])]
    seen += walk([(0, 0, 0), (0, 0, -10), (WALL[0], 0, -10)]) + walk([(WALL[1], 0, -10), (100, 0, -10), (100, 0, 30)])
    like(drawing, expect(drawing, seen, [*between(t0, t1), ((WALL[0], 0, -10), (WALL[1], 0, -10))]))
    picture(drawing)


def test_the_cut_is_there_in_the_model_too():
    drawing = hlr.draw(compound(solid(), wall()), "front", **AT_SIZE)
    curve = [line for line in drawing.lines if line.part == 0 and np.ptp(line.points3[:, 2]) > 1 and line.visible]
    near = 2 * drawing.accuracy.used
    for x in WALL:
        z = bezier(parameter(x))[1]
        ends = np.concatenate([line.points3[[0, -1]] for line in curve])
        assert np.linalg.norm(ends[:, [0, 2]] - (x, z), axis=1).min() < near
        assert np.abs(ends[:, 1]).min() < near
    for line in drawing.lines:
        flat = line.points3 @ np.stack([drawing.view.right, drawing.view.up], axis=1) - drawing.origin
        assert np.abs(flat - line.points).max() < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", (1, 2, 0.7), (-0.4, -1, 0.2), (1, 0.05, 0.02)])
def test_nothing_behind_the_face_shows(view):
    model = compound(solid(), wall(), cq.Solid.makeBox(30, 10, 8, cq.Vector(40, 30, -8)))
    for drawing in faultless(model, model, [view]):
        assert any(not line.visible for line in drawing.lines)
