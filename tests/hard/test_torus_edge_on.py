"""A torus seen in its own plane: its outline has four cusps' worth of turning and half of it lies inside the ring.

The inner halves of the two end circles are hidden by the ring before them, and the far halves of the upper and lower
circle lie exactly behind the near ones.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import arc, kinds, like, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

MAJOR, MINOR = 20.0, 5.0


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0, 1e-9, 17, 45, 90])
def test_a_stadium_and_two_hidden_half_circles(degrees, picture):
    """Turned about its axis too: the seams lie elsewhere, the drawing is the same."""
    view = turn((0, -1, 0), (0, 0, 1), degrees)
    side = turn((1, 0, 0), (0, 0, 1), degrees)
    drawing = hlr.draw(cq.Solid.makeTorus(MAJOR, MINOR), view, **AT_SIZE)
    seen, unseen = [], []
    for s in (1, -1):
        centre, u = [s * MAJOR * c for c in side], [s * MINOR * c for c in side]
        seen += arc(centre, u, (0, 0, MINOR), -90, 90)
        unseen += arc(centre, u, (0, 0, MINOR), 90, 270)
        seen.append(
            (
                tuple(-MAJOR * c + s * MINOR * z for c, z in zip(side, (0, 0, 1), strict=True)),
                tuple(MAJOR * c + s * MINOR * z for c, z in zip(side, (0, 0, 1), strict=True)),
            )
        )
    like(drawing, expect(drawing, seen, unseen))
    assert kinds(drawing) == {("outline", True), ("outline", False)}
    if degrees == 0:
        picture(drawing)


def test_along_its_axis_two_circles():
    drawing = hlr.draw(cq.Solid.makeTorus(MAJOR, MINOR), "top", **AT_SIZE)
    circles = [piece for r in (MAJOR - MINOR, MAJOR + MINOR) for piece in arc((0, 0, 0), (r, 0, 0), (0, r, 0))]
    like(drawing, expect(drawing, circles))
