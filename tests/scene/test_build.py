"""From parts to the scene: the tables agree, groups are what they are called, and defects are counted."""

from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from hlr import SourceError, _kernel
from hlr.scene import build as building
from hlr.scene.build import build
from hlr.scene.duplicates import without_duplicates
from hlr.source import open_source
from hlr.source.fewer_triangles import Fewer, with_fewer_triangles
from hlr.source.model import Tessellation
from hlr.source.part_meshes import combine_parts
from hlr.tables.line_classes import INTERIOR, EdgeClass
from support.invariants import check
from support.models import box, parts, sheet, turned


def scene_of(thing, crease=30.0, deflection=0.05):
    return build(open_source(thing).mesh(deflection, 0.5), crease, deflection)


def part_of(thing):
    return open_source(thing).mesh(0.05, 0.5).parts[0]


def hollow():
    return trimesh.util.concatenate([box((20, 20, 20)), turned(box((10, 10, 10)))])


def lidless():
    mesh = box((20, 20, 20))
    mesh.update_faces(mesh.face_normals[:, 2] < 0.5)
    return mesh


def fin():
    """Three faces at one edge."""
    points = [[0, 0, 0], [0, 0, 9], [9, 0, 0], [-9, 5, 0], [-9, -5, 0]]
    return np.array(points, float), np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]])


MODELS = {
    "box": lambda: cq.Workplane().box(10, 20, 30),
    "ball": lambda: cq.Workplane().sphere(10),
    "cylinder": lambda: cq.Workplane().cylinder(20, 5),
    "fillet": lambda: cq.Workplane().box(20, 20, 20).edges().fillet(4),
    "face": lambda: cq.Workplane().add(cq.Face.makePlane(10, 10)),
    "assembly": lambda: cq.Assembly().add(cq.Workplane().box(9, 9, 9)).add(cq.Workplane().sphere(3)),
    "face and wire": lambda: cq.Compound.makeCompound(
        [cq.Solid.makeBox(5, 5, 5), cq.Edge.makeCircle(9), cq.Edge.makeLine(cq.Vector(0, 0, 9), cq.Vector(0, 9, 9))]
    ),
    "torus": lambda: cq.Solid.makeTorus(20, 5),
    "mesh box": lambda: box((10, 20, 30)),
    "mesh parts": lambda: parts(box((1, 2, 3)), trimesh.creation.icosphere(2), box((3, 2, 1), (9, 0, 0))),
    "turned": lambda: turned(box((10, 20, 30))),
    "hollow": hollow,
    "lidless": lidless,
    "sheet": lambda: sheet(10, 0),
    "fin": fin,
}


@pytest.mark.parametrize("name", MODELS)
def test_the_tables_agree(name):
    check(scene_of(MODELS[name]()))


@pytest.mark.slow
@given(
    st.lists(st.tuples(*[st.integers(0, 2)] * 3), min_size=3, max_size=9, unique=True).flatmap(
        lambda points: st.tuples(
            st.just(points),
            st.lists(
                st.lists(st.integers(0, len(points) - 1), min_size=3, max_size=3, unique=True), min_size=1, max_size=14
            ),
        )
    ),
    st.sampled_from([0.0, 30.0, 180.0]),
)
@settings(max_examples=150, deadline=None)
def test_the_tables_of_any_soup_agree(soup, crease):
    points, faces = soup
    check(scene_of((np.array(points, float), np.array(faces)), crease))


def spoilt(walks: _kernel.Walks, **columns: np.ndarray) -> _kernel.Walks:
    """The walks with other columns."""
    names = ("offsets", "edges", "reversed", "kind", "part", "index", "other", "face", "straight", "curve")
    return _kernel.Walks(**{name: columns.get(name, getattr(walks, name)) for name in names})


