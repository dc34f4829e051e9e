"""An eye close to things or among them: inside the bounding box, before and behind geometry, in the plane of a face.

What lies behind the eye is mirrored through it by a naive projection, and what crosses the plane of the eye runs
through infinity: it must be cut before it is projected (Blinn and Newell 1978), and the cut itself is no line.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from hlr.drawing.notes import Note
from support.at_size import AT_SIZE
from support.expected import Ink, agrees, by_oracle, differences, expect, ink
from support.meshes import BOX_EDGES, as_parts, box, face, merged, turned_over

AHEAD = box((-3, 20, -2), (3, 26, 4))
BEHIND = box((-3, -26, -2), (3, -20, 4))
TALL = np.tan(np.radians(30))
WIDE = TALL * 4 / 3
"""Half the frame at a distance of 1, for a field of view of 60 degrees."""


def looking(eye, target, fov=60.0):
    return hlr.Perspective(eye=eye, target=target, fov=fov)


def on_plane(pieces, distance):
    """Visible ink from pieces ((x, y), (x, y)) given at a distance of 1 from the eye."""
    return Ink(np.array(pieces, float).reshape(-1, 2, 2) * distance, np.zeros((0, 2, 2)))


@pytest.mark.parametrize("orientation", [turned_over, lambda mesh: mesh])
def test_inside_a_room_one_sees_the_far_wall_and_four_edges_that_come_nearer(picture, orientation):
    room = orientation(box((-10, -20, -8), (10, 20, 8)))
    drawing = hlr.draw(room, perspective=looking((0, -5, 0), (0, 5, 0)), **AT_SIZE)
    # The far wall is 25 away; the four edges run out from its corners until the frame cuts them at the top.
    x, z = 10 / 25, 8 / 25
    out = TALL / z
    wall = [((sx * x, -z), (sx * x, z)) for sx in (-1, 1)] + [((-x, sz * z), (x, sz * z)) for sz in (-1, 1)]
    coming = [((sx * x, sz * z), (sx * x * out, sz * TALL)) for sx in (-1, 1) for sz in (-1, 1)]
    assert x * out < WIDE
    agrees(drawing, on_plane([*wall, *coming], 10))
    picture(drawing)


@pytest.mark.parametrize("how", [merged, as_parts])
def test_what_lies_behind_the_eye_is_not_there(how):
    camera = looking((1, 0, 3), (0, 20, 1))
    with_it = hlr.draw(how(AHEAD, BEHIND), perspective=camera, **AT_SIZE)
    without = hlr.draw(AHEAD, perspective=camera, **AT_SIZE)
    assert not differences(ink(without), ink(with_it), without.accuracy.used)
    agrees(with_it, by_oracle(with_it, *AHEAD, BOX_EDGES))


def test_an_eye_inside_the_bounding_box(picture):
    # Two blocks before the eye, one to the right and one to the left, and a third beyond: the box around all holds the
    # eye.
    points, triangles = merged(
        box((20, -4, -3), (26, 2, 3)), box((-4, 20, -3), (2, 26, 3)), box((9, 15, -6), (30, 30, 2))
    )
    assert (points.min(axis=0) < 0).all() and (points.max(axis=0) > 0).all()
    drawing = hlr.draw((points, triangles), perspective=looking((0, 0, 0), (10, 10, 0), 100), **AT_SIZE)
    edges = [(i + 8 * k, j + 8 * k) for k in range(3) for i, j in BOX_EDGES]
    agrees(drawing, by_oracle(drawing, points, triangles, edges), step=0.3)
    picture(drawing, "among")


@pytest.mark.parametrize("fov", [30.0, 60.0, 100.0])
def test_a_floor_that_runs_under_the_eye_and_on_behind_it(fov):
    floor = face((-10, -30, -5), (10, -30, -5), (10, 30, -5), (-10, 30, -5))
    drawing = hlr.draw(floor, perspective=looking((0, 0, 0), (0, 10, 0), fov), **AT_SIZE)
    tall = np.tan(np.radians(fov / 2))
    wide = tall * 4 / 3
    # Its sides come from the far corners at (10, 5) / 30 straight away from the vanishing point, to the frame.
    out = min(wide / (10 / 30), tall / (5 / 30))
    far = ((-10 / 30, -5 / 30), (10 / 30, -5 / 30))
    coming = [((s * 10 / 30, -5 / 30), (s * out * 10 / 30, -out * 5 / 30)) for s in (-1, 1)]
    agrees(drawing, on_plane([far, *coming], 10))


@pytest.mark.parametrize("off", [0.0, 1e-12, 1e-9, -1e-9])
def test_an_eye_in_the_plane_of_a_face_sees_it_as_a_line(off):
    points, triangles = box((-10, -10, -10), (10, 10, 10))
    drawing = hlr.draw((points, triangles), perspective=looking((10 + off, -60, 3), (10 + off, 0, 3)), **AT_SIZE)
    agrees(drawing, by_oracle(drawing, points, triangles, BOX_EDGES))
    on_face = [line for line in drawing.lines if np.allclose(line.points3[:, 0], 10)]
    assert all(np.ptp(line.points[:, 0]) < 0.02 for line in on_face)


@pytest.mark.parametrize("distance", [0.5, 0.05, 0.02])
def test_an_eye_close_to_a_wall_sees_past_its_edge_only(distance):
    wall, block = face((-30, 0, -30), (5, 0, -30), (5, 0, 30), (-30, 0, 30)), box((-8, 10, -3), (12, 16, 3))
    drawing = hlr.draw(as_parts(wall, block), perspective=looking((5, -distance, 0), (5, 10, 0), 60), **AT_SIZE)
    seen = [line for line in drawing.lines if line.visible and line.part == 1]
    # The eye stands before the wall's border: to its right all is seen, to its left nothing.
    assert seen
    right = np.concatenate([line.points3 for line in seen])
    assert (right[:, 0] >= 5 - 0.01).all()
    hidden = np.concatenate([line.points3 for line in drawing.lines if not line.visible and line.part == 1])
    assert hidden[:, 0].min() < 5 - 0.01


def test_an_eye_at_its_target_is_refused_in_words():
    with pytest.raises(hlr.ViewError, match="eye and target are one point"):
        hlr.draw(AHEAD, perspective=looking((0, 20, 0), (0, 20, 0)), **AT_SIZE)


PAST = "no line of the model lies in this view: the eye looks past it, or at a face that fills the view."


def test_an_eye_that_sees_nothing_says_so():
    drawing = hlr.draw(AHEAD, perspective=looking((0, 0, 0), (0, -10, 0)), **AT_SIZE)
    assert drawing.lines == ()
    assert drawing.notes == (Note("nothing-in-view", PAST),)


def test_from_far_away_perspective_becomes_parallel():
    points, triangles = AHEAD
    centre = (points[0] + points[-1]) / 2
    far = centre + np.array([1, -1, 1]) * 1e5
    one = hlr.draw((points, triangles), perspective=looking(tuple(far), tuple(centre), 0.01), **AT_SIZE)
    other = hlr.draw((points, triangles), "iso", **AT_SIZE)
    shift = expect(other, [(centre, centre)]).visible[0, 0]
    there = ink(one)
    there = Ink(there.visible + shift, there.hidden + shift)
    assert not differences(ink(other), there, other.accuracy.used)
