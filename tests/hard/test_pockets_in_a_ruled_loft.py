"""A frustum lofted from rectangle to rectangle, with two pockets in a side.

The sides are flat, but written as B-spline surfaces that grow narrower: corners in one line in space do not lie in one
line of their parameters. So the mesh had needles along the pockets, and where rounding turned one over, the edge beside
it was hidden.
"""

from __future__ import annotations

import math

import cadquery as cq
import pytest

import hlr
from support.at_size import AT_SIZE
from support.free_form import lengths

POCKETS = [((3.286, -12.176, 8), 10.41), ((-0.838, -10.208, 17), 7.465), ((-15.453, -3.263, 26), 9.877)]


def frustum() -> cq.Shape:
    found = cq.Workplane().rect(40, 30).workplane(offset=30).rect(11.713, 16.631).loft(ruled=True)
    for place, height in POCKETS:
        found = found.cut(cq.Workplane().box(6, 6, height).translate(place))
    shape = found.val()
    assert isinstance(shape, cq.Shape)
    return shape


def seen(turn: float) -> dict[tuple[str, bool], float]:
    """The lengths of its lines, from the same side, if it is turned about its axis by this angle in degrees."""
    cos, sin = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    view = (0.5 * cos + sin, 0.5 * sin - cos, 0.8)
    return lengths(hlr.draw(frustum().rotate((0, 0, 0), (0, 0, 1), turn), view, **{**AT_SIZE, "scale": 2.0}))


@pytest.mark.parametrize("turn", [0.0, 5.0, 37.0, 90.0, 133.0, 210.0])
def test_the_edges_of_the_pockets_are_seen(turn: float) -> None:
    found = seen(turn)
    # As OpenCASCADE's exact algorithm has it.
    assert found["sharp", True] == pytest.approx(547.8407, abs=0.001)
    assert found["sharp", False] == pytest.approx(251.745, abs=0.2)
