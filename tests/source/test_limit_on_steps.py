"""The work on one face has a bound. Where it is reached, the face keeps the mesh that it has, and a warning says how
far that may be off. OpenCASCADE is not asked: its mesher cannot be interrupted.

A face that reaches half a billion steps takes some ten seconds, so these tests lower the limit.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from hlr.errors import StrictError
from hlr.source import open_source
from hlr.source.cad import tessellator
from support.over_fitted import filled, ripple

cq = pytest.importorskip("cadquery")

DEFLECTION = 0.005
"""Half of it, 0.0025 mm, is for the chord error of each surface."""

NOTE = 'Part "part": 1 of 1 faces takes too much work to be meshed as finely as needed, and may be {} mm off (face 0).'


def drawable():
    """The face, and a box beside it that takes no steps to speak of."""
    return [filled(), cq.Workplane().box(1, 1, 1).translate((-9, 0, 0)).val()]


@pytest.fixture
def limited(monkeypatch):
    """A function that limits the steps of each face, after which OpenCASCADE must not be asked for any."""
    mesh = tessellator._kernel.BrepModel.mesh

    def never(*given):
        raise AssertionError("OpenCASCADE is asked for a face")

    def limit(most_steps):
        monkeypatch.setattr(tessellator._kernel.BrepModel, "mesh", lambda *given: mesh(*given, most_steps))
        monkeypatch.setattr(tessellator, "rescue", never)

    return limit


def border(part):
    """Sides of one triangle only, each as two points of the part, ascending."""
    sides = np.sort(part.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    found, times = np.unique(sides, axis=0, return_counts=True)
    assert times.max() == 2
    return found[times == 1].tolist()


def chords(part):
    """The same of its edges."""
    lines = np.split(part.edge_nodes, part.edge_offsets[1:-1])
    return sorted(sorted(chord) for line in lines for chord in zip(line[:-1].tolist(), line[1:].tolist(), strict=True))


def farthest(face, part):
    """How far the surface is off the planes of the triangles, at their centroids and the middles of their sides."""
    from OCP.BRep import BRep_Tool

    surface = BRep_Tool.Surface_s(face.wrapped)
    corners, found = part.points[part.triangles], part.surface_parameters
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    off = 0.0
    for shares in ([1 / 3, 1 / 3, 1 / 3], [0.5, 0.5, 0], [0, 0.5, 0.5], [0.5, 0, 0.5]):
        places = np.einsum("k,nkd->nd", shares, found.uv[found.corner])
        points = np.array([surface.Value(*place).Coord() for place in places.tolist()])
        off = max(off, float(np.abs(np.einsum("nd,nd->n", points - corners[:, 0], normals)).max()))
    return off


# 100,000 steps end where points are inserted. With 200,000 the steps are left over for a second round, with more points
# on the border, but not enough of them: the inside is meshed for a larger chord error.
@pytest.mark.parametrize(("most_steps", "triangles"), [(100_000, (5_000, 6_000)), (200_000, (500, 1_500))])
def test_a_face_keeps_the_mesh_that_it_has(limited, most_steps, triangles):
    limited(most_steps)
    found = open_source(drawable()).mesh(DEFLECTION, 0.5)
    face, box = found.parts
    assert triangles[0] < len(face.triangles) < triangles[1] and len(box.triangles) == 12
    assert (found.rescued, found.lost) == (0, 0)
    assert border(face) == chords(face)
    (note,) = found.notes
    assert note.code == "faces-too-coarse" and note.is_warning
    off = float(note.text.split()[-5])
    assert note.text == NOTE.format(note.text.split()[-5])
    assert 0.0025 < farthest(filled(), face) < off < 0.1


def test_how_far_spikes_are_off_is_measured(limited):
    # Estimates from second derivatives at the corners say little there: 8.2 mm where planes of triangles are 14 mm off.
    limited(4_500_000)
    found = open_source(ripple()).mesh(1.25, 0.5)
    (face,), (note,) = found.parts, found.notes
    off = float(note.text.split()[-5])
    assert note.text == NOTE.format(note.text.split()[-5])
    assert 10 < farthest(ripple(), face) < off < 20


def test_a_face_that_has_no_mesh_by_then_is_lost(limited):
    limited(1_000)
    found = open_source(drawable()).mesh(DEFLECTION, 0.5)
    assert (found.rescued, found.lost, len(found.parts)) == (0, 1, 1)
    assert [note.code for note in found.notes if note.is_warning] == ["not-meshed", "part-left-out"]


def test_enough_steps_give_the_mesh_without_a_limit(limited):
    whole = open_source(drawable()).mesh(DEFLECTION, 0.5)
    limited(1_000_000)
    found = open_source(drawable()).mesh(DEFLECTION, 0.5)
    assert not whole.notes and not found.notes
    assert np.array_equal(found.parts[0].triangles, whole.parts[0].triangles)


def test_the_warning_is_an_error_where_strict_asks_for_it(limited):
    limited(250_000)
    drawing = hlr.draw(drawable(), "top", scale=1.0, accuracy=DEFLECTION)
    assert "faces-too-coarse" in [note.code for note in drawing.notes if note.is_warning]
    assert {line.edge for line in drawing.lines if line.part == 0} == {0, 1, 2}
    with pytest.raises(StrictError, match="too much work to be meshed"):
        hlr.draw(drawable(), "top", scale=1.0, accuracy=DEFLECTION, strict=True)
