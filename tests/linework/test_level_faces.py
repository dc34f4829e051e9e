"""Which faces on the plane of a section were inside the model before it was cut."""

from types import SimpleNamespace

import numpy as np
import pytest

from hlr.linework.level_faces import cut_ones, with_level_faces

UP = np.array([0.0, 0.0, 1.0])
BOX = np.array([(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7),
                (2, 7, 6), (3, 0, 4), (3, 4, 7)])  # fmt: skip


def box(x0, x1, z0, z1, name="box"):
    points = [(x, y, z) for z in (z0, z1) for x, y in ((x0, 0.0), (x1, 0.0), (x1, 4.0), (x0, 4.0))]
    return SimpleNamespace(name=name, points=np.array(points, float), triangles=BOX, brep=False)


def flat(*corners, brep=False):
    """Triangles on z = 0."""
    points = np.array([(x, y, 0.0) for triangle in corners for x, y in triangle])
    return SimpleNamespace(points=points, brep=brep), np.arange(len(points)).reshape(-1, 3)


INSIDE, BESIDE = [(1, 1), (3, 1), (1, 3)], [(6, 1), (8, 1), (6, 3)]


@pytest.mark.parametrize("turned", [False, True])
def test_a_triangle_below_material_is_cut_and_others_are_not(turned):
    part, triangles = flat(INSIDE, BESIDE)
    whole = box(0, 5, -3, 3)
    whole.triangles = whole.triangles[:, ::-1] if turned else whole.triangles
    assert cut_ones(part, triangles, np.zeros(2, int), whole, UP, 1e-9).tolist() == [True, False]


@pytest.mark.parametrize(("low", "high"), [(-3, 0), (1, 3), (-3, -1)])
def test_only_what_lies_just_before_the_plane_counts(low, high):
    """A body that ends in the plane, one that begins farther before it, and one that lies behind it."""
    part, triangles = flat(INSIDE)
    assert not cut_ones(part, triangles, np.zeros(1, int), box(0, 5, low, high), UP, 1e-9).any()


def test_the_larger_share_decides_for_a_face_of_a_brep():
    whole, faces = box(0, 5, -3, 3), np.array([0, 0, 1, 1])
    small = [(6, 1), (6.5, 1), (6, 1.5)]
    for brep, found in ((False, [True, False, False, True]), (True, [True, True, False, False])):
        part, triangles = flat(INSIDE, small, BESIDE, [(1, 1), (1.5, 1), (1, 1.5)], brep=brep)
        assert cut_ones(part, triangles, faces, whole, UP, 1e-9).tolist() == found


def test_parts_with_a_face_in_the_plane_that_looks_to_the_viewer_are_found():
    parts = [box(0, 5, -3, 0, "below"), box(0, 5, 0, 3, "above"), box(0, 5, -3, 3, "through")]
    assert list(with_level_faces(parts, np.zeros(3), UP, 1e-9)) == ["below"]
    assert list(with_level_faces(parts, np.zeros(3), -UP, 1e-9)) == ["above"]
