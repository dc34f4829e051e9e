"""A hole with two flat sides, its rim chamfered: where cone and flat meet, both had the same triangles.

Seen in an example of build123d. The edge between cone and flat bulges out of both faces, so that a triangle or a fan of
triangles between its points belonged to both: four triangles met at the diagonal. Left out as duplicates, they left
"1 duplicated triangle; open: 1 border edge; 1 non-manifold edge" of a sound solid.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from hlr.scene.shared_diagonals import without_shared_diagonals
from hlr.source import open_source

cq = pytest.importorskip("cadquery")


def holed(turn=0.0):
    hole = cq.Workplane().circle(2.5).extrude(15, both=True).intersect(cq.Workplane().box(4, 5, 30))
    part = cq.Workplane().box(10, 10, 15).cut(hole)
    (rim,) = part.faces(">Z").val().innerWires()
    return part.newObject(rim.Edges()).chamfer(0.5).rotate((0, 0, 0), (0, 0, 1), turn)


def meshes():
    """The part for many chord errors, so that fans of all kinds come up."""
    for turn in (0.0, 30.0):
        source = open_source(holed(turn))
        for error in np.geomspace(0.1, 1e-4, 25):
            (part,) = source.mesh(float(error), 0.5).parts
            yield part


def crowded(part):
    """How many sides have more than two triangles."""
    ends = np.sort(np.stack([part.triangles, np.roll(part.triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    return int((np.unique(ends, axis=0, return_counts=True)[1] > 2).sum())


def area(part, face):
    a, b, c = part.points[part.triangles[part.triangle_face == face]].transpose(1, 0, 2)
    return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def test_no_diagonal_belongs_to_two_faces():
    found = 0
    for part in meshes():
        before, mended = crowded(part), without_shared_diagonals(part)
        assert crowded(mended) == 0
        found += before > 0
        # Planes are as large as before, and all other faces are as they were.
        for face in range(len(part.face_planar)):
            assert area(mended, face) == pytest.approx(area(part, face), rel=1e-9)
        curved = ~part.face_planar[part.triangle_face]
        assert (mended.triangles[curved] == part.triangles[curved]).all()
        assert (mended.triangle_face == part.triangle_face).all()
        # Each corner keeps its place on the surface of its face.
        on = mended.surface_parameters
        for k in np.flatnonzero((mended.triangles != part.triangles).any(axis=1)):
            for node, corner in zip(mended.triangles[k], on.corner[k], strict=True):
                rows, columns = np.nonzero(part.triangles[part.triangle_face == part.triangle_face[k]] == node)
                same = on.uv[part.surface_parameters.corner[part.triangle_face == part.triangle_face[k]][rows, columns]]
                assert (np.abs(same - on.uv[corner]).sum(axis=1) < 1e-9).any()
    assert found >= 5


@pytest.mark.parametrize("scale", [1.0, 2.0, 5.0, 20.0, 50.0])
def test_the_solid_is_sound(scale):
    drawing = hlr.draw(holed(), view="iso", scale=scale)
    assert not [note for note in drawing.notes if note.is_warning]
