"""Each effect has a scene that calls for it and one that does not; what is off does nothing, and on changes nothing."""

import json
import pickle
from dataclasses import replace
from pathlib import Path

import cadquery as cq
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

import hlr
from hlr import Options, Perspective
from hlr.drawing.saving import render
from hlr.pipeline import session
from hlr.pipeline.draw import draw_views
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import PLAN, SCENE, Decision, Decisions, Facts, Planner, everything_on, explained
from hlr.visibility.segments import solve
from support.at_size import ALL_LINES, AT_SIZE
from support.brep_shapes import scrawled_cylinder
from support.models import box, parts, rotation, sheet, solids

DATA = Path(__file__).resolve().parents[1] / "data"
INSIDE = Perspective(eye=(3, -12, 2), target=(0, 0, 0), fov=60.0)


def decided(drawing):
    return {d.name: d for d in drawing.plan}


def ball():
    return cq.Workplane().sphere(9)


def crowd(count):
    """Little boxes far from one another, in depth as well."""
    n = round(count ** (1 / 3)) + 1
    places = [(40.0 * (i % n), 40.0 * (i // n % n), 40.0 * (i // n**2)) for i in range(count)]
    corners, faces = box((20, 20, 20)).vertices, box((20, 20, 20)).faces
    vertices = np.concatenate([corners + p for p in places])
    return vertices, np.concatenate([faces + 8 * i for i in range(count)])


def rods_behind_a_plate():
    """Some of them stand out beside it. Their own faces are seen edge-on along all their outlines and rims."""
    plate = cq.Solid.makeBox(90, 1, 90, cq.Vector(-45, -40, -45))
    rods = [
        cq.Solid.makeCylinder(2, 9)
        .rotate(cq.Vector(), cq.Vector(1, 1, 0), 17 * i)
        .translate(cq.Vector(13 * i - 52, 0, i))
        for i in range(9)
    ]
    return cq.Compound.makeCompound([plate, *rods, *(rod.translate(cq.Vector(0, 60, 3)) for rod in rods)])


APART = (((20, 20, 20), (0, 0, 0)), ((20, 20, 20), (60, 0, 0)))
TOUCHING = (((20, 20, 20), (0, 0, 0)), ((20, 20, 20), (20, 0, 0)))
CROSSING = (((20, 20, 20), (0, 0, 0)), ((40, 4, 4), (0, 0, 0)))


def twice():
    mesh = box((20, 20, 20))
    return trimesh.Trimesh(mesh.vertices, np.concatenate([mesh.faces, mesh.faces[:1]]), process=False)


def two_sheets(gap):
    """Side by side, nearly."""
    one = sheet(20, 0)
    vertices = np.concatenate([one.vertices, one.vertices + [20 + gap, 0, 0]])
    return vertices, np.concatenate([one.faces, one.faces + len(one.vertices)])


# Effect: a scene that calls for it, one that does not; options of either.
SCENES = {
    "fine mesh": ((lambda: cq.Workplane().box(9, 8, 7), {}), (ball, {})),
    "meshing of curved faces": ((ball, {}), (lambda: cq.Workplane().box(9, 8, 7), {})),
    "triangulation of planar faces": ((lambda: cq.Workplane().box(9, 8, 7), {}), (ball, {})),
    "finer mesh where parts touch": ((lambda: solids(*TOUCHING), {}), (lambda: solids(*APART), {})),
    "rescue of faces": ((lambda: scrawled_cylinder()[0], {}), (ball, {})),
    "repair": ((twice, {}), (lambda: box((20, 20, 20)), {})),
    "stitching of borders": ((lambda: two_sheets(1e-4), {}), (lambda: box((20, 20, 20)), {})),
    "intersection search": ((lambda: solids(*CROSSING), {}), (lambda: solids(*APART), {})),
    "outlines": ((ball, {}), (lambda: solids(*APART), {})),
    "near clipping": (
        (lambda: box((20, 20, 20)), {"perspective": INSIDE}),
        (lambda: box((4, 4, 4)), {"perspective": INSIDE}),
    ),
    "side clipping": (
        (lambda: box((90, 4, 4)), {"perspective": INSIDE}),
        (lambda: box((2, 2, 2)), {"perspective": INSIDE}),
    ),
    "perspective divide": ((ball, {"perspective": Perspective()}), (ball, {})),
    "back-face culling": ((ball, {}), (lambda: sheet(20, 0), {})),
    "crossing search": ((lambda: solids(*APART), {}), (lambda: cq.Workplane().box(9, 8, 7), {})),
    "depth pyramid": ((lambda: crowd(450), {"scale": 0.2}), (lambda: crowd(8), {})),
    "piercing search": ((lambda: solids(*CROSSING), {}), (lambda: solids(*APART), {})),
    "contact tolerance": ((lambda: solids(*TOUCHING), {}), (lambda: solids(*APART), {})),
    "exact curves": ((ball, {}), (lambda: solids(*APART), {})),
}


def test_every_effect_of_the_scene_has_its_scenes():
    assert set(SCENES) == {effect.name for effect in drawing_effects() if effect.origin == SCENE}


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_scene_that_calls_for_it_and_one_that_does_not(name):
    (calls, its), (not_, other) = SCENES[name]
    on, off = hlr.draw(calls(), **AT_SIZE | its), hlr.draw(not_(), **AT_SIZE | other)
    assert decided(on)[name].on
    # What may only touch may turn out not to; and a fine mesh has its triangles counted where it is made.
    assert any(decided(on)[name].counts.values()) or name in ("contact tolerance", "piercing search", "fine mesh")
    assert not decided(off)[name].on
    assert not any(decided(off)[name].counts.values()) and decided(off)[name].seconds is None
    expect_neutral(not_, **other)


ASKED = {
    "hidden lines": {"hidden": True},
    "smooth edges": {"smooth": True},
    "seams": {"seam": True},
    "intersection lines": {"intersections": True},
    "fill": {"fill": True},
    "colours": {"fill": True},
}


@pytest.mark.slow
@pytest.mark.parametrize("name", ASKED)
def test_what_is_asked_for_is_on_and_nothing_else(name):
    model = cq.Workplane().cylinder(20, 8).faces(">Z").edges().fillet(2).union(cq.Workplane().box(4, 40, 4))
    asked = cq.Assembly().add(model).add(cq.Workplane().box(30, 3, 3))
    off = {option: False for option in ASKED[name]}
    for options, on in ((ASKED[name], True), (off, False)):
        found = decided(hlr.draw(asked, (2, -1, 1), **AT_SIZE | options))[name]
        assert (found.on, found.origin) == (on, "asked")
        assert any(found.counts.values()) == on


def test_circles_of_meshes():
    rod = trimesh.creation.cylinder(10, 20, sections=48)
    for circles in (True, False):
        found = decided(hlr.draw(rod, circles=circles, **AT_SIZE))["circles of meshes"]
        assert found.on == circles and any(found.counts.values()) == circles


def test_readers():
    mesh, brep = decided(hlr.draw(box((9, 8, 7)), **AT_SIZE)), decided(hlr.draw(cq.Workplane().box(9, 8, 7), **AT_SIZE))
    for one, other, reader in ((mesh, brep, "mesh reader"), (brep, mesh, "B-rep reader")):
        assert one[reader].on and any(one[reader].counts.values())
        assert not other[reader].on and not any(other[reader].counts.values())


def exact(drawing):
    """All that is drawn, to the last bit; and what is written of it, but for plan, counters and times."""
    document = json.loads(render(drawing, "json"))
    for name in ("plan", "counters", "timings"):
        del document[name]
    lines = [(x.kind, x.visible, x.part, x.edge, x.points.tobytes(), x.points3.tobytes()) for x in drawing.lines]
    return lines, document, render(drawing, "svg")


def expect_neutral(make, views=("iso",), **options):
    """Forced on, what the plan left off changes nothing. Returns the drawings."""
    wish = (ALL_LINES if "fit" in options else AT_SIZE) | options
    plain = hlr.draw_views(make(), views, Options(**wish))
    with everything_on():
        forced = hlr.draw_views(make(), views, Options(**wish))
    for one, other in zip(plain, forced, strict=True):
        assert exact(one) == exact(other)
        assert all(d.on for d in other.plan if d.origin == SCENE)
        for d in one.plan:
            assert d.on or not any(d.counts.values()), d
    return plain


CAMERAS = {"parallel": {}, "visible": {"hidden": False}, "perspective": {"perspective": Perspective()}}


CASES = [("as1-oc-214.stp", camera) for camera in CAMERAS]
CASES += [("nist_ctc_01_asme1_ap242-e1.stp", "visible"), ("soup.stl", "parallel"), ("cube_gears.3mf", "perspective")]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "camera"), CASES)
def test_forcing_changes_nothing_of_real_models(name, camera):
    expect_neutral(lambda: DATA / name, [(1, -2, 1.5)], fit=(180, 120), **CAMERAS[camera])


@pytest.mark.slow
@pytest.mark.parametrize("view", ["front", "top", "iso", (1.0, 0.3, 0.2)])
@pytest.mark.parametrize(
    "perspective", [None, Perspective(), Perspective(eye=(60, -80, 50), target=(1, 2, 3), fov=20.0)]
)
def test_forcing_changes_nothing_of_convex_bodies(view, perspective):
    bodies = [
        lambda: cq.Workplane().box(9, 8, 7),
        lambda: cq.Workplane().cylinder(20, 5).rotate((0, 0, 0), (1, 2, 3), 40),
        lambda: cq.Workplane().box(9, 8, 7).edges("|Z").fillet(1),
        lambda: trimesh.creation.icosphere(2, 10),
    ]
    for make in bodies:
        (drawing,) = expect_neutral(make, [view], perspective=perspective)
        assert not decided(drawing)["crossing search"].on
    # Tessellations of a sphere and a cone may have dents: these are searched.
    expect_neutral(ball, [view], perspective=perspective)
    expect_neutral(lambda: cq.Workplane(obj=cq.Solid.makeCone(8, 3, 12)), [view], perspective=perspective)


def test_straight_edges_that_a_file_writes_as_splines():
    # Two planes have a straight line in common, however it is written; so no curve is looked for, and none is used.
    box = cq.Workplane().box(9, 8, 7).val()
    from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

    splines = cq.Shape.cast(BRepBuilderAPI_NurbsConvert(box.wrapped).Shape())
    (drawing,) = expect_neutral(lambda: splines, [(1, -2, 1.5)])
    assert decided(drawing)["exact curves"].counts["curves_sought"] == 0
    assert [x.points.tolist() for x in drawing.lines] == [
        x.points.tolist() for x in hlr.draw(box, (1, -2, 1.5), **AT_SIZE).lines
    ]


directions = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda a: np.linalg.norm(a) > 0.1)