@pytest.mark.parametrize(
    "spoil",
    [
        lambda s: replace(s, edges=s.edges[:, ::-1].copy()),
        lambda s: replace(s, incident=np.roll(s.incident, 1)),
        lambda s: replace(s, edge_kind=np.full_like(s.edge_kind, INTERIOR)),
        lambda s: replace(s, triangle_group=np.roll(s.triangle_group, 1)),
        lambda s: replace(s, walks=spoilt(s.walks, reversed=~s.walks.reversed)),
        lambda s: replace(s, walks=spoilt(s.walks, edges=s.walks.edges[::-1].copy())),
        lambda s: replace(s, groups=scene_of(parts(box((1, 1, 1)), box((1, 1, 1)))).groups),
        lambda s: replace(s, points=s.points * 2),
        lambda s: replace(s, triangles=s.triangles + 1),
    ],
)
def test_the_check_notices(spoil):
    scene = scene_of(cq.Assembly().add(cq.Workplane().cylinder(9, 9)).add(cq.Workplane().sphere(3)))
    check(scene)
    with pytest.raises(AssertionError):
        check(spoil(scene))


def flags(scene):
    g = scene.groups
    return sorted(zip(g.closed.tolist(), g.cull.tolist(), g.without_brep.tolist(), strict=True))


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("box", [(True, True, False)]),
        ("face", [(False, False, False)]),
        ("mesh box", [(True, True, True)]),
        ("turned", [(True, True, True)]),
        ("hollow", [(True, False, True), (True, True, True)]),
        ("lidless", [(False, False, True)]),
        # The first is of the line in which the ball comes out of the flat box.
        ("mesh parts", [(False, False, False), *[(True, True, True)] * 3]),
    ],
)
def test_only_what_is_closed_and_outward_may_be_culled(name, expected):
    assert flags(scene_of(MODELS[name]())) == expected


@pytest.mark.parametrize(
    ("name", "closed", "oriented", "defects"),
    [
        ("mesh box", True, True, ()),
        ("lidless", False, True, ("open: 4 border edges",)),
        ("turned", True, True, ("1 closed piece turned inside out",)),
        ("hollow", True, True, ()),
        ("fin", False, True, ("open: 6 border edges", "1 non-manifold edge")),
        ("box", True, True, ()),
        ("ball", True, True, ()),
        ("face", False, True, ()),
    ],
)
def test_reports(name, closed, oriented, defects):
    part = scene_of(MODELS[name]()).parts[0]
    assert (part.closed, part.oriented, len(part.defects)) == (closed, oriented, len(defects))
    for said, start in zip(part.defects, defects, strict=True):
        assert said.startswith(start)


def test_one_face_turned_over_is_reported_and_stops_culling():
    mesh = box((10, 10, 10))
    mesh.faces[0] = mesh.faces[0][::-1]
    scene = scene_of((mesh.vertices, mesh.faces))
    check(scene)
    (part,) = scene.parts
    assert (part.closed, part.oriented) == (False, False)
    assert part.defects == ("3 edges between faces of opposite orientation",)
    assert not scene.groups.cull.any()


def test_repeated_triangles_are_dropped_and_counted():
    mesh = box((10, 10, 10))
    faces = np.concatenate([mesh.faces, mesh.faces[:5], mesh.faces[5:8, ::-1], np.roll(mesh.faces[8:9], 1, axis=1)])
    part = part_of((mesh.vertices, faces))
    kept, staying = without_duplicates(part)
    assert staying.tolist() == list(range(12))
    assert (kept.triangles == part.triangles[:12]).all()
    assert len(kept.triangle_face) == 12
    again, all_of_it = without_duplicates(kept)
    assert all_of_it.tolist() == list(range(12)) and again is kept
    scene = scene_of((mesh.vertices, faces))
    assert scene.parts[0].defects == ("9 duplicated triangles",)
    assert scene.groups.cull.all()


