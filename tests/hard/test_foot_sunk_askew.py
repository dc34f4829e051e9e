"""A post stands askew in its plate, both of meshes: one side of its foot is sunk by little, the opposite side deep.

The sides of the foot meet the plate in one figure. Because that is deep somewhere, it counted as deep everywhere, and
beside the edge that is sunk by little there were two lines. Seen in an engine and in a gear of which each is one mesh.
"""

from __future__ import annotations

from typing import Any

import cadquery as cq
import numpy as np
import pytest
from hard.test_edge_beside_an_intersection_line import MOST_MISSED, VIEWS, drawn, missed, visible_segments

from support.meshes import as_parts
from support.side_by_side import side_by_side

ACCURACY = 0.05
DEPTHS = [1.2, 1.6, 2.0, 2.4]
"""Accuracies: of the side that is sunk by little."""
MORE = 200.0
"""Accuracies: how much deeper the opposite side is."""
MOST_BESIDE = 3.0
"""Millimetres, of 40: at each corner of that side, edge and line part along the two sides that go down from it."""
ALL_AROUND = [*VIEWS, "back", (-1, 2, 0.3), (-2, 1, 1.2), (-1, -1, 3)]


def post_on_a_plate(least: float, most: float) -> Any:
    """The foot is sunk by the least depth at x = -15, by the most at x = 15."""
    plate = cq.Workplane().box(120, 120, 40).translate((0, 0, -20))
    side = cq.Workplane("XZ").polyline([(-15, -least), (15, -most), (15, 50), (-15, 50)]).close()
    meshes = [body.val().tessellate(0.01, 0.1) for body in (plate, side.extrude(20, both=True))]
    return as_parts(*((np.array([p.toTuple() for p in points]), np.array(faces)) for points, faces in meshes))


def askew(depths: float) -> Any:
    return post_on_a_plate(depths * ACCURACY, (depths + MORE) * ACCURACY)


@pytest.mark.parametrize("depths", DEPTHS)
def test_no_line_runs_beside_the_edge_that_is_sunk_by_little(depths: float) -> None:
    shape = askew(depths)
    assert max(side_by_side(drawn(shape, view)) for view in ALL_AROUND) < MOST_BESIDE


@pytest.mark.parametrize("depths", DEPTHS)
def test_a_line_is_seen_all_around_the_foot(depths: float) -> None:
    shape, deep = askew(depths), post_on_a_plate(MORE * ACCURACY, MORE * ACCURACY)
    wanted = {view: visible_segments(drawn(deep, view), {"intersection"}) for view in ALL_AROUND}
    assert sum(len(segments) > 0 for segments in wanted.values()) >= 6
    for view, segments in wanted.items():
        if len(segments):
            assert missed(segments, visible_segments(drawn(shape, view))) <= MOST_MISSED, view


def test_picture(picture) -> None:
    picture(drawn(askew(1.6), (-2, 1, 1.2)))
