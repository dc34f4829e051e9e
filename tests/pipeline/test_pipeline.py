"""The whole pipeline from Python: one reading for all views, the same bytes every time, pictures that keep still."""

import hashlib
import json
import subprocess
import sys

import cadquery as cq
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pipeline.models import FORMATS, MODELS, VIEWS, bare, bracket, clash

import hlr
from hlr import Options, Perspective, StrictError
from hlr.drawing.saving import render
from hlr.pipeline import session
from support.at_size import ALL_LINES, AT_SIZE
from support.measures import apart, counts, placed, segments, straight
from support.models import box, parts, rotation, solids
from support.programs import environment


def glb(folder):
    """A box of 1 x 2 x 3 metres whose 3 stand upright: y in the file."""
    path = folder / "tower.glb"
    parts(box((1, 3, 2), (0, 1.5, 0))).export(path)
    return path


CAMERAS = {
    "parallel": {},
    "half": {"scale": 0.5},
    "perspective": {"perspective": Perspective(fov=50.0)},
    "eye": {"perspective": Perspective(eye=(60, -80, 50), target=(1, 2, 3), fov=20.0), "scale": 2.0},
}


PARALLEL = [(model, camera) for model in MODELS for camera in ("parallel", "half")]


@pytest.mark.slow
@pytest.mark.parametrize(("model", "camera"), [*PARALLEL, ("ball", "perspective"), ("ball", "eye"), ("mesh", "eye")])
def test_points_on_paper_are_points_of_the_model(model, camera):
    views = VIEWS[:1] if camera == "eye" else VIEWS
    for drawing in hlr.draw_views(MODELS[model](), views, Options(**AT_SIZE | CAMERAS[camera])):
        assert drawing.lines
        expect_projected(drawing)


@pytest.mark.parametrize(
    ("model", "camera"),
    [
        ("bracket", "perspective"),
        ("clash", "perspective"),
        ("mesh", "perspective"),
        ("bracket", "eye"),
        ("clash", "eye"),
    ],
)
def test_in_perspective_too_points_on_paper_are_points_of_the_model(model, camera):
    test_points_on_paper_are_points_of_the_model(model, camera)


def expect_projected(drawing):
    view = drawing.view
    right, up, direction = (np.asarray(v) for v in (view.right, view.up, view.direction))
    for line in drawing.lines:
        p = line.points3
        assert len(p) == len(line.points) >= 2
        if view.projection == "perspective":
            eye = np.asarray(view.eye)
            target = eye - view.distance * direction
            assert np.allclose(target, view.target)
            # Along the ray from the eye to the plane through the target.
            t = ((target - eye) @ direction) / ((p - eye) @ direction)
            p = eye + (p - eye) * t[:, None]
            flat = np.stack([(p - eye) @ right, (p - eye) @ up], axis=1)
        else:
            flat = np.stack([p @ right, p @ up], axis=1)
        expected = flat * drawing.unit * drawing.scale - drawing.origin
        assert np.abs(expected - line.points).max() < 0.1 * drawing.accuracy.used


def test_a_file_in_metres_with_y_up(tmp_path):
    front, top = hlr.draw_views(glb(tmp_path), ["front", "top"], Options(scale=0.01, **ALL_LINES))
    document = json.loads(render(front, "json"))
    assert document["model"] == {"unit": 1000, "up_axis": [[1, 0, 0], [0, 0, -1], [0, 1, 0]]}
    # 1 m wide and 3 m high, at 1:100; from above 1 m by 2 m.
    assert front.bounds == pytest.approx((0, 0, 10, 30))
    assert top.bounds == pytest.approx((0, 0, 10, 20))
    # View and points are in the file's own coordinates.
    assert document["view"]["up"] == [0, 1, 0]
    assert document["view"]["direction"] == [0, 0, 1]
    heights = {p[1] for line in document["lines"] for p in line["points3"]}
    assert heights == {0, 3}
    for drawing in (front, top):
        expect_projected(drawing)
    info = hlr.info(glb(tmp_path))
    assert info.unit == 1000


