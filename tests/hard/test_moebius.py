"""A Moebius strip: one side, one border, no orientation; somewhere neighbours must face opposite ways.

Whatever asks "is this face turned away?" gets both answers along the same surface: culling and outlines from face
orientation are wrong on one half of it.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import defects, expect, of_kind, wrong_by_rays
from support.measures import length
from support.meshes import cells

RADIUS, WIDTH, TWISTS = 15.0, 12.0, 1


def strip(n=240, m=9, twists=TWISTS):
    """n steps around, m corners across; the last row is the first one, reversed where twists are odd."""
    u, w = np.meshgrid(np.arange(n) * (2 * np.pi / n), np.linspace(-WIDTH / 2, WIDTH / 2, m), indexing="ij")
    r = RADIUS + w * np.cos(twists * u / 2)
    points = np.stack([r * np.cos(u), r * np.sin(u), w * np.sin(twists * u / 2)], axis=-1).reshape(-1, 3)
    number = np.arange(n * m).reshape(n, m)
    number = np.concatenate([number, number[:1, :: -1 if twists % 2 else 1]])
    return points, cells(number)


@pytest.mark.slow
@pytest.mark.parametrize("twists", [0, 1, 2, 3])
@pytest.mark.parametrize("view", ["iso", "front", (1, 3, -1)])
def test_rays_agree_and_the_border_is_all_there(picture, twists, view):
    points, triangles = strip(twists=twists)
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    judged, wrong = wrong_by_rays(drawing, points, triangles)
    assert judged >= 5
    assert wrong == 0
    u = np.linspace(0, 2 * np.pi, 241)
    border = []
    for w in (-WIDTH / 2, WIDTH / 2):
        r = RADIUS + w * np.cos(twists * u / 2)
        walk = np.stack([r * np.cos(u), r * np.sin(u), w * np.sin(twists * u / 2)], axis=1)
        border += list(pairwise(walk))
    wanted = expect(drawing, border).lengths()[0]
    drawn = sum(map(length, of_kind(drawing, "boundary")))
    # Where an outline or another part of the border lies on it, it is drawn as that.
    assert 0.9 * wanted <= drawn <= 1.001 * wanted or view == "front"
    if twists == 1 and view == "iso":
        picture(drawing, twice=2.0)


@pytest.mark.parametrize("twists", [0, 1, 2, 3])
def test_its_one_side_is_reported(twists):
    found = defects(strip(twists=twists))
    assert "480 border edges" in found[0]
    assert any("opposite orientation" in text for text in found) == (twists % 2 == 1)


def test_turned_over_it_is_the_same():
    points, triangles = strip()
    one, other = (
        hlr.draw((points, triangles), "iso", **AT_SIZE),
        hlr.draw((points, triangles[:, ::-1]), "iso", **AT_SIZE),
    )
    total = [sum(length(x) for x in d.lines if x.visible) for d in (one, other)]
    assert total[0] == pytest.approx(total[1], rel=1e-3)
