"""The kernel's own model and mesh of a shape, from OpenCASCADE's dump of it."""

from __future__ import annotations

import io

import cadquery as cq
import numpy as np
import pytest

from hlr import _kernel
from hlr.common.threads import at_most
from hlr.source.cad.shapes import make_compound


def dumped(*shapes):
    from OCP.BinTools import BinTools, BinTools_FormatVersion

    stream = io.BytesIO()
    version = BinTools_FormatVersion.BinTools_FormatVersion_VERSION_4
    BinTools.Write_s(make_compound([shape.val().wrapped for shape in shapes]), stream, False, False, version)
    return stream.getvalue()


def meshed(*shapes, deflection=0.02):
    model = _kernel.BrepModel(dumped(*shapes))
    found = model.mesh(deflection, 0.3)
    assert found.faults() == [] and found.is_sound()
    return found.parts(model.planar(1e-6))


def sides_of(triangles):
    """How many triangles the edges of a mesh have."""
    ends = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    return set(np.unique(ends, axis=0, return_counts=True)[1].tolist())


def volume(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return (np.cross(a, b) * c).sum() / 6


SOLIDS = {
    "holes": lambda: cq.Workplane().box(30, 30, 4).faces(">Z").workplane().rarray(6, 6, 4, 4).hole(3),
    "sphere": lambda: cq.Workplane().sphere(4),
    "torus": lambda: cq.Workplane(obj=cq.Solid.makeTorus(6, 2)),
    "cone": lambda: cq.Workplane(obj=cq.Solid.makeCone(3, 0, 5)),
    "fillets": lambda: cq.Workplane().box(3, 4, 5).edges().fillet(0.4),
    "spline": lambda: cq.Workplane().spline([(2, 0), (3, 2), (0, 3), (-2, 0)]).close().extrude(2, taper=5),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_a_solid_is_closed_turned_outward_and_as_large_as_it_is(name):
    shape = SOLIDS[name]()
    found = meshed(shape)
    assert sides_of(found.triangles) == {2}
    assert volume(found.points, found.triangles) == pytest.approx(shape.val().Volume(), rel=0.03)
    corners = found.uv[found.corner]
    assert corners.shape == (*found.triangles.shape, 2) and np.isfinite(corners).all()


def test_a_sphere_keeps_its_chord_error():
    for deflection in (0.1, 0.01):
        found = meshed(cq.Workplane().sphere(4), deflection=deflection)
        middle = found.points[found.triangles].mean(axis=1)
        assert 4 - np.linalg.norm(middle, axis=1).min() <= deflection
        assert np.linalg.norm(found.points, axis=1) == pytest.approx(4, abs=1e-9)


def test_planar_faces_have_no_points_inside():
    found = meshed(SOLIDS["holes"]())
    planar = found.face_planar[found.triangle_face]
    used = np.unique(found.triangles[planar])
    assert np.isin(used, found.edge_nodes).all()


def test_edges_are_known_by_how_their_faces_meet():
    found = meshed(cq.Workplane().box(3, 4, 5).edges("|Z").fillet(0.4))
    # Twelve arcs and lines above and below are sharp on both sides of 8; the fillets' 8 sides are smooth.
    assert np.bincount(found.edge_class).tolist() == [16, 8]
    assert np.bincount(meshed(cq.Workplane().cylinder(2, 1)).edge_class).tolist() == [2, 0, 1]
    assert np.bincount(meshed(cq.Workplane().rect(1, 1).extrude(1).faces(">Z")).edge_class).tolist() == [0, 0, 0, 4]


def test_threads_change_no_byte():
    model = _kernel.BrepModel(dumped(SOLIDS["fillets"](), SOLIDS["torus"]()))
    planar = model.planar(1e-6)

    def parts(threads):
        with at_most(threads):
            return model.mesh(0.01, 0.3).parts(planar)

    one, two = parts(1), parts(2)
    for name in ("points", "triangles", "corner", "uv", "edge_nodes", "edge_class"):
        assert np.array_equal(getattr(one, name), getattr(two, name))


def test_curves_of_edges_and_records_of_surfaces():
    model = _kernel.BrepModel(dumped(cq.Workplane().cylinder(2, 1)))
    kind, offsets, data = model.surface_records(np.arange(3, dtype=np.int32))
    assert sorted(kind.tolist()) == [1, 1, 2] and len(data) == offsets[-1]
    kind, bounds, _, _ = model.edge_curves(np.zeros(3, np.int32), np.arange(3, dtype=np.int32))
    assert sorted(kind.tolist()) == [1, 2, 2] and (bounds[:, 0] < bounds[:, 1]).all()


def test_triangles_that_do_not_fill_a_face_are_refused():
    model = _kernel.BrepModel(dumped(cq.Workplane().box(1, 2, 3)))
    found = model.mesh(0.05, 0.3)
    uv = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    points = np.column_stack([uv, np.zeros(4)])
    borders = [([k, (k + 1) % 4], [0.0, 1.0]) for k in range(4)]
    half = np.array([(0, 1, 2)], np.int32)
    assert not found.replace(0, points, uv, half, borders)
    assert not found.replace(0, points, uv, half, borders[:3])


def test_vertices_off_their_edges_keep_what_they_are_off_to_themselves():
    """Within its tolerance a vertex may lie beside the curves that end there: these are left near it, no earlier."""
    from OCP.BRep import BRep_Builder
    from OCP.gp import gp_Pnt

    box = cq.Workplane().box(20, 20, 20)
    for vertex in box.vertices().vals():
        place = np.sign(vertex.toTuple()) * 10 + (0.02, 0.03, 0.0)
        BRep_Builder().UpdateVertex(vertex.wrapped, gp_Pnt(*place.tolist()), 0.05)
    found = meshed(box, deflection=0.001)
    assert sides_of(found.triangles) == {2}
    points = found.points[found.edge_nodes]
    from_corner = np.abs(np.abs(points) - 10).max(axis=1)
    on_curve = np.sort(np.abs(np.abs(points) - 10), axis=1)[:, 1] < 1e-12
    assert (on_curve | (from_corner < 0.05)).all()
    # Of the 20 of each edge all but 0.11 at either end are on it.
    for k in range(len(found.edge_offsets) - 1):
        line = points[found.edge_offsets[k] : found.edge_offsets[k + 1]]
        on = line[on_curve[found.edge_offsets[k] : found.edge_offsets[k + 1]]]
        assert len(on) == 2 and np.linalg.norm(on[1] - on[0]) > 20 - 0.25


def test_a_damaged_dump_is_refused():
    whole = dumped(cq.Workplane().box(1, 2, 3))
    assert _kernel.BrepModel(whole).n_faces == 6
    with pytest.raises(ValueError, match="ends too early"):
        _kernel.BrepModel(whole[:-9])


def test_triangles_that_are_all_a_face_has_are_kept():
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS_Face

    ball = cq.Workplane().sphere(3)
    BRepMesh_IncrementalMesh(ball.val().wrapped, 0.5)
    triangles = BRep_Tool.Triangulation_s(ball.faces().val().wrapped, TopLoc_Location())
    bare = TopoDS_Face()
    BRep_Builder().MakeFace(bare, triangles)
    found = meshed(cq.Workplane(obj=cq.Face(bare)))
    # All but the two of which two corners lie in one place, a pole.
    assert len(found.triangles) == triangles.NbTriangles() - 2 and not found.brep.any()
