"""Outlines of true surfaces: how many there are, that they lie where N . v = 0, and that they meet at borders of faces.

Points are judged by OpenCASCADE's own evaluation: the nearest place on the face's surface, and the normal there.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import hlr
from hlr import Perspective
from hlr.drawing.curve import Arc
from hlr.image.camera import Camera, resolve
from hlr.image.image import image_of
from hlr.image.outlines import outlined
from hlr.image.placement import Placement
from hlr.lab.measure.occt_curves import evaluate_curves
from hlr.request.accuracy import derive
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import Planner
from hlr.scene.build import build
from hlr.source import open_source
from support.at_size import AT_SIZE

cq = pytest.importorskip("cadquery")

VIEWS = [tuple(v / np.linalg.norm(v)) for v in np.random.default_rng(4).normal(size=(10, 3))]
CAMERAS = [None, Perspective(fov=40.0)]


def torus():
    return cq.Solid.makeTorus(20, 6)


def wave():
    """A B-spline surface over a square, with hills and hollows."""
    points = [[cq.Vector(x, y, 3 * np.sin(x / 4) * np.cos(y / 5)) for y in range(0, 31, 3)] for x in range(0, 31, 3)]
    return cq.Face.makeSplineApprox(points)


def vase():
    """A surface of revolution of a spline."""
    profile = cq.Workplane("XZ").spline([(5, 0), (9, 8), (4, 16), (7, 24)]).wire()
    return profile.revolve(360, (0, 0, 0), (0, 1, 0))


def extruded():
    return cq.Workplane().spline([(0, 0), (5, 4), (10, -3), (15, 0)]).wire().extrude(20)


def offset():
    """The spline surface moved along its own normals: an offset surface."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.Geom import Geom_OffsetSurface

    surface = Geom_OffsetSurface(wave()._geomAdaptor(), 2.0)
    return cq.Face(BRepBuilderAPI_MakeFace(surface, 1e-6).Face())


def traced(shape, view, perspective, finer=1.0):
    """The scene with its outlines, the camera, the tolerances. finer: the mesh than these ask for."""
    source = open_source(shape)
    options = hlr.Options(perspective=perspective, **AT_SIZE)
    bounds = source.bounds()
    camera = resolve(view, options, source.frame, bounds)
    tolerances = derive(0.02, 1.0, 0.0, brep=True)
    scene = build(source.mesh(tolerances.deflection / finer, tolerances.angle / finer), 30.0, tolerances.deflection)
    placement = Placement(1.0, 1.0, tolerances, 1.0, True, 1.0, 1.0)
    image = outlined(image_of(scene, camera, placement), Planner(drawing_effects(), options))
    return image, camera, tolerances


def outlines(scene) -> Iterator[tuple[int, np.ndarray]]:
    """(face, points) of every outline before visibility."""
    chains = scene.walks
    for c in np.flatnonzero(chains.face >= 0):
        edges = chains.edges[chains.offsets[c] : chains.offsets[c + 1]]
        ends = scene.edges[edges]
        yield int(chains.face[c]), scene.points[np.append(ends[:, 0], ends[-1, 1])]


def slopes(shape, face, points, camera: Camera) -> tuple[np.ndarray, np.ndarray]:
    """|N . v| and distances from the surface, by OpenCASCADE."""
    from OCP.BRep import BRep_Tool
    from OCP.GeomAPI import GeomAPI_ProjectPointOnSurf
    from OCP.GeomLProp import GeomLProp_SLProps
    from OCP.gp import gp_Pnt

    value = shape.val() if isinstance(shape, cq.Workplane) else shape
    surface = BRep_Tool.Surface_s(([value] if isinstance(value, cq.Face) else value.Faces())[face].wrapped)
    slope, away = [], []
    for p in points:
        found = GeomAPI_ProjectPointOnSurf(gp_Pnt(*p), surface)
        away.append(found.LowerDistance())
        normal = GeomLProp_SLProps(surface, *found.LowerDistanceParameters(), 1, 1e-12).Normal()
        sight = -np.asarray(camera.direction) if camera.eye is None else p - np.asarray(camera.eye)
        slope.append(abs(np.dot((normal.X(), normal.Y(), normal.Z()), sight / np.linalg.norm(sight))))
    return np.array(slope), np.array(away)