def test_only_parts_with_repetitions_are_repaired(monkeypatch):
    """The others are not looked at: where a model has hundreds of parts, that would take most of the repair."""
    mesh = box((10, 10, 10))
    plain, far = (replace(part_of((mesh.vertices + 50.0 * k, mesh.faces)), name=f"plain {k}") for k in (1, 2))
    twice = replace(part_of((mesh.vertices, np.concatenate([mesh.faces, mesh.faces[:3]]))), name="twice")
    doubled = np.concatenate([mesh.vertices, mesh.vertices])
    faces = np.concatenate([mesh.faces, mesh.faces + len(mesh.vertices)]).astype(np.int32)
    there = replace(part_of((doubled - 50.0, mesh.faces)), name="there", points=doubled, triangles=faces)
    there = replace(there, joined=False, triangle_face=np.repeat(np.arange(2, dtype=np.int32), len(mesh.faces)))
    there = replace(there, face_planar=np.zeros(2, bool))
    seen = []

    def noted(part, *which):
        seen.append((part.name, which))
        return without_duplicates(part, *which)

    monkeypatch.setattr(building, "without_duplicates", noted)
    scene = build(Tessellation([plain, twice, far, there], []), 30.0, 0.05)
    assert seen == [("twice", (True, False)), ("there", (False, True))]
    assert [part.triangles for part in scene.parts] == [12] * 4
    assert [part.defects for part in scene.parts] == [(), ("3 duplicated triangles",), (), ("12 duplicated triangles",)]
    del seen[:]
    build(Tessellation([plain, far], []), 30.0, 0.05)
    assert not seen


def test_leaving_triangles_out_of_some_parts_gives_what_putting_all_parts_together_gives():
    one, other = (part_of(cq.Workplane().box(10, 20, 30).edges("|Z").fillet(k)) for k in (2, 3))
    mesh = part_of((box((1, 2, 3)).vertices, box((1, 2, 3)).faces))
    parts = [mesh, one, other, mesh, one]
    fewer, wanted = {}, list(parts)
    for i, every in ((1, 2), (3, 3)):
        part = parts[i]
        staying = np.arange(0, len(part.triangles), every)
        nodes = part.edge_nodes[::-1].copy()
        fewer[i] = Fewer(staying, nodes)
        on = part.surface_parameters
        wanted[i] = replace(
            part,
            triangles=part.triangles[staying],
            triangle_face=part.triangle_face[staying],
            origin=staying.astype(np.int32),
            edge_nodes=nodes,
            surface_parameters=on and replace(on, corner=on.corner[staying]),
        )
    found, expected = with_fewer_triangles(combine_parts(parts), fewer), combine_parts(wanted)
    names = [name for name in vars(type(found.tables)) if isinstance(getattr(found.tables, name), np.ndarray)]
    assert len(names) == 23
    for name in names:
        assert np.array_equal(getattr(found.tables, name), getattr(expected.tables, name)), name
    assert found.labels == [*combine_parts(parts).labels] and found.surfaces is expected.surfaces
    tables = found.tables
    chosen = np.ones(len(tables.triangles), bool)
    for wrong in (
        (chosen[1:], tables.edge_nodes),
        (chosen, tables.edge_nodes[1:]),
        (chosen, tables.edge_nodes + 10**6),
    ):
        with pytest.raises(ValueError, match=r"chosen|edge_nodes"):
            tables.with_triangles(*wrong)


def test_parts_are_counted_by_what_they_are():
    mesh = box((10, 20, 30))
    plain = part_of((mesh.vertices, mesh.faces))
    fewer = part_of((mesh.vertices, mesh.faces[:8]))
    tables = combine_parts([plain, fewer]).tables
    assert (tables.brep_parts, tables.planar_faces) == (0, int(tables.face_planar.sum()))
    assert tables.triangle_counts(np.array([0, 1, 1], np.int32)) == (8, 12 + 8 + 8)
    assert tables.triangle_counts(np.array([0], np.int32)) == (12, 12)
    assert tables.triangle_counts(np.zeros(0, np.int32)) == (0, 0)
    with pytest.raises(ValueError, match="part"):
        tables.triangle_counts(np.array([2], np.int32))
    found = combine_parts([plain, plain]).tables.facts().scene()
    assert (found.folded, found.curved_faces, len(found.reports())) == (0, 0, 2)
    assert found.groups().meeting() == 2, "both stand in one place"
    far = part_of((mesh.vertices + 500.0, mesh.faces))
    assert combine_parts([plain, far]).tables.facts().scene().groups().meeting() == 0


