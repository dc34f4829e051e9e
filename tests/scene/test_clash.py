"""Lines in which surfaces pass through one another: what counts as one, how they chain, what is said of solids that
pass through themselves."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import cadquery as cq
import numpy as np
import pytest
import trimesh
from scene.crossings import (
    BORED,
    CROSSING,
    THROUGH,
    TOUCHING,
    across,
    assembly,
    bent,
    bore,
    bored,
    eight,
    overlapping_boxes,
    tube,
)

from hlr.scene.build import build
from hlr.scene.scene import Scene
from hlr.scene.scene_parts import MAX_NOTES
from hlr.source import open_source
from hlr.tables.line_classes import EdgeClass
from support import meshes
from support.models import box, parts, sheet, solids, turned

DEFLECTIONS = [0.5, 0.05, 0.005]


def scene_of(thing, deflection=0.05) -> Scene:
    return build(open_source(thing).mesh(deflection, 0.5), 30.0, deflection)


@dataclass(frozen=True)
class Walk:
    """An intersection line of the scene: its parts, and its points in order."""

    part: int
    other: int
    points: np.ndarray

    @property
    def closed(self):
        return np.array_equal(self.points[0], self.points[-1])

    def corners(self):
        """The points between straight pieces; neighbouring triangles of a plane make more."""
        p = self.points[:-1]
        before, after = p - np.roll(p, 1, axis=0), np.roll(p, -1, axis=0) - p
        bent = np.linalg.norm(np.cross(before, after), axis=1) > 1e-9
        return {tuple(c) for c in np.round(p[bent], 9).tolist()}


def walks(scene: Scene) -> list[Walk]:
    c = scene.walks
    out = []
    for i in np.flatnonzero(c.kind == EdgeClass.INTERSECTION):
        own = slice(c.offsets[i], c.offsets[i + 1])
        ends = scene.edges[c.edges[own]]
        ends[c.reversed[own]] = ends[c.reversed[own]][:, ::-1]
        assert (ends[1:, 0] == ends[:-1, 1]).all()
        out.append(Walk(int(c.part[i]), int(c.other[i]), scene.points[[ends[0, 0], *ends[:, 1]]]))
    return out


def pairs(scene):
    return [(w.part, w.other) for w in walks(scene)]


def rectangle(fixed, at, low, high):
    """Corners of a rectangle across an axis."""
    out = set()
    for u in (low[0], high[0]):
        for v in (low[1], high[1]):
            corner = [u, v]
            corner.insert(fixed, at)
            out.add(tuple(map(float, corner)))
    return out


@pytest.mark.parametrize(
    "model", [lambda: solids(*CROSSING), lambda: parts(*(box(*b) for b in CROSSING))], ids=["brep", "mesh"]
)
@pytest.mark.parametrize("deflection", DEFLECTIONS)
def test_a_post_through_a_block_has_one_rectangle_per_opening(model, deflection):
    found = walks(scene_of(model(), deflection))
    assert all(w.closed and (w.part, w.other) == (0, 1) for w in found)
    wanted = [rectangle(2, z, (-4, -2), (4, 4)) for z in (-10, 10)]
    assert sorted(w.corners() for w in found) == sorted(wanted) and len(found) == 2


def test_a_corner_in_a_corner_is_one_line_around_it():
    (line,) = walks(scene_of(solids(((10, 10, 10), (5, 5, 5)), ((10, 10, 10), (10, 10, 10)))))
    assert line.closed
    ring = {(5, 5, 10), (5, 10, 10), (5, 10, 5), (10, 10, 5), (10, 5, 5), (10, 5, 10)}
    assert line.corners() == {tuple(map(float, c)) for c in ring}


def test_three_boxes_cross_one_another():
    scene = scene_of(solids(((20, 4, 6), (0, 0, 0)), ((4, 6, 20), (0, 0, 0)), ((6, 20, 4), (0, 0, 0))))
    found = walks(scene)
    assert sorted(pairs(scene)) == [(0, 1), (0, 1), (0, 2), (0, 2), (1, 2), (1, 2)]
    assert all(w.closed for w in found)
    wanted = {(0, 1): (0, 2, (2, 3)), (0, 2): (1, 2, (3, 2)), (1, 2): (2, 2, (2, 3))}
    for w in found:
        axis, at, half = wanted[w.part, w.other]
        side = np.sign(w.points[0, axis]) * at
        assert w.corners() == rectangle(axis, side, [-h for h in half], half)


def test_where_two_faces_meet_a_third_in_their_common_edge_the_line_is_there_once():
    """A saddle pressed into a floor just so deep that the ridge of its notch lies in the floor's plane."""
    profile = [(-6, 5), (6, 5), (6, -3), (0, 0), (-6, -3)]
    saddle = cq.Workplane("XZ").polyline(profile).close().extrude(8)
    scene = scene_of(assembly(cq.Workplane().box(40, 40, 10).translate((0, 0, -5)), saddle))
    found = walks(scene)
    runs = [(tuple(a), tuple(b)) for w in found for a, b in pairwise(w.points.tolist())]
    assert len({frozenset(run) for run in runs}) == len(runs)
    ridge = [abs(a[1] - b[1]) for a, b in runs if max(abs(a[0]), abs(b[0])) < 1e-6]
    assert sum(ridge) in (0, pytest.approx(8, abs=1e-6))
    around = [np.linalg.norm(np.subtract(a, b)) for a, b in runs if max(abs(a[0]), abs(b[0])) > 1e-6]
    assert sum(around) == pytest.approx(2 * (12 + 8), abs=1e-5)


