"""Triangles of another mesher count only where they fill the face: a lost, turned or doubled one is found."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

from hlr.source import open_source
from hlr.source.cad import rescue
from hlr.source.cad.rescue import faces_of, run_mesher
from support.brep_shapes import scrawled_cylinder

SHAPES = {
    "plate": lambda: cq.Workplane().box(30, 30, 4).faces(">Z").workplane().rarray(6, 6, 4, 4).hole(3),
    "sphere": lambda: cq.Workplane().sphere(4),
    "torus": lambda: cq.Workplane(obj=cq.Solid.makeTorus(6, 2)),
    "cone": lambda: cq.Workplane(obj=cq.Solid.makeCone(3, 0, 5)),
    "fillets": lambda: cq.Workplane().box(3, 4, 5).edges().fillet(0.4),
}


def opened(shape):
    """A mesh of the kernel, and the first few underlying faces, taken forward and without placement."""
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    source = open_source(shape)
    source.mesh(0.02, 0.3)
    model = source._tessellator._model
    faces = faces_of(source.prototypes.shapes, set(range(min(4, model.n_faces))))
    forward = TopAbs_Orientation.TopAbs_FORWARD
    return model.mesh(0.02, 0.3), {
        number: TopoDS.Face(face.Located(TopLoc_Location(), False).Oriented(forward)) for number, face in faces.items()
    }


@pytest.mark.parametrize("name", SHAPES)
def test_a_lost_turned_or_doubled_triangle_is_found(name):
    meshed, faces = opened(SHAPES[name]())
    assert faces
    for number, face in faces.items():
        copy, counterpart = next(rescue._repairs(face))()
        run_mesher(copy, 0.04, 0.3)
        points, uv, triangles = rescue._triangles(copy)
        borders = rescue._borders(face, copy, counterpart, triangles)
        for wrong in (triangles[1:], triangles[[*range(len(triangles)), 0]], triangles[:0]):
            assert not meshed.replace(number, points, uv, wrong, borders)
        turned = triangles.copy()
        turned[0] = turned[0][[0, 2, 1]]
        assert not meshed.replace(number, points, uv, turned, borders)
        assert not meshed.replace(number, points, uv, triangles, borders[1:])
        assert meshed.replace(number, points, uv, triangles, borders)


def test_triangles_without_the_area_of_the_face_are_found():
    """In (u, v) all is as it should be; in space the face has shrunk, or is twice as large."""
    meshed, faces = opened(SHAPES["plate"]())
    copy, counterpart = next(rescue._repairs(faces[0]))()
    run_mesher(copy, 0.04, 0.3)
    points, uv, triangles = rescue._triangles(copy)
    borders = rescue._borders(faces[0], copy, counterpart, triangles)
    for share in (0.5, 2.0, np.nan):
        assert not meshed.replace(0, points, share * uv, triangles, borders)
    assert meshed.replace(0, points, uv, triangles, borders)


def losing(face, deflection, angle):
    """A mesher that silently loses half the triangles."""
    from OCP.BRep import BRep_Tool
    from OCP.TopLoc import TopLoc_Location

    run_mesher(face, deflection, angle)
    triangulation = BRep_Tool.Triangulation_s(face, TopLoc_Location())
    triangulation.ResizeTriangles(triangulation.NbTriangles() // 2, True)


@pytest.mark.parametrize("mesher", [losing, lambda *_: None])
def test_half_a_face_is_never_taken_for_a_whole(mesher, monkeypatch):
    meshed, faces = opened(SHAPES["fillets"]())
    assert all(rescue.rescue(meshed, number, face, 0.02, 0.3) for number, face in faces.items())
    monkeypatch.setattr(rescue, "run_mesher", mesher)
    assert not any(rescue.rescue(meshed, number, face, 0.02, 0.3) for number, face in faces.items())


def test_a_face_without_loops_is_not_given_to_the_other_mesher(monkeypatch):
    """Nothing would tell whether its triangles fill it, and on a spline that took more than ten minutes."""
    from OCP.BRep import BRep_Builder
    from OCP.Geom import Geom_OffsetSurface
    from OCP.TopoDS import TopoDS_Face

    profile = cq.Workplane("XZ").moveTo(2, 0).spline([(8, 4), (5, 10), (9, 17)], includeCurrent=True)
    around = profile.lineTo(1, 22).close().revolve(360, (0, 0, 0), (0, 1, 0)).val()
    widest = max(around.Faces(), key=lambda face: face.Area())
    bare = TopoDS_Face()
    BRep_Builder().MakeFace(bare, Geom_OffsetSurface(widest._geomAdaptor(), 0.5), 1e-7)
    asked = []
    monkeypatch.setattr(rescue, "run_mesher", lambda *given: asked.append(given))
    source = open_source([cq.Workplane().box(1, 1, 1), cq.Face(bare)])
    assert len(source.mesh(0.005, 0.5).parts) == 1
    assert [note.code for note in source.notes] == []
    assert asked == []


@pytest.mark.parametrize("deflection", [1e-3, 1e-6])
def test_its_work_has_a_bound(deflection):
    """Of what is asked for, it does what takes it a few seconds; a warning says how far off that may be."""
    solid, side = scrawled_cylinder()
    size = float(np.hypot(np.hypot(6, 6), 10))
    assert rescue.smallest_deflection(side) == pytest.approx(rescue.SMALLEST_DEFLECTION * size, rel=0.01)
    source = open_source(solid)
    meshed = source.mesh(deflection, 0.5)
    assert meshed.rescued == 1
    notes = {note.code: note.text for note in meshed.notes}
    if deflection == 1e-3:
        assert "faces-too-coarse" not in notes
    else:
        assert "may be 0.00066 mm off" in notes["faces-too-coarse"]
