"""The curves in (u, v) of a face, moved by whole periods until they follow one another."""

import math
from types import SimpleNamespace

import cadquery as cq
import numpy as np
import pytest

from hlr.source.cad import pcurves
from hlr.source.cad.shapes import sub_shapes
from support.brep_shapes import shifted_cylinder

TURN = 2.0 * math.pi


def forward(shape):
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopoDS import TopoDS

    return TopoDS.Face_s(shape.Oriented(TopAbs_Orientation.TopAbs_FORWARD))


def face_of(solid, kind):
    return forward(next(f.wrapped for f in solid.Faces() if f.geomType() == kind))


def uses_of(face):
    """Of its one wire, in order."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    (wire,) = sub_shapes(face, Kind.TopAbs_WIRE)
    return pcurves._in_order(pcurves._uses(wire, face), np.array(pcurves.periods(face)))


def moved(face, by):
    """All curves of edges that are no seam moved by by(k), the first of a seam's two by by(-1)."""
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.gp import gp_Vec2d

    edges = {use.edge.TShape(): [] for use in uses_of(face)}
    for use in uses_of(face):
        edges[use.edge.TShape()].append(use)
    rims = 0
    for group in edges.values():
        curves = [use.curve.Copy() for use in sorted(group, key=lambda use: use.backward)]
        seam = len(curves) == 2
        curves[0].Translate(gp_Vec2d(*by(-1 if seam else rims)))
        rims += not seam
        BRep_Builder().UpdateEdge(group[0].edge, *curves, face, BRep_Tool.Tolerance_s(group[0].edge))


SHIFTS = {
    "as it is": lambda k: (0.0, 0.0),
    "seam": lambda k: (TURN * (k < 0), 0.0),
    "one rim": lambda k: (-2 * TURN * (k == 0), 0.0),
    "the other rim": lambda k: (3 * TURN * (k == 1), 0.0),
    "all": lambda k: (TURN * (k + 2), 0.0),
}


def closed_from_nought(face, v_range):
    uses = uses_of(face)
    for before, after in zip(uses, [*uses[1:], uses[0]], strict=True):
        assert before.ends[1] == pytest.approx(after.ends[0], abs=1e-9)
    u, v = np.array([use.ends for use in uses]).reshape(-1, 2).T
    assert (u.min(), u.max()) == pytest.approx((0.0, TURN), abs=1e-9)
    assert (v.min(), v.max()) == pytest.approx(v_range, abs=1e-9)


@pytest.mark.parametrize("by", SHIFTS.values(), ids=SHIFTS)
def test_curves_of_a_cylinder_follow_one_another(by):
    face = face_of(cq.Workplane().cylinder(10, 3).val(), "CYLINDER")
    v = np.array([use.ends for use in uses_of(face)])[..., 1]
    moved(face, by)
    pcurves.close_loops(face)
    closed_from_nought(face, (v.min(), v.max()))
    edges = cq.Face(face).Edges()
    assert len(edges) == 3 and {e.geomType() for e in edges} == {"CIRCLE", "LINE"}


def test_curves_of_a_torus_in_both_directions():
    face = face_of(cq.Workplane().add(cq.Solid.makeTorus(10, 3)).val(), "TORUS")
    seams = [use for use in uses_of(face) if not use.backward]
    assert len(seams) == 2 and pcurves.periods(face) == pytest.approx((TURN, TURN))
    moved(face, lambda k: (TURN, -2 * TURN))
    pcurves.close_loops(face)
    closed_from_nought(face, (0.0, TURN))


def test_broken_cylinders_of_the_hard_case():
    for which in ("seam", "top", "bottom"):
        face = face_of(shifted_cylinder(which), "CYLINDER")
        pcurves.close_loops(face)
        v = np.array([use.ends for use in uses_of(face)])[..., 1]
        closed_from_nought(face, (v.min(), v.max()))


