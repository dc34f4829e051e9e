"""Faces whose triangles do not fill their outline are found, whatever OpenCASCADE says, and meshed otherwise."""

from __future__ import annotations

from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest

from hlr.source import open_source, rescue, tessellate
from hlr.source.filled import unfilled
from hlr.source.tables import FACE

SHAPES = {
    "plate": lambda: cq.Workplane().box(30, 30, 4).faces(">Z").workplane().rarray(6, 6, 4, 4).hole(3),
    "sphere": lambda: cq.Workplane().sphere(4),
    "torus": lambda: cq.Workplane(obj=cq.Solid.makeTorus(6, 2)),
    "cone": lambda: cq.Workplane(obj=cq.Solid.makeCone(3, 0, 5)),
    "fillets": lambda: cq.Workplane().box(3, 4, 5).edges().fillet(0.4),
}


def meshed(shape):
    from hlr.source.parts import compound

    source = open_source(shape)
    tessellator = tessellate.Tessellator(source._roots, 50.0)
    tessellator.mesh(0.02, 0.3)
    tables = tessellate.read_tables(compound([compound([]), *source._roots]))
    return tables, tessellator._periods


@pytest.mark.parametrize("name", SHAPES)
def test_sound_faces_pass_and_a_lost_or_folded_triangle_is_found(name):
    tables, periods = meshed(SHAPES[name]())
    assert unfilled(tables, 0.02, periods).tolist() == []
    faces = np.flatnonzero(tables.kind == FACE)
    for number in range(min(len(faces), 4)):
        first = tables.tri_start[tables.face_tri[faces[number]]]
        triangles = tables.triangles.copy()
        triangles[first] = triangles[first][[0, 0, 0]]
        assert unfilled(replace(tables, triangles=triangles), 1e-6, periods).tolist() == [number]
        triangles[first] = tables.triangles[first][[0, 2, 1]]
        assert unfilled(replace(tables, triangles=triangles), 1e-6, periods).tolist() == [number]


def losing(times):
    """OpenCASCADE's mesher, which silently loses half the triangles of every face, in its first so many runs."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    from hlr.source.mesher import run_mesher
    from hlr.source.parts import explored

    runs = []

    def run(shape, deflection, angle, delabella=True):
        faces = [TopoDS.Face_s(face) for face in explored(shape, Kind.TopAbs_FACE)]
        empty = [face for face in faces if BRep_Tool.Triangulation_s(face, TopLoc_Location()) is None]
        run_mesher(shape, deflection, angle, delabella)
        runs.append(shape)
        for face in empty if len(runs) <= times else []:
            triangulation = BRep_Tool.Triangulation_s(face, TopLoc_Location())
            triangulation.ResizeTriangles(triangulation.NbTriangles() // 2, True)

    return run


def area(part):
    a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
    return np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1)).sum() / 2


@pytest.mark.parametrize("times", [1, 99])
def test_half_a_face_is_never_taken_for_a_whole(times, monkeypatch):
    monkeypatch.setattr(tessellate, "run_mesher", losing(times))
    plate = cq.Workplane().box(8, 6, 2).edges("|Z").fillet(1)
    found = open_source(plate).mesh(0.01, 0.2)
    assert area(found.parts[0]) == pytest.approx(plate.val().Area(), rel=0.01)
    # The second run is another algorithm, on the caller's face; after that come mended copies.
    assert [note.code for note in found.notes] == ([] if times == 1 else ["faces-mended"])


def test_what_stays_half_is_said(monkeypatch):
    monkeypatch.setattr(tessellate, "run_mesher", losing(99))
    monkeypatch.setattr(rescue, "run_mesher", losing(99))
    (note,) = open_source(cq.Workplane().box(8, 6, 2)).mesh(0.01, 0.2).notes
    assert note.code == "not-meshed"
    assert "6 of 6 faces were meshed only in part, or folded (faces 0, 1, 2, 3, 4 and 1 more)." in note.text
