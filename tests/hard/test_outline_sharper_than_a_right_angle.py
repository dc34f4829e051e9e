"""The rim of a cone as a mesh, with a crease angle beyond its fold: it is the cone's outline from above and from below.

Edges that fold by more than a right angle were kept out of the outlines, as slivers of a B-rep mesh have to be that lie
on top of one another. Nothing of a cone was drawn.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import AT_SIZE

RADIUS = 10.0


def cone(height: float) -> tuple[np.ndarray, np.ndarray]:
    mesh = trimesh.creation.cone(RADIUS, height, sections=48)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)


@pytest.mark.parametrize("view", ["top", "bottom", (0.0, 0.05, 1.0)])
@pytest.mark.parametrize(("height", "crease"), [(5.0, 179.0), (20.0, 130.0), (40.0, 120.0)])
def test_the_rim_is_an_outline(height: float, crease: float, view: object) -> None:
    drawing = hlr.draw(cone(height), view, crease=crease, **AT_SIZE)
    (line,) = drawing.visible
    assert line.kind == "outline" and not drawing.notes
    (rim,) = hlr.draw(cone(height), view, **AT_SIZE).visible
    assert np.ptp(line.points, axis=0) == pytest.approx(np.ptp(rim.points, axis=0), abs=0.05)
    assert np.ptp(line.points3[:, 2]) == pytest.approx(0.0, abs=1e-6)


def test_a_cone_from_the_side_is_closed_by_its_rim() -> None:
    drawing = hlr.draw(cone(40.0), (0.0, 1.0, 0.6), crease=179.0, **AT_SIZE)
    low, high = (f([f(line.points, axis=0) for line in drawing.visible], axis=0) for f in (np.min, np.max))
    other = hlr.draw(cone(40.0), (0.0, 1.0, 0.6), **AT_SIZE)
    wanted = [f([f(line.points, axis=0) for line in other.visible], axis=0) for f in (np.min, np.max)]
    assert high - low == pytest.approx(wanted[1] - wanted[0], abs=0.05)


def test_picture(picture):
    picture(hlr.draw(cone(20.0), (0.0, 0.3, 1.0), crease=130.0, **AT_SIZE))