@pytest.mark.slow
@given(st.integers(0, 2**32), directions, st.booleans(), st.sampled_from([None, Perspective()]))
@settings(max_examples=15, deadline=None)
def test_forcing_changes_nothing_of_random_boxes(seed, view, hidden, perspective):
    rng = np.random.default_rng(seed)
    meshes = []
    for _ in range(rng.integers(1, 6)):
        mesh = box(tuple(rng.integers(1, 12, 3)), tuple(rng.integers(-9, 9, 3)))
        if rng.random() < 0.5:
            mesh.vertices = mesh.vertices @ rotation(tuple(rng.normal(size=3)), rng.random()).T
        meshes.append(mesh)
    expect_neutral(lambda: parts(*meshes), [view], hidden=hidden, perspective=perspective)


@given(st.integers(0, 2**32), st.integers(4, 40), directions)
@settings(max_examples=25, deadline=None)
def test_culling_alone_says_of_convex_bodies_what_the_search_says(seed, count, view):
    points = np.random.default_rng(seed).normal(size=(count, 3)) * 20
    hull = trimesh.Trimesh(points).convex_hull
    plain, found = both(hull, view, "crossings")
    assert found.found.counters["by_culling_alone"] > 0 and found.found.counters["seeds"] == 0
    expect_same_pieces(plain, found)


