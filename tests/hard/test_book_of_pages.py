"""A book: n pages on one spine, an edge of n faces.

A half-edge structure holds two faces per edge and drops or refuses the rest; the spine is a contour as often as pages
lie to one side of it more than to the other.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, defects
from support.meshes import face, merged, turned_over


def book(count, opening=2 * np.pi, turned=False):
    """Pages as a fan of `opening` about the z axis; with `turned` every second one is turned over."""
    angles = np.arange(count) * (opening / count) + 0.1
    pages = [
        face((0, 0, 0), (15 * np.cos(t), 15 * np.sin(t), 0), (15 * np.cos(t), 15 * np.sin(t), 20), (0, 0, 20))
        for t in angles
    ]
    return merged(*(turned_over(p) if turned and k % 2 else p for k, p in enumerate(pages)))


@pytest.mark.slow
@pytest.mark.parametrize("count", [1, 2, 3, 4, 7, 16])
@pytest.mark.parametrize("view", ["iso", (1, 0.2, 0), (-1, 0.5, -2), "top"])
@pytest.mark.parametrize("turned", [False, True])
def test_each_page_hides_those_behind_it(picture, count, view, turned):
    points, triangles = book(count, np.pi if count in (2, 7) else 2 * np.pi, turned)
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    sides = [(4 * k + i, 4 * k + (i + 1) % 4) for k in range(count) for i in range(4)]
    agrees(drawing, by_oracle(drawing, points, triangles, sides), step=0.3)
    if count == 7 and view == "iso":
        picture(drawing)


@pytest.mark.parametrize("count", [1, 2, 3, 16])
def test_the_spine_is_reported(count):
    found = defects(book(count, np.pi))
    assert "border" in found[0] and str({1: 4}.get(count, 3 * count)) in found[0]
    crowded = [text for text in found if "non-manifold" in text]
    assert len(crowded) == (count > 2)
    assert all("1 " in text for text in crowded)