@pytest.mark.slow
@pytest.mark.parametrize("camera", CAMERAS, ids=["parallel", "perspective"])
@pytest.mark.parametrize("view", [(0.8, -0.6, 0.1), (1, 0.3, -0.05), (-0.9, -0.4, 0.03)])
@pytest.mark.parametrize("shape", [torus, wave, vase, extruded, offset])
def test_the_points_lie_on_the_surface_where_it_is_seen_edge_on(shape, view, camera):
    shape = shape()
    scene, seen, _ = traced(shape, view, camera)
    found = list(outlines(scene))
    assert found
    for face, points in found:
        slope, away = slopes(shape, face, points[:: 1 + len(points) // 60], seen)
        assert slope.max() <= 1e-6
        assert away.max() <= 1e-9


def count(drawing):
    """(visible, hidden) outlines."""
    kinds = [line.visible for line in drawing.lines if line.kind == "outline"]
    return sum(kinds), len(kinds) - sum(kinds)


@pytest.mark.slow
@pytest.mark.parametrize("camera", CAMERAS, ids=["parallel", "perspective"])
def test_spheres_have_one_outline_and_cylinders_two(camera):
    sphere, cylinder = cq.Workplane().sphere(10), cq.Solid.makeCylinder(5, 20)
    for view in VIEWS:
        assert count(hlr.draw(sphere, view, perspective=camera, **AT_SIZE)) == (1, 0)
        found = hlr.draw(cylinder, view, perspective=camera, **AT_SIZE)
        assert count(found) == (2, 0)
        assert all(len(line.points) == 2 for line in found.lines if line.kind == "outline")


def test_cones_have_two_outlines_or_none():
    """None where the apex is seen within the base."""
    slope = 20 / 10
    for view in VIEWS:
        outside = np.hypot(view[0], view[1]) * slope > abs(view[2])
        found = hlr.draw(cq.Solid.makeCone(10, 0, 20), view, **AT_SIZE)
        assert sum(count(found)) == (2 if outside else 0)


@pytest.mark.slow
def test_a_torus_has_as_many_outlines_as_its_angle_says():
    """One closed curve outside; inside one closed curve without cusps where the sight is steep, else four arcs between
    four cusps, of which the two concave ones are hidden."""
    for view in VIEWS:
        # One of the views is nearly edge-on: only a fine mesh tells outlines apart that are hundredths of a mm away.
        scene, _, _ = traced(torus(), view, None, finer=2.0)
        found = [points for _, points in outlines(scene)]
        steep = _cusps(np.sqrt(1 - view[2] ** 2), abs(view[2]))
        assert len(found) == (5 if steep else 2), view


def _cusps(sine: float, cosine: float) -> bool:
    """Whether the inner outline of the torus 20, 6 has cusps: the curvature along the sight changes sign on it."""
    u = np.linspace(0, 2 * np.pi, 20001)
    # N = (cos v cos u, cos v sin u, sin v); N . v = 0 for the sight (sine, 0, cosine): tan v = -tan a cos u.
    v = np.arctan2(-sine * np.cos(u), cosine) + np.pi
    radius = 20 + 6 * np.cos(v)
    du, dv = -np.sin(u) * sine, -np.sin(v) * np.cos(u) * sine + np.cos(v) * cosine
    bend = np.cos(v) / radius * du**2 + dv**2 / 6
    return bool((bend < 0).any() and (bend > 0).any())


def test_the_outline_goes_on_over_smooth_borders():
    """Ends of outlines that lie on a smooth edge are there twice: those of both faces, in one point."""
    body = cq.Workplane().box(20, 30, 10).edges().fillet(2)
    for view in VIEWS[:4]:
        scene, _, tolerances = traced(body, view, None)
        ends = np.concatenate([points[[0, -1]] for _, points in outlines(scene)])
        apart = np.linalg.norm(ends[:, None] - ends[None], axis=2) + 1e9 * np.eye(len(ends))
        assert apart.min(axis=1).max() < 0.1 * 2 * tolerances.deflection


@pytest.mark.parametrize("view", ["front", "top", "right"])
def test_a_fillet_tangent_to_a_plane_seen_edge_on_has_one_line(view):
    body = cq.Workplane().box(20, 30, 10).edges().fillet(2)
    drawing = hlr.draw(body, view, **AT_SIZE)
    assert count(drawing)[1] == 0
    ink = sum(float(np.hypot(*np.diff(line.points, axis=0).T).sum()) for line in drawing.lines)
    width, height = drawing.bounds[2:]
    assert ink == pytest.approx(2 * (width + height) - 8 * 2 + 2 * np.pi * 2, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("camera", CAMERAS, ids=["parallel", "perspective"])
@pytest.mark.parametrize("view", [(0.8, -0.6, 0.1), (1, 0.3, -0.05)])
@pytest.mark.parametrize("shape", [torus, wave, vase, offset])
def test_between_its_points_too_a_curve_follows_the_surface(shape, view, camera):
    """Within a twentieth of the deflection, where the polyline is allowed a fifth."""
    shape = shape()
    scene, seen, tolerances = traced(shape, view, camera)
    silhouettes = scene.silhouettes
    faces = scene.walks.face[scene.walks.face >= 0]
    assert len(faces) == len(silhouettes.source)
    assert (silhouettes.curves.kind > 0).any()
    for k in np.flatnonzero(silhouettes.curves.kind > 0):
        t = np.linspace(*silhouettes.curves.range[k], 71)
        points = evaluate_curves(silhouettes.curves, np.full(len(t), k, np.int32), t)[:, 0]
        slope, away = slopes(shape, faces[k], points, seen)
        assert away.max() <= 0.05 * tolerances.deflection
        assert slope.max() <= 0.01


@pytest.mark.parametrize("radius", [5, 7, 10, 10.5])
@pytest.mark.parametrize("view", [(1, -2, 0.5), (0, -1, 1e-3), "top", "front", "right", (1, -2, 0)], ids=str)
def test_a_sphere_is_drawn_as_one_circle(view, radius):
    box = cq.Workplane().box(1, 1, 1).translate((60, 0, 0))
    drawing = hlr.draw(cq.Workplane().sphere(radius).add(box), view, **AT_SIZE)
    (line,) = (line for line in drawing.lines if line.kind == "outline")
    assert line.curve.whole
    assert line.curve.radii == pytest.approx((radius, radius), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("beside", [0, 1e-12, -1e-9, 5e-7, -1e-4])
@pytest.mark.parametrize("axis", [(0, 0, 1), (0.2, -0.6, 0.5)], ids=str)
def test_an_outline_through_both_poles_of_a_sphere_is_one_circle(axis, beside):
    """And one that runs beside them: the angle between the line of sight and the equator, in radians."""
    axis = np.asarray(axis) / np.linalg.norm(axis)
    for radius, turn in ((0.7, 0.0), (2.4, 1.0), (10, 2.5), (33.3, 4.0), (90, 0.3)):
        flat = cq.Plane((3, -2, 1), normal=tuple(axis))
        view = np.cos(turn) * np.array(flat.xDir.toTuple()) + np.sin(turn) * np.array(flat.yDir.toTuple())
        drawing = hlr.draw(cq.Workplane(flat).sphere(radius), tuple(view + beside * axis), **AT_SIZE)
        (line,) = drawing.lines
        assert line.visible
        assert line.curve.whole, (radius, turn)
        assert line.curve.radii == pytest.approx((radius, radius), rel=1e-12)


def egg(radius, height):
    """A surface of revolution of a spline that meets its axis at a right angle."""
    points = [cq.Vector(x * radius, 0, z * height) for x, z in ((0, -1), (0.7, -0.7), (1, 0), (0.7, 0.7), (0, 1))]
    side = cq.Edge.makeSpline(points, tangents=[cq.Vector(1, 0, 0), cq.Vector(-1, 0, 0)])
    wire = cq.Wire.assembleEdges([side, cq.Edge.makeLine(points[-1], points[0])])
    return cq.Solid.revolve(wire, [], 360, cq.Vector(0, 0, 0), cq.Vector(0, 0, 1))


@pytest.mark.slow
@pytest.mark.parametrize("view", ["front", (1, -2, 0), (0, -1, 1e-9)], ids=str)
def test_an_outline_through_a_pole_is_one_curve(view):
    """Of a surface of revolution a closed one; of a sphere cut off below, an arc from cut to cut."""
    for size in (5, 20):
        (line,) = hlr.draw(egg(size, size), view, **AT_SIZE).lines
        assert line.visible
        assert (line.points[0] == line.points[-1]).all()
        cap = cq.Workplane().sphere(size).cut(cq.Workplane().box(4 * size, 4 * size, size).translate((0, 0, -size)))
        (line,) = (line for line in hlr.draw(cap, view, **AT_SIZE).lines if line.kind == "outline")
        assert line.visible
        assert line.curve.radii == pytest.approx((size, size), rel=1e-12)
        ends = line.points[[0, -1], 1] - line.points[:, 1].max()
        assert ends == pytest.approx(-1.5 * size, rel=1e-4)


@pytest.mark.parametrize("camera", CAMERAS, ids=["parallel", "perspective"])
def test_a_sphere_is_drawn_as_one_ellipse(camera):
    """Of a sphere beside the centre of a perspective view an ellipse is seen, the longer the farther."""
    box = cq.Workplane().box(1, 1, 1).translate((60, 0, 0))
    drawing = hlr.draw(cq.Workplane().sphere(10).add(box), "front", perspective=camera, **AT_SIZE)
    (line,) = (line for line in drawing.lines if line.kind == "outline")
    assert isinstance(line.curve, Arc)
    assert line.curve.whole
    a, b = line.curve.radii
    if camera is None:
        assert (a, b) == pytest.approx((10, 10), rel=1e-12)
        return
    # The cone of sight about the way to the centre, cut by the plane of the image.
    view = drawing.view
    way = -np.asarray(view.eye)
    far = np.linalg.norm(way)
    slant, half = np.arccos(-way @ view.direction / far), np.arcsin(10 / far)
    assert slant > 0.1
    ends = [view.distance * np.tan(slant + s * half) for s in (-1, 1)]
    assert a == pytest.approx((ends[1] - ends[0]) / 2, rel=1e-9)
    assert b < a


def test_a_torus_seen_along_its_axis_is_two_circles():
    drawing = hlr.draw(torus(), "top", **AT_SIZE)
    assert sorted(line.curve.radii[0] for line in drawing.lines) == pytest.approx([14, 26], rel=1e-12)
    assert all(line.curve.whole for line in drawing.lines)


def test_a_fold_along_an_edge_has_the_curve_of_the_edge():
    """Fillets of a box seen from the front: quarter circles about known centres, though all are outlines."""
    drawing = hlr.draw(cq.Workplane().box(20, 30, 10).edges().fillet(2), "front", **AT_SIZE)
    arcs = [line.curve for line in drawing.lines if line.curve is not None]
    assert len(arcs) == 4
    assert all(isinstance(arc, Arc) for arc in arcs)
    centres = sorted(tuple(np.round(arc.centre + drawing.origin, 9).tolist()) for arc in arcs)
    assert centres == [(-8, -3), (-8, 3), (8, -3), (8, 3)]
    assert all(arc.radii == pytest.approx((2, 2), rel=1e-9) for arc in arcs)


def test_a_rim_seen_along_its_wall_is_hidden_by_what_lies_on_it():
    """The wall of the hole is edge-on: it tells nothing of its rim, most of which lies under the box."""
    plate = cq.Workplane().box(20, 20, 4).faces(">Z").workplane().hole(6)
    box = cq.Workplane(origin=(2, 0, 2)).rect(8, 14).extrude(5)
    drawing = hlr.draw(cq.Assembly().add(plate, name="plate").add(box, name="box"), "top", **AT_SIZE)
    rim = [line for line in drawing.lines if isinstance(line.curve, Arc)]
    turn = {v: sum(float(np.ptp(line.curve.angles)) for line in rim if line.visible is v) for v in (True, False)}
    # The box covers x > -2 of a circle of radius 3.
    assert turn[True] == pytest.approx(2 * np.arccos(2 / 3), abs=0.01)
    assert turn[False] == pytest.approx(2 * np.pi - 2 * np.arccos(2 / 3), abs=0.01)


def test_outlines_reach_the_rims_they_end_on():
    """They touch there, and coincide with the rim before that: each ends at the place farthest to its side."""
    drawing = hlr.draw(cq.Workplane().circle(10).extrude(20), "iso", **AT_SIZE)
    ends = [line.points[k] + drawing.origin for line in drawing.lines if line.kind == "outline" for k in (0, -1)]
    right, up = np.array(drawing.view.right), np.array(drawing.view.up)
    places = [
        np.array([(centre + side * right) @ right, (centre + side * right) @ up])
        for centre in (np.zeros(3), np.array([0.0, 0.0, 20.0]))
        for side in (-10, 10)
    ]
    assert len(ends) == 4
    for place in places:
        assert min(np.hypot(*(end - place)) for end in ends) < 0.1 * drawing.accuracy.used


@pytest.mark.parametrize("finer", [1, 4])
@pytest.mark.parametrize(("height", "seen"), [(0.05, False), (1.0, True)])
def test_a_bump_that_hardly_rises_has_no_outline(height, seen, finer):
    """Over the smaller one N . v changes its sign as well, but it rises less than the accuracy above its own foot.

    However many nodes of a finer mesh lie amid the strip that is turned away.
    """
    grid = np.linspace(0, 30, 31)
    bump = [[cq.Vector(x, y, height * np.exp(-((x - 15) ** 2 + (y - 15) ** 2) / 4)) for y in grid] for x in grid]
    face = cq.Face.makeSplineApprox(bump, tol=1e-4, minDeg=3, maxDeg=3)
    scene, _, _ = traced(face, (1.0, 0.0, 0.2 * height), None, finer)
    assert any(True for _ in outlines(scene)) is seen
