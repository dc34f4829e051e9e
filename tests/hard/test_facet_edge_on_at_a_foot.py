"""A mesh of a block with rounded corners on a flange: in the isometric view one facet of a corner is seen edge-on.

Facets fold by less than the crease angle, so only outlines are drawn there. Rounding turns the facet a hair toward the
viewer or away. Its border is an outline in either case: beside it lies the foot of the block, far behind its wall.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hard.brep import same

import hlr
from hlr.drawing.saving import render
from support.at_size import AT_SIZE
from support.models import turned
from support.referee import exchange, referee, reference

FACETS = 5
"""Of a corner: 18 degrees from one to the next."""
TILTS = [0.0, 1e-6, -1e-6]
"""Radians about the vertical axis."""
RINGS = [
    (25.0, 0.0),
    (25.0, 10.0),
    *[(5.0 * (1 - np.sin(t)), 10.0 + 5.0 * (1 - np.cos(t))) for t in np.radians(range(0, 91, 18))],
    (0.0, 40.0),
]
"""Outward from the block's wall, and height."""


def ring(out: float, z: float) -> list[tuple[float, float, float]]:
    corners = [(40, 30), (-40, 30), (-40, -30), (40, -30)]
    angles = [np.radians(90 * k + 90 / FACETS * i) for k in range(4) for i in range(FACETS + 1)]
    centres = np.repeat(corners, FACETS + 1, axis=0)
    return [
        (x + (out + 15) * np.cos(t), y + (out + 15) * np.sin(t), z) for (x, y), t in zip(centres, angles, strict=True)
    ]


def block(tilt: float, lid: bool = True) -> trimesh.Trimesh:
    n = 4 * (FACETS + 1)
    points = np.array([ring(*each) for each in RINGS]).reshape(-1, 3)
    c, s = np.cos(tilt), np.sin(tilt)
    points = np.stack([c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1], points[:, 2]], axis=1)
    faces = []
    for k in range(len(RINGS) - 1):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            faces += [(a, b, b + n), (a, b + n, a + n)]
    top = (len(RINGS) - 1) * n
    faces += [(top, top + i, top + i + 1) for i in range(1, n - 1)]
    if lid:
        faces += [(0, i + 1, i) for i in range(1, n - 1)]
    return trimesh.Trimesh(points, faces, process=False)


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", "iso-sw", "iso-ne", "iso-nw", "front"])
@pytest.mark.parametrize("tilt", TILTS)
def test_its_outline_is_whole(tilt, view):
    mesh = block(tilt)
    model = reference.from_arrays(mesh.vertices, mesh.faces)
    drawing = hlr.draw(mesh, view, accuracy=model.diagonal / 20000, **AT_SIZE)
    judged = referee.Referee(model).judge("block", "hlr", exchange.parse(render(drawing, "json")))
    assert not judged.row.bad, [str(judged.row), *judged.why()]


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", "iso-sw", (1, 2, 3)])
@pytest.mark.parametrize("lid", [True, False])
@pytest.mark.parametrize("tilt", TILTS)
def test_inside_out_it_is_drawn_the_same(tilt, lid, view):
    mesh = block(tilt, lid)
    same(hlr.draw(mesh, view, **AT_SIZE), hlr.draw(turned(mesh), view, **AT_SIZE))


def test_picture(picture):
    picture(hlr.draw(block(1e-6), "iso", **AT_SIZE), twice=1.0)
