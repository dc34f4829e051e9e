"""A section of a mesh whose surface is closed, but not its triangles: some are listed twice or turned over, neighbours
have other corners along their edge, or the corners of one point are rounded apart.

Drawn whole, such a mesh is mended. Cut, it must be mended as well: one fault left the body without a cut face and
without a hatch, hollow to the eye.
"""

from __future__ import annotations

import numpy as np
import pytest

from hlr.source.mesh.mending import turned_alike
from support.sections import DEPTH, HEIGHT, RADIUS, WIDTH, hatched_area, mesh_of, outlines_of, plate, section


def listed_twice(points, triangles, some):
    return points, np.concatenate([triangles, triangles[some]])


def listed_from_both_sides(points, triangles, some):
    return points, np.concatenate([triangles, triangles[some][:, ::-1]])


def turned_over(points, triangles, some):
    changed = triangles.copy()
    changed[some] = triangles[some][:, ::-1]
    return points, changed


def divided_alone(points, triangles, some):
    """Each of some triangles has a corner in the middle of its first edge, which its neighbour does not have."""
    a, b, c = triangles[some].T
    middle = len(points) + np.arange(len(a))
    made = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
    return np.concatenate([points, 0.5 * (points[a] + points[b])]), np.concatenate([triangles[~some], made])


def rounded_apart(points, triangles, some):
    """Each triangle has corners of its own, a ten-millionth of a millimetre off."""
    off = np.random.default_rng(3).uniform(-1e-7, 1e-7, (3 * len(triangles), 3))
    return points[triangles.ravel()] + off, np.arange(3 * len(triangles)).reshape(-1, 3)


FAULTS = [listed_twice, listed_from_both_sides, turned_over, divided_alone, rounded_apart]


def faulty(fault):
    points, triangles = mesh_of(plate())
    return fault(points, triangles, np.arange(len(triangles)) % 7 == 2)


@pytest.mark.parametrize("fault", FAULTS)
def test_it_is_hatched_as_the_sound_one(fault, picture):
    found, sound = section(faulty(fault)), section(mesh_of(plate()))
    assert hatched_area(found, 3.0) == pytest.approx(hatched_area(sound, 3.0), rel=0.01)
    assert hatched_area(found, 3.0) == pytest.approx((WIDTH - 2 * RADIUS) * HEIGHT, rel=0.1)
    assert outlines_of(found) == outlines_of(sound)
    assert not [note for note in found.notes if note.code == "section-not-hatched"]
    picture(found)


@pytest.mark.parametrize("fault", FAULTS)
def test_so_it_is_where_the_plane_steps(fault):
    place = (-DEPTH / 4, (WIDTH / 3, DEPTH / 4))
    found, sound = section(faulty(fault), where=place), section(mesh_of(plate()), where=place)
    assert hatched_area(found, 3.0) == pytest.approx(hatched_area(sound, 3.0), rel=0.01)


def test_each_sheet_is_turned_as_most_of_its_triangles():
    box = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)], np.int32)
    for k in range(4):
        changed = box.copy()
        changed[k] = box[k, ::-1]
        assert (turned_alike(np.concatenate([changed, box[:, ::-1] + 4]), 8) == [*box, *(box[:, ::-1] + 4)]).all()
    # A strip that is joined to itself turned over has no second side.
    strip = np.array([(0, 1, 2), (2, 1, 3), (2, 3, 4), (4, 3, 5), (4, 5, 1), (1, 5, 0)], np.int32)
    assert (turned_alike(strip, 6) == strip).all()
