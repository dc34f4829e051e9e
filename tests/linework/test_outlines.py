"""Curved parts: which lines are drawn, that they are whole, and that none is drawn twice."""

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.measures import counts, distances, drawn_twice, length, placed, samples, segments
from support.models import parts, turned


def cad():
    import cadquery

    return cadquery


def cylinder(height=40.0, radius=10.0):
    return cad().Workplane().cylinder(height, radius)


def outlines(drawing):
    return [line for line in drawing.lines if line.kind == "outline"]


def closed(line):
    return bool((line.points[0] == line.points[-1]).all())


def radii(drawing, line, centre=(0.0, 0.0)):
    return np.hypot(*(samples_of(drawing, line) - centre).T)


def samples_of(drawing, line):
    points = placed(drawing, line)
    return samples(np.stack([points[:-1], points[1:]], axis=1), 0.2)


@pytest.mark.parametrize("view", ["front", "top", "iso", (3, 1, -2)])
def test_a_sphere_is_one_closed_outline(view):
    drawing = hlr.draw(cad().Workplane().sphere(10), view, **AT_SIZE)
    (line,) = drawing.lines
    assert (line.kind, line.visible, closed(line)) == ("outline", True, True)
    assert np.abs(radii(drawing, line) - 10).max() < drawing.accuracy.used
    assert length(line) == pytest.approx(2 * np.pi * 10, rel=0.005)
    assert drawn_twice(drawing) == 0


@pytest.mark.parametrize("view", [(0.2, 0.5, 0.9), (-0.276, 1.294, 1.007)])
def test_the_outline_of_a_sphere_has_no_small_loops(view):
    assert len(hlr.draw(cad().Workplane().sphere(10), view, **AT_SIZE).lines) == 1


def test_a_sphere_in_perspective_is_larger_than_its_radius():
    eye = (0.0, -30.0, 0.0)
    drawing = hlr.draw(
        cad().Workplane().sphere(10), "front", perspective=hlr.Perspective(eye=eye, target=(0, 0, 0)), **AT_SIZE
    )
    (line,) = drawing.lines
    # The cone of tangents from the eye meets the plane through the centre.
    assert np.abs(radii(drawing, line) - 30 * 10 / np.sqrt(30**2 - 10**2)).max() < drawing.accuracy.used


@pytest.mark.parametrize("view", ["front", "left", "back", (1, 2, 0)])
def test_a_cylinder_from_the_side_is_two_generators_and_its_rims(view):
    drawing = hlr.draw(cylinder(), view, **AT_SIZE)
    sides = outlines(drawing)
    assert all(line.visible for line in drawing.lines)
    assert [length(line) for line in sides] == pytest.approx([40, 40], abs=0.01)
    assert sorted(placed(drawing, line)[0, 0] for line in sides) == pytest.approx([-10, 10], abs=0.05)
    assert {line.edge for line in drawing.lines if line.kind == "sharp"} == {0, 2}
    low, high = drawing.bounds[:2], drawing.bounds[2:]
    assert (*low, *high) == pytest.approx((0, 0, 20, 40), abs=0.05)


def test_a_cylinder_from_the_side_draws_no_rim_twice():
    assert drawn_twice(hlr.draw(cylinder(), "front", **AT_SIZE)) < 1


def test_a_cylinder_from_above_is_one_circle_and_from_a_corner_a_rim_is_half_hidden():
    top = hlr.draw(cylinder(), "top", **AT_SIZE)
    (line,) = top.lines
    assert (line.kind, line.visible, closed(line)) == ("sharp", True, True)
    assert np.abs(radii(top, line) - 10).max() < top.accuracy.used
    iso = hlr.draw(cylinder(), "iso", **AT_SIZE)
    assert counts(iso) == {("sharp", True): 2, ("sharp", False): 1, ("outline", True): 2}
    halves = [line for line in iso.lines if np.allclose(line.points3[:, 2], -20)]
    assert [line.visible for line in halves] in ([True, False], [False, True])
    assert length(halves[0]) == pytest.approx(length(halves[1]), rel=0.1)
    assert drawn_twice(iso) < 0.2


def test_a_cone_from_the_side_is_a_triangle():
    drawing = hlr.draw(cad().Workplane().add(cad().Solid.makeCone(10, 0, 20)), "front", **AT_SIZE)
    triangle = np.array([[[-10, 0], [10, 0]], [[10, 0], [0, 20]], [[0, 20], [-10, 0]]], float)
    found = segments(drawing)
    assert distances(samples(found, 0.5), triangle).max() < drawing.accuracy.used
    assert distances(samples(triangle, 0.5), found).max() < 2 * drawing.accuracy.used
    assert sum(length(line) for line in outlines(drawing)) == pytest.approx(2 * np.hypot(10, 20), rel=0.005)


def test_a_torus_from_above_is_two_circles():
    drawing = hlr.draw(cad().Solid.makeTorus(20, 5), "top", **AT_SIZE)
    assert counts(drawing) == {("outline", True): 2}
    for line, radius in zip(sorted(drawing.lines, key=length), (15, 25), strict=True):
        assert closed(line)
        assert np.abs(radii(drawing, line) - radius).max() < drawing.accuracy.used


