"""Two tetrahedra through one another, as one mesh: Kepler's star.

No edge lies where the faces cut each other, so each edge is pierced twice, in places where nothing else happens. Along
an axis all twelve edges fall on a square and its diagonals, front edges over back edges.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, expect
from support.meshes import as_parts, merged, ring

A = 10.0
FACES = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
ONE = np.array([(A, A, A), (A, -A, -A), (-A, A, -A), (-A, -A, A)])
EDGES = [(i, j) for i in range(8) for j in range(i + 1, 8) if i // 4 == j // 4]
STAR = merged((ONE, FACES), (-ONE, FACES[:, ::-1]))


@pytest.mark.parametrize("view", ["front", "right", "top"])
def test_along_an_axis_it_is_a_square_with_both_diagonals(picture, view):
    drawing = hlr.draw(STAR, view, **AT_SIZE)
    v = [
        np.asarray(drawing.view.right) * x * A + np.asarray(drawing.view.up) * y * A
        for x, y in ((1, 1), (1, -1), (-1, -1), (-1, 1))
    ]
    # Edges are diagonals of the cube's faces: those of the faces seen on edge make up the square.
    agrees(drawing, expect(drawing, [*ring(v), (v[0], v[2]), (v[1], v[3])]), without=("intersection",))
    if view == "front":
        picture(drawing)


@pytest.mark.parametrize("how", ["mesh", "parts", "turned over"])
@pytest.mark.parametrize("view", ["iso", (1, -2, 0.7), (1, 1, 0), (0.01, -1, 0.02)])
def test_edges_are_seen_outside_the_other_tetrahedron_only(picture, how, view):
    points, triangles = STAR
    model = {
        "mesh": STAR,
        "parts": as_parts((ONE, FACES), (-ONE, FACES[:, ::-1])),
        "turned over": (points, triangles[:, ::-1]),
    }[how]
    drawing = hlr.draw(model, view, **AT_SIZE)
    agrees(drawing, by_oracle(drawing, points, triangles, EDGES), without=("intersection",))
    if view == (1, -2, 0.7) and how == "mesh":
        picture(drawing, "oblique")


def test_three_edges_meet_the_eye_whole_and_the_rest_in_halves():
    # An edge is cut in its middle, where it meets one of the other tetrahedron, or not at all.
    drawing = hlr.draw(STAR, (1, -2, 0.7), **AT_SIZE)
    ends = {tuple(p) for line in drawing.lines for p in np.abs(line.points3[[0, -1]]).round(6).tolist()}
    assert (A, A, A) in ends
    assert {e for e in ends if sorted(e) == [0, 0, A]}
