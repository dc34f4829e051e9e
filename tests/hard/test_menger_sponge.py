"""A Menger sponge: holes in holes, all faces in a few planes, every line of sight along an axis grazing hundreds.

Coplanar and collinear everywhere: a kernel that leaves ties to rounding draws the insides of the tunnels.
"""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, covers, expect, wrong_by_rays
from support.meshes import ring, sharp_edges, split

SIZE = 27.0


def sponge(level):
    """Closed mesh of the unit faces between what is filled and what is not, corners joined."""
    n = 3**level
    cells = np.indices((n, n, n)).reshape(3, -1).T
    filled = np.ones(len(cells), bool)
    for k in range(level):
        filled &= ((cells // 3**k % 3) == 1).sum(axis=1) < 2
    solid = np.zeros((n + 2,) * 3, bool)
    solid[tuple((cells[filled] + 1).T)] = True
    quads = []
    for axis in range(3):
        u, v = np.eye(3, dtype=int)[(axis + 1) % 3], np.eye(3, dtype=int)[(axis + 2) % 3]
        ahead = np.roll(solid, -1, axis)
        for inside, outside, step in ((solid, ahead, 1), (ahead, solid, -1)):
            at = np.argwhere(inside & ~outside) - 1
            at[:, axis] += 1
            quads.append(np.stack([at, at + u, at + u + v, at + v][::step], axis=1))
    corners = np.concatenate(quads)
    points, number = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    return points * (SIZE / n), split(number.reshape(-1, 4))


def carpet(level):
    """The squares of a Sierpinski carpet: the outer one, and every hole; in units of the cell."""
    n = 3**level
    yield 0, 0, n
    for k in range(level):
        side = 3**k
        for i, j in itertools.product(range(n // (3 * side)), repeat=2):
            if not any(i // 3**m % 3 == 1 == j // 3**m % 3 for m in range(level)):
                yield (3 * i + 1) * side, (3 * j + 1) * side, side


@pytest.mark.parametrize(("level", "faces"), [(1, 72), (2, 1056), (3, 18048)])
def test_there_are_as_many_faces_as_the_formula_says(level, faces):
    assert len(sponge(level)[1]) == 2 * faces == 2 * (2 * 20**level + 4 * 8**level)


@pytest.mark.slow
@pytest.mark.parametrize("level", [1, 2, 3])
@pytest.mark.parametrize("view", ["front", "top"])
def test_along_an_axis_it_is_a_carpet_and_nothing_shows_through_the_holes(picture, level, view):
    drawing = hlr.draw(sponge(level), view, hidden=False, scale=1.0, smooth=False)
    unit = SIZE / 3**level
    squares = [np.array([[x, y], [x + s, y], [x + s, y + s], [x, y + s]]) * unit for x, y, s in carpet(level)]
    sides = [
        side for corners in squares for side in ring([(x, 0, y) if view == "front" else (x, y, 0) for x, y in corners])
    ]
    agrees(drawing, expect(drawing, sides), step=0.2)
    assert sum(map(float, [drawing.counters["failed_checks"], drawing.counters["contradictions"]])) == 0
    if (level, view) == (2, "front"):
        picture(drawing)


@pytest.mark.slow
@pytest.mark.parametrize("level", [1, 2])
@pytest.mark.parametrize("view", ["iso", (3, -1, 2)])
def test_obliquely_every_edge_is_there_and_rays_agree(picture, level, view):
    points, triangles = sponge(level)
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    covers(drawing, [points[list(edge)] for edge in sharp_edges((points, triangles))], step=0.5)
    judged, wrong = wrong_by_rays(drawing, points, triangles)
    assert judged > 100 * 8**level / 8
    assert wrong == 0
    if (level, view) == (1, "iso"):
        picture(drawing, "iso")