@pytest.mark.parametrize("again", range(12))
def test_a_repetition_is_noticed_wherever_it_is(again):
    mesh = box((10, 20, 30))
    plain, other = part_of((mesh.vertices, mesh.faces)), part_of((mesh.vertices + 50.0, mesh.faces))
    plain, other = replace(plain, joined=False), replace(other, joined=False)
    assert combine_parts([plain, other, plain]).tables.triangles_in_one_place() == [False] * 3, (
        "equal parts are no repetition in any of them"
    )
    assert combine_parts([plain, other]).tables.facts().triangles_repeated() == [False] * 2
    for corners in (mesh.faces[again], np.roll(mesh.faces[again], 1), mesh.faces[again][::-1]):
        triangles = np.concatenate([plain.triangles, corners[None].astype(np.int32)])
        twice = replace(plain, triangles=triangles, triangle_face=np.zeros(len(triangles), np.int32))
        assert combine_parts([other, twice, plain]).tables.facts().triangles_repeated() == [False, True, False]
    # A triangle with corners of its own in the places of another one's.
    points, last = np.concatenate([plain.points, plain.points[plain.triangles[again]]]), len(plain.points)
    for turns, there in (([0, 1, 2], True), ([1, 2, 0], True), ([2, 1, 0], False)):
        own = (last + np.array(turns, np.int32))[None]
        triangles = np.concatenate([plain.triangles, own]).astype(np.int32)
        above = replace(plain, points=points, triangles=triangles, triangle_face=np.zeros(len(triangles), np.int32))
        assert combine_parts([other, above]).tables.triangles_in_one_place() == [False, there]
        joined = replace(above, joined=True)
        assert combine_parts([other, joined]).tables.triangles_in_one_place() == [False, False]
    alone = replace(plain, points=points)
    assert combine_parts([other, alone]).tables.triangles_in_one_place() == [False, False], "points alone do not matter"


@pytest.mark.parametrize("far", [(0, 0, 0), (30, -40, 50), (-12345678.9, 23456789.1, 9876543.2)])
def test_a_body_has_the_same_thickness_and_outside_wherever_it_is(far):
    inside, there = scene_of(box((2, 4, 8))).groups, scene_of(box((2, 4, 8), far)).groups
    # By volume and area it is no thinner than its smallest side.
    assert there.extent == pytest.approx([2.0]) and there.extent == pytest.approx(inside.extent)
    # The outside is found there, too: one that is turned inside out is turned round.
    over = scene_of(turned_over(box((2, 4, 8), far)))
    assert there.cull.all() and over.groups.cull.all()
    a, b, c = (over.points[over.triangles[:, k]] - over.points.mean(axis=0) for k in range(3))
    assert np.einsum("ij,ij->i", np.cross(a, b), c).sum() / 6.0 == pytest.approx(64.0)


def turned_over(mesh):
    mesh.faces = mesh.faces[:, ::-1]
    return mesh