def test_each_wire_of_a_face_is_chained_by_itself():
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.gp import gp_Vec2d
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    drilled = cq.Workplane().cylinder(10, 3).cut(cq.Workplane("XZ").cylinder(20, 1)).val()
    face = max((f for f in drilled.Faces() if f.geomType() == "CYLINDER"), key=lambda f: f.Area())
    face = forward(face.wrapped)
    wires = list(sub_shapes(face, Kind.TopAbs_WIRE))
    period = np.array(pcurves.periods(face))
    assert len(wires) == 3
    for turns, wire in enumerate(wires, 2):
        seen = [use.edge.TShape() for use in pcurves._uses(wire, face)]
        for use in pcurves._uses(wire, face):
            if seen.count(use.edge.TShape()) == 1:
                curve = use.curve.Copy()
                curve.Translate(gp_Vec2d(TURN * turns, 0))
                BRep_Builder().UpdateEdge(use.edge, curve, face, BRep_Tool.Tolerance_s(use.edge))
    pcurves.close_loops(face)
    for wire in wires:
        ends = np.array([use.ends for use in pcurves._in_order(pcurves._uses(wire, face), period)])
        assert ends[1:, 0] == pytest.approx(ends[:-1, 1], abs=1e-6)
        assert -1e-6 <= ends[..., 0].min() < TURN


def test_a_wire_without_edges_is_passed_over():
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Wire

    face, empty = face_of(cq.Workplane().cylinder(10, 3).val(), "CYLINDER"), TopoDS_Wire()
    BRep_Builder().MakeWire(empty)
    face.Free(True)
    BRep_Builder().Add(face, empty)
    pcurves.close_loops(face)


def test_a_plane_is_left_alone(monkeypatch):
    face = face_of(cq.Workplane().box(1, 2, 3).val(), "PLANE")
    monkeypatch.setattr(pcurves, "_uses", None)
    pcurves.close_loops(face)
    assert pcurves.periods(face) == (math.inf, math.inf)


def test_periods():
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Face

    assert pcurves.periods(face_of(cq.Workplane().cylinder(10, 3).val(), "CYLINDER")) == (TURN, math.inf)
    empty = TopoDS_Face()
    BRep_Builder().MakeFace(empty)
    assert pcurves.periods(empty) == (math.inf, math.inf)


def test_whole_periods():
    inf = math.inf
    offset, period = np.array([6.9, 100.0]), np.array([2.0, inf])
    assert pcurves._whole_periods(offset, period).tolist() == [6.0, 0.0]
    assert pcurves._whole_periods(-offset, period).tolist() == [-6.0, 0.0]
    assert pcurves._whole_periods(np.array([7.1, -7.1]), np.array([2.0, 2.0])).tolist() == [8.0, -8.0]
    assert pcurves._whole_periods(np.array([6.1, -6.1]), np.array([2.0, 2.0]), round_up=True).tolist() == [8.0, -6.0]
    # What is beyond by rounding alone takes no further period.
    assert pcurves._whole_periods(np.array([6.0 + 1e-7, 6.0 + 1e-5]), np.array([2.0, 2.0]), round_up=True).tolist() == [
        6.0,
        8.0,
    ]
    assert pcurves._whole_periods(
        np.array([6.0 + 1.5e-6, 6.0 + 3e-6]), np.array([2.0, 2.0]), round_up=True
    ).tolist() == [6.0, 8.0]


class Vertex(SimpleNamespace):
    def IsSame(self, other):  # noqa: N802
        return self.name == other.name


def use(name, first, last, start, end):
    edge = SimpleNamespace(TShape=lambda: name[0])
    ends = np.array([start, end], float)
    return pcurves._Use(edge, False, name, ends, (Vertex(name=first), Vertex(name=last)), np.zeros(2))


def order(*uses, period=(TURN, math.inf)):
    return [u.curve for u in pcurves._in_order(list(uses), np.array(period))]


def test_uses_follow_their_vertices():
    a, b, c = use("a", 1, 2, (0, 0), (1, 0)), use("b", 2, 3, (1, 0), (1, 1)), use("c", 3, 1, (1, 1), (0, 0))
    assert order(a, c, b) == ["a", "b", "c"] and order(c, b, a) == ["c", "a", "b"]
    assert order() == []
    # By its vertex, though another is nearer in (u, v).
    assert order(a, use("d", 9, 9, (1, 0), (2, 0)), use("b", 2, 3, (3, 3), (4, 4))) == ["a", "b", "d"]


def test_of_several_at_one_vertex_the_nearest_in_u_and_v_follows():
    a = use("a", 1, 1, (0, 0), (TURN, 0))
    up, down = use("s1", 1, 1, (TURN + 0.1, 0.1), (TURN, 1)), use("t1", 1, 1, (0.5, 0.2), (0, 1))
    assert order(a, down, up) == ["a", "s1", "t1"]
    # Whole periods do not count, in either direction; what is left of them does.
    far = use("s1", 1, 1, (5 * TURN + 0.1, 0.1), (TURN, 1))
    assert order(a, down, far) == ["a", "s1", "t1"]
    assert order(a, use("s1", 1, 1, (TURN, 2.0), (0, 0)), use("t1", 1, 1, (TURN, 1.0), (0, 0))) == ["a", "t1", "s1"]


