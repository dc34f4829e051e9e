"""Cutting by the near plane and the frame: conforming surfaces, and pictures that are right from within."""

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

import hlr
from hlr import Options, Perspective
from hlr.drawing.notes import Note
from hlr.image.camera import resolve
from hlr.image.clip import Plane, clip, planes
from hlr.image.image import image_of
from hlr.scene.build import build
from hlr.source import open_source
from hlr.tables.line_classes import INTERIOR
from support.at_size import ALL_LINES, AT_SIZE
from support.invariants import check
from support.measures import counts, placed, samples, straight
from support.models import box, parts, sheet


def image_of_model(thing):
    """An image of all of a model; what cuts it looks at no camera and no scale."""
    return image_of(build(open_source(thing).mesh(0.05, 0.5), 30.0, 0.05), None, None)


def area(scene):
    a, b, c = (scene.points[scene.triangles[:, k]] for k in range(3))
    return float(np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1)).sum() / 2)


def border(scene):
    """Length of edges with one triangle."""
    lone = np.diff(scene.offsets) == 1
    d = scene.points[scene.edges[lone, 1]] - scene.points[scene.edges[lone, 0]]
    return float(np.sqrt((d**2).sum(axis=1)).sum())


def test_planes_only_for_perspective_and_a_frame_only_for_a_given_eye():
    bounds = np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])

    def count(perspective):
        camera = resolve("iso", Options(perspective=perspective, **AT_SIZE), open_source(box((2, 2, 2))).frame, bounds)
        return len(planes(camera, 4 / 3))

    assert count(None) == 0
    assert count(Perspective()) == 1
    assert count(Perspective(fov=20.0)) == 1
    assert count(Perspective(eye=(9, 9, 9))) == 5


def test_what_no_plane_crosses_stays_as_it_is():
    scene = image_of_model(box((2, 2, 2)))
    same, cuts = clip(scene, [Plane((0, 0, 1), -1.0), Plane((1, 0, 0), -5.0)])
    assert cuts == 0
    assert same is scene


def test_a_box_cut_in_half():
    scene = image_of_model(parts(box((2, 2, 2)), box((2, 2, 2), (10, 0, 5))))
    cut, cuts = clip(scene, [Plane((0, 0, 1), 0.0)])
    check(cut)
    assert cuts == 1
    assert area(cut) == pytest.approx(4 + 4 * 2 + 24)
    assert border(cut) == pytest.approx(8)
    # The cut box is open now and may be looked into; the other is as it was.
    assert cut.groups.closed.tolist() == cut.groups.cull.tolist() == [False, True]
    used = np.unique(cut.edges)
    assert cut.points[used, 2].min() == 0
    # Of the first box: 4 edges above, 4 cut in half.
    mine = (cut.edge_part == 0) & (cut.edge_kind != INTERIOR)
    d = cut.points[cut.edges[mine, 1]] - cut.points[cut.edges[mine, 0]]
    assert sorted(np.abs(d).sum(axis=1).tolist()) == [1, 1, 1, 1, 2, 2, 2, 2]


def test_all_of_it_cut_away():
    scene = image_of_model(box((2, 2, 2)))
    cut, cuts = clip(scene, [Plane((0, 0, 1), 5.0)])
    assert (cuts, len(cut.triangles), len(cut.edges)) == (1, 0, 0)
    check(cut)


unit = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)
cutting = st.lists(st.tuples(unit, st.integers(-6, 6)), min_size=1, max_size=4)


@pytest.mark.slow
@given(cutting, st.sampled_from(["mesh", "wires", "torus"]))
@settings(max_examples=80, deadline=None)
def test_any_cuts_leave_a_scene_that_agrees(cuts, kind):
    scene = SCENES[kind]()
    chosen = [Plane(tuple(map(float, normal)), float(offset)) for normal, offset in cuts]
    cut, _ = clip(scene, chosen)
    check(cut, gaps=True)
    corners = cut.points[np.unique(cut.edges)]
    for plane in chosen:
        assert (plane.height(corners) >= -1e-9).all()
    # Nothing is lost or made: cut by the opposite planes, the pieces add up.
    rest, whole = 0.0, scene
    for plane in chosen:
        away, _ = clip(whole, [Plane(tuple(-c for c in plane.normal), -plane.offset)])
        rest += area(away)
        whole, _ = clip(whole, [plane])
    flat = area(scene)
    # What lies in a plane belongs to both sides.
    assert rest + area(whole) >= flat * (1 - 1e-9)
    assert area(whole) == pytest.approx(area(cut))