@pytest.mark.parametrize("view", ["front", "iso", (1.0, 0.2, 0.1)])
def test_what_the_pyramid_discards_is_hidden(view):
    for make in (
        lambda: crowd(300),
        rods_behind_a_plate,
        lambda: parts(box((90, 1, 90), (0, -40, 0)), *[box((3, 3, 3), (i, 0, 0)) for i in range(9)]),
    ):
        plain, found = both(make(), view, "pyramid")
        expect_same_pieces(plain, found)
        if view == "front" and make is rods_behind_a_plate:
            assert found.found.counters["freed_of_own_faces"] < plain.found.counters["freed_of_own_faces"]
        elif view == "front" and len(plain.found.facing) < 1000:
            # All edges of the boxes behind the plate that are not seen end-on.
            assert found.found.counters["hidden_by_pyramid"] == 9 * 8
        assert plain.found.counters["hidden_by_pyramid"] == 0


def both(model, view, name):
    """Pieces of a scene with a step of the pass and without it: the full pass first."""
    out = []

    def solving(scene, plan, lifted):
        full = replace(plan, crossings=True, piercings=True, pyramid=False)
        out.append(solve(scene, full, lifted))
        out.append(solve(scene, replace(full, **{name: name == "pyramid"}), lifted))
        return out[0]

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(session, "solve", solving)
        draw_views(model, [view], hlr.Options(**AT_SIZE))
    return out