def test_several_views_read_and_mesh_once(monkeypatch):
    seen = {"open": 0, "mesh": 0, "build": 0}
    real_open, real_build = session.open_selected, session.build

    def opening(thing, options):
        seen["open"] += 1
        source = real_open(thing, options)
        mesh = source.mesh

        def meshing(*arguments):
            seen["mesh"] += 1
            return mesh(*arguments)

        source.mesh = meshing
        return source

    def building(*arguments):
        seen["build"] += 1
        return real_build(*arguments)

    monkeypatch.setattr(session, "open_selected", opening)
    monkeypatch.setattr(session, "build", building)
    drawings = hlr.draw_views(bracket(), ["front", "top", "right", "iso"], hlr.Options(**AT_SIZE))
    assert [d.view.name for d in drawings] == ["front", "top", "right", "iso"]
    assert seen == {"open": 1, "mesh": 1, "build": 1}


def test_views_drawn_together_are_those_drawn_alone():
    for model in (bracket(), MODELS["mesh"]()):
        options = Options(accuracy=0.02, **AT_SIZE)
        for view, drawing in zip(VIEWS, hlr.draw_views(model, VIEWS, options), strict=True):
            assert bare(drawing, "json") == bare(hlr.draw(model, view, accuracy=0.02, **AT_SIZE), "json")


@pytest.mark.parametrize("model", MODELS)
def test_any_number_of_threads_gives_the_same_bytes(model):
    for view in ("iso", (2.0, 1.0, -3.0)):
        drawings = [hlr.draw(MODELS[model](), view, threads=n, smooth=True, scale=1.0, hidden=True) for n in (1, 2, 4)]
        for kind in FORMATS:
            assert len({bare(drawing, kind) for drawing in drawings}) == 1


@pytest.mark.parametrize("model", ["bracket", "clash", "ball"])
def test_the_same_object_drawn_twice_is_the_same_drawing(model):
    thing = MODELS[model]()
    assert bare(hlr.draw(thing, **AT_SIZE), "json") == bare(hlr.draw(thing, **AT_SIZE), "json")


PROGRAM = """
import hashlib, sys
import hlr
from pipeline.models import FORMATS, MODELS, VIEWS, bare
from support.at_size import AT_SIZE
for name in MODELS:
    for drawing in hlr.draw_views(MODELS[name](), VIEWS, hlr.Options(**AT_SIZE)):
        print(name, *(hashlib.sha256(bare(drawing, kind)).hexdigest() for kind in FORMATS))
"""


@pytest.mark.slow
def test_another_process_gives_the_same_bytes():
    command = [sys.executable, "-P", "-c", PROGRAM]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment())
    here = []
    for name, make in MODELS.items():
        for drawing in hlr.draw_views(make(), VIEWS, hlr.Options(**AT_SIZE)):
            here.append(" ".join([name, *(hashlib.sha256(bare(drawing, kind)).hexdigest() for kind in FORMATS)]))
    assert done.stdout.splitlines() == here


def crowd(order):
    """Boxes that overlap, touch, and stand clear, in any order."""
    sizes = [((20, 20, 20), (0, 0, 0)), ((40, 4, 4), (0, 0, 0)), ((8, 8, 8), (0, 0, 14)), ((5, 60, 5), (3, 30, -7))]
    return parts(*(box(*sizes[i]) for i in order)), sizes