@pytest.mark.parametrize("deflection", [0.2, 0.05, 0.01])
def test_a_bolt_through_a_plate_meets_it_in_two_ellipses(deflection):
    slant = cq.Vector(0.5, 0, 0.75**0.5)
    bolt = cq.Solid.makeCylinder(5, 30, cq.Vector(-8, 0, -14), slant)
    scene = scene_of(assembly(cq.Workplane().box(60, 60, 8), bolt), deflection)
    found = walks(scene)
    assert [w.closed for w in found] == [True, True]
    assert sorted(round(w.points[0, 2], 6) for w in found) == [-4, 4]
    for w in found:
        z = round(w.points[0, 2])
        assert np.abs(w.points[:, 2] - z).max() < 1e-6
        # Half axes 5 / cos 30 and 5 about where the axis comes through.
        middle = -8 + (z + 14) * np.tan(np.radians(30))
        u = (w.points[:, 0] - middle) * np.cos(np.radians(30))
        off = 5 - np.hypot(u, w.points[:, 1])
        assert off.min() > -1e-6 and off.max() < deflection
        turn = np.unwrap(np.arctan2(w.points[:, 1], u))
        assert abs(turn[-1] - turn[0]) == pytest.approx(2 * np.pi)


@pytest.mark.parametrize("turn", [0, 17])
@pytest.mark.parametrize("deflection", [0.2, 0.1, 0.025, 0.005])
def test_cylinders_of_one_radius_cross_without_a_gap(deflection, turn):
    """Where both are tangent to one plane their facets are all but parallel, and yet the lines run through: two
    ellipses, each of which goes straight on where they cross."""
    scene = scene_of(across(8, 8, turn=turn), deflection)
    found = walks(scene)
    assert len(found) == 2 and all(w.closed for w in found), [w.points[[0, -1]] for w in found]
    points = np.concatenate([w.points for w in found])
    assert np.abs(np.hypot(points[:, 1], points[:, 2]) - 8).max() < 2 * deflection
    assert np.abs(np.hypot(points[:, 0], points[:, 1]) - 8).max() < 2 * deflection
    blur = 2 * (2 * deflection * 8) ** 0.5
    for end in (-8, 8):
        assert np.linalg.norm(points - (0, end, 0), axis=1).min() < blur
    length = sum(np.linalg.norm(np.diff(w.points, axis=0), axis=1).sum() for w in found)
    a, b = 8 * 2**0.5, 8
    ellipse = np.linalg.norm(np.diff([(a * np.cos(t), b * np.sin(t)) for t in np.linspace(0, 7, 7001)], axis=0), axis=1)
    wanted = 2 * ellipse.sum() * 2 * np.pi / 7
    assert length == pytest.approx(wanted, rel=0.05)


@pytest.mark.parametrize("deflection", [0.1, 0.01])
def test_a_thin_cylinder_enters_and_leaves_a_thick_one(deflection):
    found = walks(scene_of(across(8, 5), deflection))
    assert [w.closed for w in found] == [True, True]
    low, high = sorted(found, key=lambda w: w.points[0, 2])
    for w, sign in ((low, -1), (high, 1)):
        x, y, z = w.points.T
        assert np.abs(np.hypot(x, y) - 5).max() < 2 * deflection
        assert np.abs(np.hypot(y, z) - 8).max() < 2 * deflection
        assert (sign * z > 5).all()


