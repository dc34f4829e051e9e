"""Curved faces that the meshers leave coarse: found, and refined without touching their edges."""

from __future__ import annotations

import math

import numpy as np
import pytest

from hlr.source import open_source, rescue
from hlr.source import tessellate as t
from hlr.source.quality import FINE, coarse_faces, heights
from hlr.source.refine import refine

cq = pytest.importorskip("cadquery")

ANGLE = math.pi / 6
HEIGHT = 20.0


def half_cone():
    """Half the side of a cone with apex at the origin, opening upwards; no edge marks its apex, as in many files."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
    from OCP.GC import GC_MakeArcOfCircle
    from OCP.Geom import Geom_ConicalSurface
    from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt
    from OCP.ShapeFix import ShapeFix_Edge

    radius = HEIGHT * math.tan(ANGLE)
    apex, a, b = gp_Pnt(0, 0, 0), gp_Pnt(radius, 0, HEIGHT), gp_Pnt(-radius, 0, HEIGHT)
    arc = GC_MakeArcOfCircle(a, gp_Pnt(0, radius, HEIGHT), b).Value()
    wire = BRepBuilderAPI_MakeWire(
        BRepBuilderAPI_MakeEdge(apex, a).Edge(),
        BRepBuilderAPI_MakeEdge(arc).Edge(),
        BRepBuilderAPI_MakeEdge(b, apex).Edge(),
    ).Wire()
    surface = Geom_ConicalSurface(gp_Ax3(apex, gp_Dir(0, 0, 1)), ANGLE, 0.0)
    face = BRepBuilderAPI_MakeFace(surface, wire, True).Face()
    for edge in cq.Shape(face).Edges():
        ShapeFix_Edge().FixAddPCurve(edge.wrapped, face, False, 1e-6)
    return face


def off_cone(points):
    """Distance of points from the cone of `half_cone`."""
    radius = np.hypot(points[:, 0], points[:, 1])
    return np.abs(radius * math.cos(ANGLE) - points[:, 2] * math.sin(ANGLE))


def samples(points, triangles):
    """Points spread over triangles."""
    steps = [(i / 6, j / 6) for i in range(7) for j in range(7 - i)]
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.concatenate([(1 - u - v) * a + u * b + v * c for u, v in steps])


@pytest.mark.parametrize("deflection", [0.2, 0.05, 0.01, 0.002])
def test_a_cone_without_a_marked_apex_keeps_its_chord_error(deflection):
    (part,) = open_source(half_cone()).mesh(deflection, 0.5).parts
    assert off_cone(samples(part.points, part.triangles)).max() <= 2 * deflection


@pytest.mark.parametrize("radius", [0.0, 2.0])
def test_sound_cones_are_not_taken_for_coarse(radius, monkeypatch):
    source = open_source(cq.Solid.makeCone(10, radius, 20))
    monkeypatch.setattr(t, "refine", lambda *_: pytest.fail("refined"))
    for deflection in (0.5, 0.02, 0.005):
        source.mesh(deflection, 0.5)
        assert len(coarse_faces(source._tessellator._tables()[0], deflection, FINE)) == 0


def arrays(face):
    from OCP.BRep import BRep_Tool
    from OCP.TopLoc import TopLoc_Location

    mesh = BRep_Tool.Triangulation_s(face, TopLoc_Location())
    nodes = (mesh.Node(i) for i in range(1, mesh.NbNodes() + 1))
    points = np.array([(p.X(), p.Y(), p.Z()) for p in nodes])
    triangles = np.array([mesh.Triangle(i).Get() for i in range(1, mesh.NbTriangles() + 1)], dtype=np.int32) - 1
    return points, triangles


def borders(triangles):
    ends = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    unique, counts = np.unique(ends, axis=0, return_counts=True)
    assert counts.max() == 2
    return unique[counts == 1], unique[counts == 2]


SURFACES = {
    "sphere": (lambda: cq.Solid.makeSphere(10).Faces()[0], lambda p: np.abs(np.linalg.norm(p, axis=1) - 10)),
    "torus": (
        lambda: cq.Solid.makeTorus(10, 3).Faces()[0],
        lambda p: np.abs(np.hypot(np.hypot(p[:, 0], p[:, 1]) - 10, p[:, 2]) - 3),
    ),
    "placed": (
        lambda: cq.Solid.makeSphere(10).Faces()[0].moved(cq.Location((50, 0, 7), (1, 1, 0), 40)),
        lambda p: np.abs(np.linalg.norm(p, axis=1) - 10),
    ),
}


@pytest.mark.parametrize("name", SURFACES)
def test_refining_keeps_the_border_and_reaches_the_surface(name):
    make, off = SURFACES[name]
    face = make().wrapped
    t.run_mesher(face, 1.0, 0.7)
    points, triangles = arrays(face)
    border, inside = borders(triangles)
    fixed = inside[:1]
    assert refine(face, triangles, fixed.astype(np.int32), 0.02)
    after, finer = arrays(face)
    assert np.array_equal(after[: len(points)], points)
    assert off(after).max() < 1e-6
    kept, chords = borders(finer)
    assert np.array_equal(kept, border)
    assert (chords == fixed).all(axis=1).any()
    # Beside a coarse border, or a coarse edge that must stay, chords cannot be lower than those allow.
    free = ~np.isin(chords, np.concatenate((border, fixed))).any(axis=1)
    middle = after[chords[free]].mean(axis=1)
    assert off(middle).max() <= 2 * 0.02


def test_refining_is_the_same_every_time():
    results = []
    for _ in range(2):
        face = SURFACES["sphere"][0]().wrapped
        t.run_mesher(face, 1.0, 0.7)
        refine(face, arrays(face)[1], np.empty((0, 2), dtype=np.int32), 0.05)
        results.append(arrays(face))
    assert all(np.array_equal(a, b) for a, b in zip(*results, strict=True))


def test_faces_that_need_nothing_are_left_alone():
    face = SURFACES["sphere"][0]().wrapped
    t.run_mesher(face, 0.05, 0.3)
    assert not refine(face, arrays(face)[1], np.empty((0, 2), dtype=np.int32), 1.0)


def test_heights_at_a_node_without_normal_are_those_of_the_other_end():
    points = np.array([(0.0, 0.0, 0.0), (3.0, 0.0, 4.0), (math.sin(0.2), 0.0, math.cos(0.2) - 1.0)])
    normals = np.array([(0.0, 0.0, 0.0), (0.8, 0.0, -0.6), (math.sin(0.2), 0.0, math.cos(0.2))])
    found = heights(points, normals, np.array([0, 0, 0]), np.array([1, 2, 0]))
    assert found == pytest.approx([0.0, 1.0 - math.cos(0.1), 0.0], rel=0.01)


def test_nothing_that_can_be_meshed_is_an_error_of_ours(monkeypatch):
    from hlr.errors import SourceError

    for module in (t, rescue):
        monkeypatch.setattr(module, "run_mesher", lambda *_, **__: None)
    with pytest.raises(SourceError, match="could be meshed"):
        open_source(cq.Solid.makeCone(10, 2, 20)).mesh(0.1, 0.5)
