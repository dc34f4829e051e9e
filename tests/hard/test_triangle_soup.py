"""A hundred triangles anywhere, unconnected, through one another: no side is inside, no edge has a neighbour.

Every edge is a border, and visibility changes in the middle of edges wherever one pierces a triangle. The exact
rational oracle decides each edge against all hundred triangles, and rays each sample.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import by_oracle, defects, ink, wrong_by_rays
from support.referee import reference

SOUP = Path(__file__).parents[1] / "data" / "soup.stl"


@pytest.mark.slow
@pytest.mark.parametrize("view", ["front", "iso", (0.36, 0.86, 0.35)])
def test_each_edge_by_the_oracle(view):
    """How much is seen: where an edge pierces a triangle at a small angle, contact tolerance moves the place."""
    model = reference.from_mesh_file(SOUP)
    drawing = hlr.draw((model.points, model.triangles), view, accuracy=model.accuracy, **AT_SIZE)
    edges = [(int(t[i]), int(t[i - 1])) for t in model.triangles for i in range(3)]
    right = by_oracle(drawing, model.points, model.triangles, edges).lengths()
    drawn = ink(drawing, ["intersection"]).lengths()
    assert drawn[0] == pytest.approx(right[0], rel=0.01)
    # Of the hidden ones some lie under visible ink or along one another, and are not drawn.
    assert 0.9 * right[1] < drawn[1] < right[1]
    judged, wrong = wrong_by_rays(drawing, model.points, model.triangles)
    assert judged > 1000 and not wrong


@pytest.mark.slow
def test_picture(picture):
    drawing = hlr.draw(SOUP, "iso", fit=(60, 60), hidden=False, accuracy=0.1, smooth=False, details=True)
    picture(drawing, twice=1.0)


def test_the_defect_is_named():
    assert "open: 300 border edges" in defects(SOUP)