def test_a_torus_from_the_side_hides_the_inner_halves_of_its_ends():
    drawing = hlr.draw(cad().Solid.makeTorus(20, 5), "front", **AT_SIZE)
    hidden = np.concatenate([samples_of(drawing, line) for line in drawing.lines if not line.visible])
    assert np.abs(np.hypot(np.abs(hidden[:, 0]) - 20, hidden[:, 1]) - 5).max() < drawing.accuracy.used
    assert (np.abs(hidden[:, 0]) < 20 + drawing.accuracy.used).all()
    seen = np.concatenate([samples_of(drawing, line) for line in drawing.lines if line.visible])
    stadium = np.hypot(np.maximum(np.abs(seen[:, 0]) - 20, 0), seen[:, 1])
    assert np.abs(stadium - 5).max() < 2 * drawing.accuracy.used


def test_the_inner_outline_of_a_torus_is_one_line():
    drawing = hlr.draw(cad().Solid.makeTorus(20, 5), "iso", **AT_SIZE)
    assert len(drawing.lines) <= 4


def test_smooth_edges_are_drawn_on_request():
    model = cad().Workplane().box(20, 20, 20).edges("|Z").fillet(5)
    plain, smooth = hlr.draw(model, "front", **AT_SIZE), hlr.draw(model, "front", smooth=True, scale=1.0, hidden=True)
    assert counts(plain) == {("sharp", True): 6, ("outline", True): 2}
    assert counts(smooth) == counts(plain) + counts(plain).__class__({("smooth", True): 2})
    where = sorted(placed(smooth, line)[0, 0] for line in smooth.lines if line.kind == "smooth")
    assert where == pytest.approx([-5, 5])
    iso = hlr.draw(model, "iso", smooth=True, scale=1.0, hidden=True)
    assert sum(line.kind == "smooth" for line in iso.lines) == 8
    assert drawn_twice(iso) < 0.2


@pytest.mark.parametrize("view", ["front", "iso", "top", (1, 1, 0)])
def test_a_smooth_edge_on_an_outline_is_not_drawn_again(view):
    # A rod with rounded sides: the tangent edges lie on the outline in the front view.
    half = cad().Workplane().slot2D(30, 10).extrude(8)
    drawing = hlr.draw(half, view, smooth=True, seam=True, scale=1.0, hidden=True)
    by_kind = {k: segments_of(drawing, k) for k in ("smooth", "outline")}
    if len(by_kind["outline"]) and len(by_kind["smooth"]):
        middle = by_kind["smooth"].mean(axis=1)
        assert distances(middle, by_kind["outline"]).min() > drawing.accuracy.used


def segments_of(drawing, kind):
    lines = [placed(drawing, line) for line in drawing.lines if line.kind == kind]
    return np.concatenate([np.zeros((0, 2, 2)), *[np.stack([p[:-1], p[1:]], axis=1) for p in lines]])


def test_seams_are_drawn_on_request_and_yield_to_outlines():
    # The seam of a cylinder lies at y = 0, x = radius: on the outline in the front view.
    assert counts(hlr.draw(cylinder(), "right", **AT_SIZE))[("seam", True)] == 0
    right = hlr.draw(cylinder(), "right", seam=True, **AT_SIZE)
    (seam,) = [line for line in right.lines if line.kind == "seam"]
    assert placed(right, seam)[:, 0] == pytest.approx([0, 0], abs=1e-6)
    assert len(outlines(right)) == 2
    (hidden,) = [line for line in hlr.draw(cylinder(), "left", seam=True, **AT_SIZE).lines if line.kind == "seam"]
    assert not hidden.visible
    front = hlr.draw(cylinder(), "front", seam=True, **AT_SIZE)
    assert len(outlines(front)) == 2
    assert not [line for line in front.lines if line.kind == "seam"]


def test_a_shaft_in_its_bore():
    plate = cad().Workplane().box(40, 40, 10).faces(">Z").workplane().hole(10)
    shaft = cad().Workplane().cylinder(30, 5)
    model = cad().Assembly().add(plate, name="plate").add(shaft, name="shaft")
    top = hlr.draw(model, "top", **AT_SIZE)
    # The rim of the bore lies under that of the shaft: one circle.
    assert counts(top) == {("sharp", True): 5}
    front = hlr.draw(model, "front", **AT_SIZE)
    sides = [line for line in front.lines if line.kind == "outline" and line.part == 1]
    assert sorted((line.visible, round(length(line), 2)) for line in sides) == [(False, 10)] * 2 + [(True, 10)] * 4
    for line in sides:
        ends = sorted(np.round(placed(front, line)[:, 1], 6))
        assert ends in ([-15, -5], [-5, 5], [5, 15])
        assert line.visible != (ends == [-5, 5])
    # Inside the plate shaft and bore touch: there is one hidden line on each side, not two.
    inner = [line for line in front.lines if not line.visible]
    assert len(inner) == 2
    iso = hlr.draw(model, "iso", **AT_SIZE)
    sharp = [line for line in iso.lines if line.kind == "sharp"]
    rim = [line for line in sharp if np.allclose(np.hypot(*line.points3[:, :2].T), 5, atol=0.05)]
    joint = [line for line in rim if np.allclose(line.points3[:, 2], 5)]
    assert sorted(line.visible for line in joint) == [False, True]
    assert sum(length(line) for line in joint if line.visible) == pytest.approx(
        sum(length(line) for line in joint) / 2, rel=0.05
    )


