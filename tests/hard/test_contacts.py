"""Solids that touch: vertex on vertex, vertex on edge, vertex on face, edge on edge, edge on face, face on face.

Each contact is a tie that must be decided the same way by every test; as one mesh, corners that coincide are joined and
edges get more than two faces.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle
from support.meshes import BOX_EDGES, as_parts, box, merged, moved, rotation

BASE = box((-10, -10, -10), (10, 10, 0))
ON_EDGE = rotation((1, 0, 0), np.pi / 4)
ON_CORNER = rotation((1, -1, 0), np.arccos(1 / np.sqrt(3)))


def standing(turn, at, size=8.0):
    """A cube turned about its corner (0, 0, 0) and moved there."""
    return moved(box((0, 0, 0), (size, size, size)), lambda p: p @ turn.T + np.asarray(at, float))


CONTACTS = {
    "corner-on-face": standing(ON_CORNER, (1, 2, 0)),
    "corner-on-edge": standing(ON_CORNER, (10, -3, 0)),
    "corner-on-corner": standing(ON_CORNER, (10, -10, 0)),
    "edge-on-face": standing(ON_EDGE, (-4, 0, 0)),
    "edge-on-edge": standing(ON_EDGE, (-4, -10, 0)),
    "edge-across-edge": moved(standing(ON_EDGE, (0, 0, 0)), lambda p: p @ rotation((0, 0, 1), 0.5).T + [6, -10, 0]),
    "edge-on-edge-longer": standing(ON_EDGE, (-14, -10, 0), 28.0),
    "face-on-face": box((-5, -4, 0), (3, 6, 7)),
    "face-on-half-a-face": box((-5, -16, 0), (5, -4, 7)),
    "whole-face": box((-10, -10, 0), (10, 10, 7)),
    "side-by-side": box((10, -10, -10), (18, 10, 0)),
    "half-side-by-side": box((10, -4, -6), (18, 16, 4)),
    "along-an-edge": box((10, -10, 0), (18, 10, 7)),
    "along-half-an-edge": box((10, -4, 0), (18, 16, 7)),
    "at-a-corner": box((10, 10, 0), (16, 16, 7)),
}
VIEWS = ["iso", (2, -1, 0.5), (-1, -3, -1), "front", "top"]
EDGES = [*BOX_EDGES, *((i + 8, j + 8) for i, j in BOX_EDGES)]


@pytest.mark.slow
@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("name", CONTACTS)
def test_what_touches_hides_only_what_is_behind(picture, how, view, name):
    model = how(BASE, CONTACTS[name])
    drawing = hlr.draw(model, view, **AT_SIZE)
    agrees(drawing, by_oracle(drawing, *merged(BASE, CONTACTS[name]), EDGES), step=0.3)
    if view == "iso" and name in ("corner-on-edge", "half-side-by-side"):
        picture(drawing, name)