@pytest.mark.parametrize("order", [(3, 2, 1, 0), (1, 3, 0, 2), (2, 0, 3, 1)])
@pytest.mark.parametrize("view", VIEWS)
def test_the_order_of_parts_does_not_matter(order, view):
    one, other = hlr.draw(crowd(range(4))[0], view, **AT_SIZE), hlr.draw(crowd(order)[0], view, **AT_SIZE)
    assert straight(one) == straight(other)

    def owned(drawing, names):
        # Of an intersection, the part with the lower number is named first.
        def owners(line):
            return tuple(sorted(names[p] for p in (line.part, line.other) if p is not None))

        return sorted(
            (owners(x), x.kind, x.visible, *map(tuple, np.round(placed(drawing, x), 6))) for x in drawing.lines
        )

    if view != "front":
        # Seen along an axis, lines of several parts coincide, and which of them is drawn is open.
        assert owned(one, range(4)) == owned(other, order)


@pytest.mark.parametrize("view", VIEWS)
def test_what_stands_behind_or_beside_changes_no_visible_line(view):
    base = [((20, 20, 20), (0, 0, 0)), ((40, 4, 4), (0, 0, 0))]
    alone = hlr.draw(parts(*(box(*b) for b in base)), view, accuracy=0.02, **AT_SIZE)
    d = np.asarray(alone.view.direction)
    right = np.asarray(alone.view.right)
    behind = box((6, 6, 6), tuple(-60 * d))
    beside = box((6, 6, 6), tuple(90 * right))
    after = hlr.draw(parts(*(box(*b) for b in base), behind), view, accuracy=0.02, **AT_SIZE)
    # The grid of integers is laid anew for the larger scene: equal but for rounding. Intersection lines lie on surfaces
    # up to that rounding, and where they dive behind one is known to within a tolerance of a fiftieth of the accuracy.
    near = 0.02 / 50
    assert apart(segments(after, True), segments(alone, True)) < near
    after = hlr.draw(parts(*(box(*b) for b in base), beside), view, accuracy=0.02, **AT_SIZE)
    for visible in (True, False):
        mine = segments(after, visible)
        mine = mine[(np.abs(mine[:, :, 0]) < 60).all(axis=1)]
        assert apart(mine, segments(alone, visible)) < near


def test_what_stands_before_hides():
    alone = hlr.draw(solids(((20, 20, 20), (0, 0, 0))), "front", **AT_SIZE)
    covered = hlr.draw(solids(((20, 20, 20), (0, 0, 0)), ((60, 1, 60), (0, -30, 0))), "front", **AT_SIZE)
    assert {k[:2] for k in straight(covered, False)} == {k[:2] for k in straight(alone, True)}


@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda a: np.linalg.norm(a) > 0.1), st.floats(0.1, 3))
@settings(max_examples=15, deadline=None)
def test_model_and_camera_turned_together_give_the_same_picture(axis, angle):
    turn = rotation(axis, angle)
    meshes = [box((20, 20, 20)), box((40, 4, 4), (0, 1, 2)), box((9, 8, 7), (5, -14, 9))]
    still = hlr.draw(parts(*meshes), (3, -2, 1.5), up=(0, 0, 1), **AT_SIZE)
    for mesh in meshes:
        mesh.vertices = mesh.vertices @ turn.T
    turned = hlr.draw(parts(*meshes), tuple(turn @ (3, -2, 1.5)), up=tuple(turn @ (0, 0, 1)), **AT_SIZE)
    for visible in (True, False):
        assert apart(segments(still, visible), segments(turned, visible)) < still.accuracy.used


def test_moving_the_model_moves_only_the_origin():
    meshes = [box((20, 20, 20)), box((40, 4, 4), (0, 1, 2))]
    still = hlr.draw(parts(*meshes), "iso", **AT_SIZE)
    for mesh in meshes:
        mesh.apply_translation((1024.0, -512.0, 256.0))
    moved = hlr.draw(parts(*meshes), "iso", **AT_SIZE)
    assert counts(moved) == counts(still)
    for a, b in zip(still.lines, moved.lines, strict=True):
        assert a.points == pytest.approx(b.points, abs=1e-6)


def test_hidden_lines_can_be_left_out():
    with_, without = (hlr.draw(clash(), "iso", hidden=h, scale=1.0, smooth=False) for h in (True, False))
    assert straight(without) == straight(with_, True)
    assert all(line.visible for line in without.lines)