@pytest.mark.parametrize("view", ["front", "iso", (2, 1, 3)])
def test_a_mesh_turned_inside_out_is_drawn_like_itself(view):
    import trimesh

    mesh = trimesh.creation.cylinder(10, 40, sections=48)
    drawn, inside_out = hlr.draw(mesh, view, **AT_SIZE), hlr.draw(turned(mesh), view, **AT_SIZE)
    key = {True: 0.0, False: 0.0}
    for visible in key:
        one, other = (sum(length(x) for x in d.lines if x.visible == visible) for d in (drawn, inside_out))
        assert one == pytest.approx(other, rel=1e-6)
    assert counts(drawn) == counts(inside_out)
    (report,) = hlr.info(turned(mesh)).parts
    assert any("inside out" in defect for defect in report.defects)
    assert hlr.info(mesh).parts[0].defects == ()


def test_an_open_box_shows_its_inside():
    from support.models import box

    mesh = box((20, 20, 20))
    mesh.update_faces(mesh.face_normals[:, 2] < 0.5)
    drawing = hlr.draw(mesh, (1, -0.8, 0.5), **AT_SIZE)
    # Through the missing lid the far upright edge is seen down to where the near rim covers it: 20 nearer in x, and
    # on that way the eye's line has risen by 10.
    far = [line for line in drawing.lines if np.allclose(line.points3[:, :2], (-10, 10))]
    assert sorted(line.visible for line in far) == [False, True]
    seen = next(line for line in far if line.visible)
    assert sorted(seen.points3[:, 2]) == pytest.approx([0, 10], abs=1e-6)
    assert counts(drawing)[("boundary", True)] >= 1
    (report,) = hlr.info(mesh).parts
    assert not report.closed
    assert report.defects == ("open: 4 border edges",)
    assert report.oriented


def test_faces_that_are_there_twice_are_drawn_once_and_reported():
    import trimesh

    from support.models import box

    mesh = box((20, 20, 20))
    double = trimesh.Trimesh(mesh.vertices, np.concatenate([mesh.faces, mesh.faces[::-1]]), process=False)
    one, two = hlr.draw(mesh, "iso", **AT_SIZE), hlr.draw(double, "iso", **AT_SIZE)
    assert counts(one) == counts(two)
    assert all((a.points == b.points).all() for a, b in zip(one.lines, two.lines, strict=True))
    assert hlr.info(double).parts[0].defects == ("12 duplicated triangles",)


@pytest.mark.parametrize(("crease", "edges"), [(30.0, 0), (10.0, 24)])
def test_creases_of_a_mesh_follow_the_option(crease, edges):
    import trimesh

    # 24 sides: neighbours fold by 15 degrees.
    mesh = trimesh.creation.cylinder(10, 40, sections=24)
    drawing = hlr.draw(mesh, "front", crease=crease, **AT_SIZE)
    upright = [line for line in drawing.lines if line.kind == "sharp" and np.ptp(line.points[:, 1]) == 40]
    assert len(upright) == (0 if edges == 0 else 13)
    assert len(outlines(drawing)) == (2 if edges == 0 else 0)


def test_parts_of_any_mesh_library():
    import manifold3d
    import trimesh

    ball = manifold3d.Manifold.sphere(10, 64)
    assert counts(hlr.draw(ball, "front", crease=60.0, **AT_SIZE)) == {("outline", True): 1}
    cube = manifold3d.Manifold.cube((10, 20, 30))
    assert counts(hlr.draw(cube, "iso", **AT_SIZE)) == {("sharp", True): 9, ("sharp", False): 3}
    arrays = trimesh.creation.box((10, 20, 30))
    assert counts(hlr.draw((arrays.vertices, arrays.faces), "iso", **AT_SIZE)) == {
        ("sharp", True): 9,
        ("sharp", False): 3,
    }
    scene = trimesh.Scene()
    for x in (0, 50):
        scene.add_geometry(arrays, geom_name="cube", transform=trimesh.transformations.translation_matrix((x, 0, 0)))
    drawing = hlr.draw(scene, "iso", **AT_SIZE)
    assert len(drawing.parts) == 2
    assert counts(drawing) == {("sharp", True): 18, ("sharp", False): 6}
    assert counts(hlr.draw(parts(arrays), "front", **AT_SIZE)) == {("sharp", True): 4}