def expect_same_pieces(one, other):
    for name in ("edge", "t0", "t1", "state", "facing"):
        assert (getattr(one.found, name) == getattr(other.found, name)).all()


def test_a_body_that_is_convex_but_for_a_notch_is_searched():
    notched = cq.Workplane().box(20, 20, 20).faces(">Z").workplane().rect(4, 4).cutBlind(-1)
    found = decided(hlr.draw(notched, **AT_SIZE))["crossing search"]
    assert found.on and found.counts["crossing_tests"] > 0


def test_a_pentagram_on_end_is_searched_though_all_its_edges_bend_outward():
    # It winds twice: locally convex everywhere, but its faces lie over one another in the image.
    angles = 4 * np.pi * np.arange(5) / 5
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1) * 10
    vertices = [[*p, z] for z in (-5, 5) for p in ring] + [[0, 0, -5], [0, 0, 5]]
    faces = [
        f
        for i in range(5)
        for j in [(i + 1) % 5]
        for f in ([i, j, j + 5], [i, j + 5, i + 5], [10, j, i], [11, i + 5, j + 5])
    ]
    (drawing,) = expect_neutral(lambda: (np.array(vertices, float), np.array(faces)))
    found = decided(drawing)
    assert found["crossing search"].on and found["crossing search"].counts["seeds"] > 0
    # Its walls pass through one another, though no other surface is near.
    assert found["intersection search"].on and found["intersection lines"].counts["intersection_lines"] > 0


def test_views_drawn_together_trace_outlines_once(monkeypatch):
    from hlr import _kernel

    calls = []
    real = _kernel.silhouettes
    monkeypatch.setattr(_kernel, "silhouettes", lambda *a, **k: calls.append(1) or real(*a, **k))
    hlr.draw_views(ball(), ["front", "iso", "top"], hlr.Options(**AT_SIZE))
    assert len(calls) == 3