@pytest.mark.slow
@pytest.mark.parametrize("deflection", DEFLECTIONS)
@pytest.mark.parametrize("name", TOUCHING)
def test_what_touches_does_not_cross(name, deflection):
    scene = scene_of(TOUCHING[name](), deflection)
    assert not walks(scene)
    assert [note.code for note in scene.notes] == ["parts-repeated"] * (name == "copies")


@pytest.mark.slow
@pytest.mark.parametrize("deflection", [0.5, 0.1, 0.05, 0.02, 0.005])
@pytest.mark.parametrize("name", BORED)
def test_a_shaft_in_the_bore_of_any_body_does_not_cross_it(name, deflection):
    """Beside the rim the outer face may be cut into triangles whose corners lie far away on either side."""
    body, x = BORED[name]
    for turn in (5, 17, 41):
        assert not walks(scene_of(bored(body(), x, turn), deflection)), turn


@pytest.mark.parametrize(("n", "m"), [(64, 64), (64, 90), (90, 120), (200, 150)])
def test_two_tessellations_of_one_cylinder_do_not_cross(n, m):
    assert not walks(scene_of(meshes.as_parts(tube(n, 0), tube(m, 0.37))))


def test_but_two_prisms_do():
    """The same so coarse that it is the shape: two square prisms.

    Their ends lie in common planes: there the edges of either lie flush on the other's end, and are drawn as edges.
    """
    found = walks(scene_of(meshes.as_parts(tube(4, 0), tube(4, 0.5))))
    upright = [w for w in found if np.ptp(w.points[:, 2]) > 1e-6]
    assert len(upright) == 8 and len(found) == 8
    side = 5 * 0.5**0.5
    for w in upright:
        assert np.ptp(w.points[:, :2], axis=0).max() < 1e-6
        assert sorted(np.round(w.points[[0, -1], 2], 6)) == [0, 10]
        assert sorted(np.abs(w.points[0, :2])) == pytest.approx([5 - side, side])
    for w in found:
        x, y, z = np.abs(w.points.T)
        assert np.minimum(np.abs(np.maximum(x, y) - side), np.abs(x + y - 5)).max() < 1e-6
        assert np.ptp(z) > 1e-6 or z[0] in (0, 10)


@pytest.mark.parametrize("angle", [0, 25])
def test_a_shaft_too_thick_for_its_bore_does(angle):
    model = bore(angle)
    thick = cq.Workplane(obj=cq.Solid.makeCylinder(5.5, 40, cq.Vector(0, 0, -20)))
    found = walks(scene_of(assembly(model.children[0].obj, thick.rotate((0, 0, 0), (0, 0, 1), angle))))
    assert [w.closed for w in found] == [True, True]
    for w in found:
        assert np.abs(np.hypot(w.points[:, 0], w.points[:, 1]) - 5.5).max() < 0.05
        assert np.abs(np.abs(w.points[:, 2]) - 10).max() < 1e-6


# Through itself.


def defects(scene):
    return [p.defects for p in scene.parts]


def test_a_tube_through_itself():
    scene = scene_of(eight())
    assert defects(scene) == [(THROUGH,)] and not scene.groups.cull[0] and not scene.groups.sound[0]
    assert scene.parts[0].closed and scene.parts[0].oriented
    assert set(pairs(scene)) == {(0, 0)}
    points = np.concatenate([w.points for w in walks(scene)])
    # Two cylinders of one radius at right angles, nearly: ellipses in the planes x = 0 and y = 0.
    assert np.minimum(np.abs(points[:, 0]), np.abs(points[:, 1])).max() < 0.05
    assert np.abs(points[:, 2]).max() == pytest.approx(1.2, abs=0.02)
    ends = [tuple(e) for w in walks(scene) if not w.closed for e in np.round(w.points[[0, -1]], 9).tolist()]
    assert all(ends.count(e) % 2 == 0 for e in ends), "a line ends where no other goes on"


def test_a_ring_does_not_pass_through_itself():
    for scene in (scene_of(meshes.torus(10, 3, 48, 24)), scene_of(cq.Solid.makeTorus(10, 3))):
        assert defects(scene) == [()] and scene.groups.cull[0] and not walks(scene)


