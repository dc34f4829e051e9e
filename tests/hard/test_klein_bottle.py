"""A Klein bottle: closed, without border, without an inside, and it passes through itself.

Closed by every count of edges, yet "the side turned away" does not exist; no edge lies where it passes through itself.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import defects, of_kind, wrong_by_rays
from support.meshes import cells


def bottle(n=160, m=64):
    """The figure-of-eight immersion: an eight turned by half a turn on its way round."""
    u, v = np.meshgrid(np.arange(n) * (2 * np.pi / n), np.arange(m) * (2 * np.pi / m), indexing="ij")
    across = 7 * np.cos(u / 2) * np.sin(v) - 7 * np.sin(u / 2) * np.sin(2 * v)
    up = 7 * np.sin(u / 2) * np.sin(v) + 7 * np.cos(u / 2) * np.sin(2 * v)
    points = np.stack([(15 + across) * np.cos(u), (15 + across) * np.sin(u), up], axis=-1).reshape(-1, 3)
    number = np.arange(n * m).reshape(n, m)
    # After one round v becomes -v.
    number = np.concatenate([number, number[:1, (-np.arange(m)) % m]])
    number = np.concatenate([number, number[:, :1]], axis=1)
    return points, cells(number)


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", "front", (1, 2, 3), (1, 1, 0.1)])
def test_rays_agree(picture, view):
    points, triangles = bottle()
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    judged, wrong = wrong_by_rays(drawing, points, triangles)
    assert judged >= 25
    assert wrong <= judged // 100
    assert of_kind(drawing, "boundary") == []
    if view == "iso":
        picture(drawing, twice=20.0)


def test_what_is_reported():
    # No border, but no orientation either: along the seam neighbours face opposite ways.
    found = defects(bottle())
    assert not any("open" in text for text in found)
    assert any("opposite orientation" in text for text in found)


def test_a_sound_tube_of_the_same_make_has_no_such_defect():
    from support.meshes import torus

    assert defects(torus(15, 5, 40, 20)) == []
