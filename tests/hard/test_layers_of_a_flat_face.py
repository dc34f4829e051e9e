r"""A flat face that an exporter lists in layers: from both sides, and again along other diagonals.

::

      ___________        ___________
     |  /|  /|  /|      |\  |\  |\  |        Four triangles meet at each line between two strips, or eight: no
     | / | / | / |  and | \ | \ | \ |        crease, as long as the face goes on.
     |/__|/__|/__|      |__\|__\|__\|
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import AT_SIZE

STRIPS = 5


def strips(fold: float, layers: int = 2, both_sides: bool = True, last: int = STRIPS) -> trimesh.Trimesh:
    """Strips of 10 x 40 mm, folded by so many degrees between the second and the third.

    last: strips of the second layer.
    """
    way = np.radians([0.0, 0.0, *[fold] * (STRIPS - 2)])
    x, z = (np.concatenate([[0.0], 10 * np.cumsum(part(way))]) for part in (np.cos, np.sin))
    points = np.array([[x[k], y, z[k]] for k in range(STRIPS + 1) for y in (0.0, 40.0)])
    triangles: list[tuple[int, int, int]] = []
    for k in range(STRIPS):
        a, b, c, d = 2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1
        triangles += [(a, b, c), (a, c, d)]
        triangles += [(a, b, d), (b, c, d)] if layers == 2 and k < last else []
    if both_sides:
        triangles += [(a, c, b) for a, b, c in triangles]
    return trimesh.Trimesh(points, triangles, process=False)


def ink(mesh: trimesh.Trimesh, view: str) -> tuple[float, float]:
    """Length of visible and of hidden lines, mm."""
    lines = hlr.draw(mesh, view=view, **AT_SIZE).lines
    visible, hidden = (sum(line.length_mm for line in lines if line.visible is seen) for seen in (True, False))
    return visible, hidden


@pytest.mark.parametrize("view", ["iso", "top", "bottom", "left", "front"])
@pytest.mark.parametrize("fold", [0.0, 40.0, -40.0])
@pytest.mark.parametrize("both_sides", [True, False])
@pytest.mark.parametrize("last", [STRIPS, 3])
def test_layers_give_the_lines_of_one(view: str, fold: float, both_sides: bool, last: int) -> None:
    found = ink(strips(fold, 2, both_sides, last), view)
    assert found == pytest.approx(ink(strips(fold, 1, both_sides=False), view), abs=0.05)


@pytest.mark.parametrize("last", [STRIPS, 3])
def test_a_face_of_layers_has_lines_at_its_border_alone(last: int) -> None:
    assert ink(strips(0.0, last=last), "top") == pytest.approx((180.0, 0.0), abs=0.05)
    assert ink(strips(40.0, last=last), "top") == pytest.approx(
        (80.0 + 40.0 + 40.0 + 60.0 * np.cos(np.radians(40.0)), 0.0), abs=0.05
    )