def test_it_is_the_end_that_the_next_one_is_near_to():
    a = use("a", 1, 1, (0.2, 5), (1, 3))
    start, opposite, near = (use(n, 1, 1, at, (9, 9)) for n, at in (("s", (0.2, 5)), ("o", (-1, -3)), ("n", (1, 3.1))))
    assert order(a, start, opposite, near)[:2] == ["a", "n"]


def test_an_edge_does_not_follow_itself():
    seam, back = use("s1", 1, 1, (0, 0), (0, 1)), use("s2", 1, 1, (0, 1), (0, 0))
    assert order(seam, back, use("r", 1, 1, (0.4, 1), (2, 1))) == ["s1", "r", "s2"]


def test_uses_run_as_their_wire_does():
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    face = face_of(cq.Workplane().box(1, 2, 3).val(), "PLANE")
    (wire,) = sub_shapes(face, Kind.TopAbs_WIRE)
    uses = pcurves._uses(wire, face)
    assert len(uses) == 4 and {u.backward for u in uses} == {True, False}
    for u in pcurves._in_order(uses, np.array(pcurves.periods(face))):
        assert u.backward == (u.edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED)
        assert not u.shift.any() and u.shift.shape == (2,)
    loop = pcurves._in_order(uses, np.array(pcurves.periods(face)))
    for before, after in zip(loop, [*loop[1:], loop[0]], strict=True):
        assert before.vertices[1].IsSame(after.vertices[0])
        assert before.ends[1] == pytest.approx(after.ends[0], abs=1e-12)


def test_edges_within_a_face_are_none_of_its_outline():
    from OCP.BRep import BRep_Builder
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS_Wire

    face = face_of(cq.Workplane().box(1, 2, 3).val(), "PLANE")
    (wire,) = sub_shapes(face, Kind.TopAbs_WIRE)
    uses, other = pcurves._uses(wire, face), TopoDS_Wire()
    BRep_Builder().MakeWire(other)
    kinds = [TopAbs_Orientation.TopAbs_INTERNAL, TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_EXTERNAL]
    for one, kind in zip(uses, kinds, strict=False):
        BRep_Builder().Add(other, one.edge.Oriented(kind))
    assert len(pcurves._uses(other, face)) == 1


def off_its_edges(face):
    """How far curves in (u, v) are from their edges in space, at most."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Curve2d
    from OCP.TopoDS import TopoDS

    surface, worst = BRep_Tool.Surface_s(face), 0.0
    for item in cq.Face(face).Edges():
        edge = TopoDS.Edge_s(item.wrapped)
        if BRep_Tool.Degenerated_s(edge):
            continue
        curve = BRepAdaptor_Curve2d(edge, face)
        first, last = curve.FirstParameter(), curve.LastParameter()
        space = BRep_Tool.Curve_s(edge, 0.0, 1.0)
        for t in np.linspace(first, last, 7):
            uv = curve.Value(t)
            worst = max(worst, surface.Value(uv.X(), uv.Y()).Distance(space.Value(t)))
    return worst


def test_curves_are_projected_anew():
    face = face_of(cq.Workplane().cylinder(10, 3).val(), "CYLINDER")
    moved(face, lambda k: (0.3, 0.2))
    assert off_its_edges(face) > 0.1
    pcurves.project_pcurves(face)
    assert off_its_edges(face) < 1e-6
    # The seam still has two curves, a period from one another.
    u = sorted(use.ends[0][0] for use in uses_of(face) if use.edge.TShape() == seam_of(face))
    assert u[1] - u[0] == pytest.approx(TURN)


def seam_of(face):
    shapes = [use.edge.TShape() for use in uses_of(face)]
    return next(s for s in shapes if shapes.count(s) == 2)


def test_poles_keep_their_curves():
    from OCP.BRep import BRep_Tool

    face = face_of(cq.Workplane().sphere(3).val(), "SPHERE")
    before = [use.ends for use in uses_of(face) if BRep_Tool.Degenerated_s(use.edge)]
    pcurves.project_pcurves(face)
    after = [use.ends for use in uses_of(face) if BRep_Tool.Degenerated_s(use.edge)]
    assert len(before) == 2 and np.array(before) == pytest.approx(np.array(after))
    assert off_its_edges(face) < 1e-6