def test_repeated_faces_are_dropped_and_their_edges_run_along_those_that_stay():
    one = replace(part_of(cq.Workplane().box(10, 20, 30).edges("|Z").fillet(3)), surface_parameters=None)
    n = len(one.points)
    twice = replace(
        one,
        points=np.concatenate([one.points, one.points]),
        triangles=np.concatenate([one.triangles, np.roll(one.triangles, 1, axis=1) + n]).astype(np.int32),
        triangle_face=np.concatenate([one.triangle_face, one.triangle_face + len(one.face_planar)]),
        face_planar=np.concatenate([one.face_planar, one.face_planar]),
        edge_nodes=np.concatenate([one.edge_nodes, one.edge_nodes + n]).astype(np.int32),
        edge_offsets=np.concatenate([one.edge_offsets, one.edge_offsets[1:] + one.edge_offsets[-1]]),
        edge_index=np.concatenate([one.edge_index, one.edge_index + len(one.edge_index)]),
        edge_class=np.concatenate([one.edge_class, one.edge_class]),
    )
    kept, staying = without_duplicates(twice)
    assert staying.tolist() == list(range(len(one.triangles)))
    assert (kept.triangles == one.triangles).all()
    assert (kept.edge_nodes == np.concatenate([one.edge_nodes, one.edge_nodes])).all()
    scene = build(Tessellation([kept], []), 30.0, 0.05)
    check(scene)
    assert scene.groups.closed.all()
    # Not the part of a face: where neighbours lap over each other, a triangle may be there twice and be needed.
    most = replace(twice, triangles=twice.triangles[:-1], triangle_face=twice.triangle_face[:-1].copy())
    most.triangle_face[-1] = twice.triangle_face[0]
    assert len(without_duplicates(most)[1]) > len(staying)
    # Not turned over: there two bodies touch.
    back = replace(twice, triangles=np.concatenate([one.triangles, one.triangles[:, ::-1] + n]).astype(np.int32))
    both, staying = without_duplicates(back)
    assert both is back and len(staying) == len(back.triangles)


@pytest.mark.parametrize(("crease", "sharp"), [(30.0, 12), (89.0, 12), (91.0, 0), (180.0, 0)])
def test_the_crease_angle_decides(crease, sharp):
    scene = scene_of(box((10, 20, 30)), crease)
    assert (scene.edge_kind == EdgeClass.SHARP).sum() == sharp
    check(scene)


def test_creases_of_a_bare_mesh_never_touch_a_brep_part():
    # 6 diagonals, one per face, are no edges of the box, whatever the angle.
    scene = scene_of(cq.Workplane().box(10, 10, 10), crease=0.0)
    assert (scene.edge_kind == EdgeClass.SHARP).sum() == 12
    assert (scene.edge_kind == INTERIOR).sum() == 6


def test_classes_of_a_cylinder_and_its_curved_edges():
    scene = scene_of(MODELS["cylinder"]())
    assert sorted(scene.walks.kind.tolist()) == [EdgeClass.SHARP, EdgeClass.SHARP, EdgeClass.SEAM]
    inside = (scene.edge_kind == INTERIOR) & scene.edge_curved
    # Only edges of the curved face may be outlines: never one within a cap.
    z = scene.points[scene.edges[inside]][:, :, 2]
    assert (np.ptp(z, axis=1) > 0).all()
    assert not scene.groups.planar.any()
    assert scene_of(MODELS["box"]()).groups.planar.all()


def test_wires_of_no_face_get_a_group_of_their_own():
    scene = scene_of(MODELS["face and wire"]())
    loose = np.diff(scene.offsets) == 0
    if loose.any():
        assert not set(scene.edge_group[loose].tolist()) & set(scene.triangle_group.tolist())


def test_nothing_to_draw():
    part = part_of(box((1, 1, 1)))
    empty = replace(part, triangles=part.triangles[:0], triangle_face=part.triangle_face[:0])
    with pytest.raises(SourceError, match="nothing to draw"):
        build(Tessellation([empty]), 30.0, 0.05)


def test_a_part_that_is_not_finite_is_refused():
    part = part_of(box((1, 1, 1)))
    broken = part.points.copy()
    broken[0, 0] = np.nan
    with pytest.raises(SourceError, match="not finite"):
        build(Tessellation([replace(part, points=broken)]), 30.0, 0.05)


def test_a_solid_turned_inside_out_is_turned_and_reported():
    solid = cq.Shape.cast(cq.Solid.makeBox(5, 5, 5).wrapped.Reversed())
    scene = scene_of(solid)
    assert scene.groups.cull.all() and not scene.groups.inward.any()
    assert scene.turned.all()
    p, q, r = np.moveaxis(scene.points[scene.triangles], 1, 0)
    assert np.einsum("ij,ij->", p, np.cross(q, r)) / 6 == pytest.approx(125)
    assert scene.parts[0].defects
    assert not scene_of(cq.Workplane().box(5, 5, 5)).turned.any()
