"""Scenes small enough to think about: the hard cases by name, and whatever `long_run.py` ever finds.

Each is held against the oracle as one part and as many, with and without a contact tolerance, in all eight mirror
images and with every edge drawn from its other end.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace

import pytest
from visibility import compare

from support.visibility import adapter
from support.visibility.scenes import Scene

CORPUS = {
    "an edge leaves a shared corner behind a face": Scene(
        ((0, 0, 0), (4, 0, 0), (0, 4, 0), (2, 1, 3)), ((0, 1, 2),), ((0, 3), (1, 3), (2, 3))
    ),
    "a face holds the line that it would hide": Scene(
        ((0, 0, 0), (4, 0, 4), (0, 4, 0), (1, 1, 1), (2, 1, 2)), ((0, 1, 2),), ((3, 4),)
    ),
    "a line passes under the diagonal two triangles share": Scene(
        ((0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (-1, -1, 2), (5, 5, 2)), ((0, 1, 2), (0, 2, 3)), ((4, 5),)
    ),
    "a line pierces where two triangles meet": Scene(
        ((0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (2, 2, -2), (3, 3, 1)), ((0, 1, 2), (0, 2, 3)), ((4, 5),)
    ),
    "three strips in a cycle": Scene(
        ((0, 0, 0), (6, 0, 3), (0, 1, 0), (5, -1, 0), (2, 6, 3), (6, 0, 0), (4, 6, 0), (0, -1, 3), (5, 6, 0)),
        ((0, 1, 2), (3, 4, 5), (6, 7, 8)),
    ),
    "the same face twice, once turned over": Scene(
        ((0, 0, 0), (3, 0, 1), (0, 3, 2), (0, 1, 5), (3, 1, 0)), ((0, 1, 2), (0, 2, 1)), ((3, 4),)
    ),
    "an edge-on face, and a line in its plane": Scene(
        ((0, 0, 0), (4, 0, 0), (2, 0, 4), (1, 0, 3), (3, 0, 1)), ((0, 1, 2),), ((3, 4),)
    ),
    "a contour over a contour over a line": Scene(
        ((0, 0, 0), (0, 4, 0), (3, 2, 0), (0, 0, 2), (0, 4, 2), (-3, 2, 2), (0, 0, 4), (0, 4, 4)),
        ((0, 1, 2), (3, 4, 5)),
        ((6, 7),),
    ),
    "a needle without area": Scene(((0, 0, 0), (2, 2, 0), (4, 4, 0), (0, 4, 1), (4, 0, 1)), ((0, 1, 2),), ((3, 4),)),
    "three faces on one edge": Scene(
        ((0, 0, 0), (0, 4, 0), (3, 2, 1), (-3, 2, 1), (2, 2, -2), (-3, 1, 3), (3, 3, 3)),
        ((0, 1, 2), (0, 1, 3), (0, 1, 4)),
        ((5, 6),),
    ),
    "a line ends on a face from behind": Scene(
        ((0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, 3), (1, 2, 0)), ((0, 1, 2),), ((3, 4),)
    ),
    "nothing to hide behind": Scene(((0, 0, 0), (1, 1, 1)), (), ((0, 1),)),
    "a line seen end-on": Scene(((0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, 1), (1, 1, 3)), ((0, 1, 2),), ((3, 4),)),
}


def mirrored(scene: Scene) -> Iterator[Scene]:
    for signs in itertools.product((1, -1), repeat=3):
        points = [(x * signs[0], y * signs[1], z * signs[2]) for x, y, z in scene.points]
        parts = scene.parts or tuple(range(len(scene.faces)))
        yield Scene(tuple(points), scene.faces, scene.wires, parts)
        last = len(points) - 1  # numbered backward, every edge lo -> hi starts at its other end
        faces = tuple((last - i, last - j, last - k) for i, j, k in scene.faces)
        wires = tuple(sorted((last - j, last - i) for i, j in scene.wires))
        yield Scene(tuple(points[::-1]), faces, wires, parts)


@pytest.mark.parametrize("name", CORPUS)
def test_corpus(name: str) -> None:
    for scene in mirrored(CORPUS[name]):
        for way in (adapter.ONE, adapter.PARTS, replace(adapter.PARTS, bias=1)):
            assert compare.difference(scene, way) is None, (scene, way)