def test_the_table_for_people():
    text = explained(
        (Decision("outlines", True, SCENE, "one face", 0.0123, {"outlines": 2}), Decision("fill", False, "asked", "no"))
    )
    assert text.splitlines() == [
        "effect         by        time  counts      why",
        "outlines  on   scene  12.3 ms  2 outlines  one face",
        "fill      off  asked                       no",
    ]


@pytest.mark.slow
def test_planned_without_drawing_as_when_drawn():
    for options in (Options(**AT_SIZE), Options(fit=(100, 80), hidden=False, perspective=Perspective(), smooth=False)):
        planned = hlr.plan_views(DATA / "as1-oc-214.stp", ["iso", "front"], options)
        drawn = hlr.draw_views(DATA / "as1-oc-214.stp", ["iso", "front"], options)
        for plan, drawing in zip(planned, drawn, strict=True):
            assert plan.view == drawing.view.name
            assert [(d.name, d.on, d.reason) for d in plan.decisions] == [
                (d.name, d.on, d.reason) for d in drawing.plan
            ]


def test_json_carries_the_plan():
    document = json.loads(render(hlr.draw(box((9, 8, 7)), **AT_SIZE), "json"))
    hidden = next(d for d in document["plan"] if d["effect"] == "hidden lines")
    assert hidden == {
        "effect": "hidden lines",
        "on": True,
        "origin": "asked",
        "reason": "asked for",
        "counts": {"hidden_lines": 3},
    }
    assert "tables" not in document["timings"] and document["timings"]["effects"][PLAN] > 0


def test_effects_of_a_preview():
    plain = {d.name: d for d in hlr.preview(cq.Workplane().box(9, 8, 7), size=(60, 40)).plan}
    assert not plain["smooth normals"].on and not plain["transparency"].on and not plain["shadows"].on
    glass = cq.Assembly().add(ball(), color=cq.Color(1, 0, 0, 0.5))
    asked = {d.name: d for d in hlr.preview(glass, size=(60, 40), shadows=True, perspective=Perspective()).plan}
    assert all(asked[name].on for name in ("smooth normals", "transparency", "shadows", "perspective divide"))
    assert (asked["shadows"].origin, asked["transparency"].origin) == ("asked", SCENE)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["as1-oc-214.stp", "nist_ctc_01_asme1_ap242-e1.stp", "cube_gears.3mf"])
def test_visible_lines_are_the_same_without_the_hidden_ones(name):
    with_, without = (
        hlr.draw(DATA / name, (1, -2, 1.5), hidden=hidden, scale=1.0, smooth=False) for hidden in (True, False)
    )
    visible = [line for line in with_.lines if line.visible]
    assert len(visible) == len(without.lines)
    for one, other in zip(visible, without.lines, strict=True):
        assert (one.kind, one.part, one.edge, one.face) == (other.kind, other.part, other.edge, other.face)
        assert type(one.curve) is type(other.curve)
        assert one.points3.tolist() == other.points3.tolist()
        # Both are measured from the lower left corner of what is drawn.
        assert one.points + with_.origin == pytest.approx(other.points + without.origin, abs=1e-9)


def test_decisions_become_records_when_they_are_looked_at():
    planner = Planner(drawing_effects(), hlr.Options(**AT_SIZE))
    planner.on("outlines", Facts(curved=2))
    planner.spent("outlines", outlines=3)
    late = Decisions(planner, {"outlines": 3})
    assert late == planner.decisions({"outlines": 3}) == tuple(late) and late == Decisions(planner, {"outlines": 3})
    assert late[0].name == "outlines" and late[:1] == (late[0],) and len(late) == 2
    assert hash(late) == hash(tuple(late)) and repr(late) == repr(tuple(late))
    assert pickle.loads(pickle.dumps(late)) == tuple(late)
    assert planner.cost("outlines") == {"outlines": 3} and planner.cost("repair") == {}