def test_a_chain_that_a_cut_divides_becomes_several():
    cut, _ = clip(SCENES["torus"](), [Plane((0.0, 0.0, -1.0), 0.0)])
    check(cut)


def test_no_line_runs_across_what_the_frame_cut_away():
    import cadquery as cq

    eye = Perspective(eye=(0, 0, 150), target=(0, 0, 1), fov=60.0)
    drawing = hlr.draw(cq.Workplane().cylinder(2, 100), "top", perspective=eye, **AT_SIZE)
    for line in drawing.lines:
        # Each is an arc of one of both rims: nowhere near the middle.
        assert np.hypot(*samples(segments_of(drawing, line), 1.0).T).min() > 95


@pytest.mark.parametrize("normal", [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (2, 1, 0), (-1, 2, 0)])
def test_what_is_left_of_a_border_is_walked_as_before(normal):
    scene = image_of_model(sheet(10, 0.0))
    (kept,) = np.unique(scene.walks.kind)
    cut, _ = clip(scene, [Plane(tuple(map(float, normal)), 0.0)])
    chains = cut.walks
    # A closed walk begins anywhere: the stretch that it lost may leave it in two.
    assert chains.kind.tolist() in ([kept], [kept, kept])
    walked = cut.edges[chains.edges]
    walked[chains.reversed] = walked[chains.reversed][:, ::-1]
    # A closed walk that lost one stretch has at most one gap.
    assert (walked[1:, 0] != walked[:-1, 1]).sum() <= 1


def segments_of(drawing, line):
    points = placed(drawing, line)
    return np.stack([points[:-1], points[1:]], axis=1)


def lazily(make):
    made = []
    return lambda: made[0] if made else made.append(make()) or made[0]


def wires():
    import cadquery as cq

    return cq.Compound.makeCompound([cq.Solid.makeBox(5, 5, 5), cq.Edge.makeCircle(4)])


def torus():
    import cadquery as cq

    return cq.Solid.makeTorus(5, 2)


SCENES = {
    "mesh": lazily(lambda: image_of_model(parts(box((4, 4, 4)), box((6, 2, 2), (1, 0, 1))))),
    "wires": lazily(lambda: image_of_model(wires())),
    "torus": lazily(lambda: image_of_model(torus())),
}


def room(**camera):
    return hlr.draw(box((100, 100, 100)), "front", perspective=Perspective(**camera), **AT_SIZE)


def test_a_room_is_seen_from_within():
    drawing = room(eye=(0, -40, 0), target=(0, 0, 0), fov=90.0)
    assert counts(drawing) == {("sharp", True): 8}
    # The far wall, 90 away, on the plane 40 away; and the four edges that run toward the eye, as far as the frame.
    h = round(50 * 40 / 90, 6)
    wall = [(-h, -h), (h, -h), (h, h), (-h, h)]
    expected = {(*sorted((a, b)), True) for a, b in zip(wall, wall[1:] + wall[:1], strict=True)}
    expected |= {(*sorted((a, (math.copysign(40, a[0]), math.copysign(40, a[1])))), True) for a in wall}
    assert set(straight(drawing)) == expected


def test_a_column_in_a_room_hides_what_lies_behind_it():
    model = parts(box((100, 100, 100)), box((4, 4, 100), (0, 0, 0)))
    drawing = hlr.draw(model, "front", perspective=Perspective(eye=(0, -40, 0), target=(0, 0, 0), fov=90.0), **AT_SIZE)
    far = [line for line in drawing.lines if line.part == 0 and np.allclose(line.points3[:, 1:], (50, 50))]
    assert [line.visible for line in far] == [True, False, True]
    # The column's front corners are 38 away, the wall 90.
    hidden = next(line for line in far if not line.visible)
    assert sorted(hidden.points3[:, 0]) == pytest.approx([-2 * 90 / 38, 2 * 90 / 38], abs=1e-3)