@pytest.mark.parametrize("deflection", [0.05, 0.004])
def test_a_spindle_torus_passes_through_itself(deflection):
    scene = scene_of(cq.Solid.makeTorus(3, 5), deflection)
    assert defects(scene) == [(THROUGH,)]
    assert not scene.groups.cull.any() and not scene.groups.sound.any()
    assert not walks(scene), "the tangle of triangles about the axis"
    assert [str(note) for note in scene.notes] == [f'Part "part" is drawn as it is: {THROUGH}.']


def test_a_spindle_torus_passes_through_itself_however_it_is_meshed():
    for deflection in (0.2, 0.1, 0.05, 0.025, 0.01, 0.006):
        assert defects(scene_of(cq.Solid.makeTorus(3, 5), deflection)) == [(THROUGH,)], deflection


def test_a_part_of_two_boxes_that_overlap():
    """A mesh with two pieces is one part that meets itself, which is said; each piece is sound, and culled."""
    a, b = box((10, 10, 10), (5, 5, 5)), box((10, 10, 10), (10, 10, 10))
    scene = scene_of(trimesh.util.concatenate([a, b]))
    assert pairs(scene) == [(0, 0)] and walks(scene)[0].closed
    assert scene.groups.cull[:2].all() and defects(scene) == [(THROUGH,)]


def test_a_compound_of_two_boxes_that_overlap():
    scene = scene_of(cq.Compound.makeCompound(overlapping_boxes()))
    assert pairs(scene) == [(0, 1)] and walks(scene)[0].closed and not scene.notes


def test_a_hollow_body_has_no_defect():
    scene = scene_of(trimesh.util.concatenate([box((20, 20, 20)), turned(box((10, 10, 10)))]))
    assert defects(scene) == [()] and not scene.notes and not walks(scene)


# What is said.


def flipped():
    mesh = box((10, 10, 10))
    faces = mesh.faces.copy()
    faces[0] = faces[0][::-1]
    return trimesh.Trimesh(mesh.vertices, faces, process=False)


def twice():
    mesh = box((10, 10, 10))
    return trimesh.Trimesh(mesh.vertices, np.concatenate([mesh.faces, mesh.faces[:1]]), process=False)


DEFECTS = {
    "1 duplicated triangle": twice,
    "1 triangle without area": lambda: (
        np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [8, 0, 0]], float),
        np.array([[0, 1, 2], [0, 3, 1]]),
    ),
    "open: 3 border edges": lambda: bent(0),
    "1 non-manifold edge": lambda: (
        np.array([[0, 0, 0], [0, 0, 9], [9, 0, 0], [-9, 5, 0], [-9, -5, 0]], float),
        np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]]),
    ),
    "3 edges between faces of opposite orientation": flipped,
    "1 closed piece turned inside out": lambda: turned(box((10, 10, 10))),
    THROUGH: eight,
}


@pytest.mark.parametrize("said", DEFECTS)
def test_each_defect_has_its_note(said):
    scene = scene_of(DEFECTS[said]())
    assert said in scene.parts[0].defects, scene.parts[0].defects
    assert [str(note) for note in scene.notes] == [
        f'Part "part" is drawn as it is: {"; ".join(scene.parts[0].defects)}.'
    ]


def test_a_solid_turned_inside_out_is_called_so():
    solid = cq.Workplane().box(9, 9, 9).val()
    scene = scene_of(cq.Solid(solid.wrapped.Complemented()))
    assert defects(scene) == [("the solid is turned inside out",)]


@pytest.mark.parametrize(("count", "more"), [(1, 0), (MAX_NOTES, 0), (MAX_NOTES + 1, 1), (MAX_NOTES + 3, 3)])
def test_no_more_than_a_few_parts_are_named(count, more):
    sheets = [sheet(5, 3 * k) for k in range(count)]
    scene = scene_of(parts(box((9, 9, 1), (50, 0, 0)), *sheets))
    assert [bool(d) for d in defects(scene)] == [False, *[True] * count]
    named = [f'Part "part{k + 1}" is drawn as it is: open: 4 border edges.' for k in range(min(count, MAX_NOTES))]
    rest = {0: [], 1: ["1 more part has defects: see hlr info."], 3: ["3 more parts have defects: see hlr info."]}
    assert list(map(str, scene.notes)) == named + rest[more]