def test_times_and_progress():
    told = []
    drawing = hlr.draw(bracket(), "iso", progress=lambda stage, done: told.append((stage, done)), **AT_SIZE)
    stages = ("source", "tessellate", "scene", "plan", "visibility", "linework")
    assert set(drawing.timings) == {*stages, "total"}
    assert drawing.timings["total"] == pytest.approx(sum(drawing.timings[s] for s in stages))
    assert all(seconds >= 0 for seconds in drawing.timings.values())
    assert [stage for stage in dict(told) if stage in stages] == [
        "source",
        "tessellate",
        "scene",
        "visibility",
        "linework",
    ]
    assert all(0 <= done <= 1 for _, done in told)


def test_saving_and_reading_back(tmp_path):
    drawing = hlr.draw(bracket(), "iso", **AT_SIZE)
    for kind in FORMATS:
        path = drawing.save(tmp_path / f"part.{kind}")
        assert path.read_bytes()[:1] in (b"{", b"<", b"%")
    document = json.loads((tmp_path / "part.json").read_text())
    assert len(document["lines"]) == len(drawing.lines)
    with pytest.raises(hlr.WriteError):
        drawing.save(tmp_path / "part.dwg")


def test_strict_turns_a_warning_into_an_error():
    opened = box((10, 10, 10))
    opened.update_faces(opened.face_normals[:, 2] < 0.5)
    assert hlr.draw(opened, "front", **AT_SIZE).notes
    with pytest.raises(StrictError, match="is drawn as it is: open"):
        hlr.draw(opened, "front", strict=True, **AT_SIZE)
    hlr.draw(box((10, 10, 10)), "front", strict=True, **AT_SIZE)


def test_strict_minds_every_view(monkeypatch):
    # 3 mm seen from the front, 9 mm seen from above. The remark about that stands for a warning.
    monkeypatch.setattr("hlr.drawing.notes.REMARKS", frozenset())
    model = box((2, 9, 2))
    assert not hlr.draw(model, "top", **AT_SIZE).notes
    with pytest.raises(StrictError):
        hlr.draw_views(model, ["top", "front"], Options(strict=True, **AT_SIZE))


def test_info_of_a_model():
    info = hlr.info(clash())
    assert (info.kind, info.unit) == ("object", 1.0)
    assert [(p.faces, p.edges, p.solids, p.closed, p.oriented, p.defects) for p in info.parts] == [
        (6, 12, 1, True, True, ()),
        (3, 3, 1, True, True, ()),
    ]
    assert info.bounds[0] == pytest.approx((-10, -10, -20), abs=1e-3)
    mesh = hlr.info(parts(box((1, 2, 3))))
    assert (mesh.parts[0].triangles, mesh.parts[0].edges, mesh.parts[0].faces) == (12, 12, 0)
    assert mesh.bounds == ((-0.5, -1, -1.5), (0.5, 1, 1.5))


def test_each_part_keeps_its_name_color_and_place():
    red = cq.Color(1, 0, 0)
    model = cq.Assembly().add(cq.Workplane().box(1, 1, 1), name="pin", color=red, loc=cq.Location((5, 6, 7)))
    (part,) = hlr.draw(model, "front", scale=20.0, **ALL_LINES).parts
    assert part.name == "pin"
    assert part.color == pytest.approx((1, 0, 0))
    assert part.transform[:3, 3] == pytest.approx((5, 6, 7))


def test_the_work_is_bounded_by_the_page_and_not_by_the_model():
    """On the same page a model a thousand times as large has the same triangles, edges and lines."""
    small, large = (hlr.draw(cq.Workplane("XY").sphere(10 * k).faces(), "front") for k in (1, 1000))
    assert small.scale == 1000 * large.scale
    counted = ("triangles", "drawn")
    assert [small.counters[name] for name in counted] == [large.counters[name] for name in counted]
    assert len(small.lines) == len(large.lines)