def test_what_lies_behind_the_eye_is_not_drawn():
    one = box((10, 10, 10))
    camera = Perspective(eye=(0, -100, 0), target=(0, 0, 0), fov=60.0)
    alone = hlr.draw(one, "front", perspective=camera, **AT_SIZE)
    more = hlr.draw(parts(one, box((10, 10, 10), (0, -300, 0))), "front", perspective=camera, **AT_SIZE)
    assert straight(more) == straight(alone)
    assert more.counters["clipping_planes"] >= 1


def test_the_field_of_view_crops_only_from_a_given_eye():
    whole = hlr.draw(box((10, 20, 30)), "front", perspective=Perspective(fov=5.0), **AT_SIZE)
    assert whole.counters["clipping_planes"] == 0
    assert counts(whole)[("sharp", True)] == 4
    eye = Perspective(eye=(0, -100, 0), target=(0, 0, 0), fov=10.0)
    cropped = hlr.draw(box((10, 20, 30)), "front", perspective=eye, **AT_SIZE)
    half = 100 * math.tan(math.radians(5))
    height = cropped.bounds[3]
    assert height == pytest.approx(2 * half)
    for line in cropped.lines:
        assert (np.abs(placed(cropped, line)[:, 1]) <= half + 1e-9).all()
    # 4 : 3, or as what it is fitted into.
    wide = hlr.draw(box((500, 20, 3)), "front", perspective=eye, **AT_SIZE)
    assert wide.bounds[2] == pytest.approx(2 * half * 4 / 3)
    square = hlr.draw(box((500, 20, 3)), "front", perspective=eye, fit=(70.0, 70.0), **ALL_LINES)
    assert square.bounds[2] / square.scale == pytest.approx(2 * half)


def test_without_an_eye_and_nothing_behind_it_all_of_the_model_is_drawn():
    mesh = trimesh.creation.icosphere(2, 10)
    drawing = hlr.draw(mesh, "iso", perspective=Perspective(fov=120.0), crease=1.0, **AT_SIZE)
    assert drawing.counters["clipping_planes"] == 0
    assert drawing.notes == ()


def test_a_corner_in_the_plane_of_the_eye_is_no_obstacle():
    # The box stands beside the eye; its front corners are exactly as far along the view as the eye.
    drawing = hlr.draw(
        parts(box((10, 10, 10), (0, 100, 0)), box((100, 100, 100), (0, 0, -200))),
        "front",
        perspective=Perspective(eye=(0, -50, 0), target=(0, 100, 0), fov=60.0),
        **AT_SIZE,
    )
    assert counts(drawing)[("sharp", True)] >= 4


@pytest.mark.parametrize("beside", [1e-6, 1e-9, 1e-12])
def test_a_corner_close_to_the_plane_of_the_eye_spoils_nothing(beside):
    model = box((100, 100, 100))
    far = hlr.draw(model, "front", perspective=Perspective(eye=(0, -49, 20), target=(0, 0, 20), fov=100.0), **AT_SIZE)
    near = hlr.draw(
        model, "front", perspective=Perspective(eye=(0, -50 + beside, 20), target=(0, 0, 20), fov=100.0), **AT_SIZE
    )
    assert counts(near) == counts(far)


PAST = "no line of the model lies in this view: the eye looks past it, or at a face that fills the view."


def test_an_eye_that_sees_nothing_says_so():
    away = Perspective(eye=(0, -100, 0), target=(0, -200, 0), fov=40.0)
    drawing = hlr.draw(box((10, 10, 10)), "front", perspective=away, **AT_SIZE)
    assert drawing.lines == ()
    assert drawing.notes == (Note("nothing-in-view", PAST),)
    assert drawing.bounds == (0, 0, 0, 0)


def test_a_wall_that_fills_the_view_is_no_line():
    within = Perspective(eye=(0, 0, 0), target=(0, 10, 0), fov=40.0)
    assert hlr.draw(box((10, 10, 10)), "front", perspective=within, **AT_SIZE).notes == (Note("nothing-in-view", PAST),)
    assert hlr.draw(box((10, 10, 10)), "front", perspective=within, fill=True, **AT_SIZE).notes == ()
