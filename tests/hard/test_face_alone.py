"""One face and nothing else: no inside, two sides, borders that are seen from both.

Edge-on it is a line. A solid's rule that faces turned away hide nothing would make its back transparent.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import arc, compound, kinds, like, ring, walk

import hlr
from support.at_size import AT_SIZE
from support.expected import expect


def plate():
    """In the plane z = 0, with a hole."""
    return cq.Workplane().rect(40, 20).circle(6).extrude(1).faces("<Z").val()


RIM = walk([(x, y, 0) for x, y in ((-20, -10), (20, -10), (20, 10), (-20, 10), (-20, -10))])


@pytest.mark.parametrize("view", ["top", "bottom", "iso", (1, 2, -0.5)])
def test_its_border_from_both_sides(view, picture):
    drawing = hlr.draw(plate(), view, **AT_SIZE)
    like(drawing, expect(drawing, RIM + ring(6)))
    assert kinds(drawing) == {("boundary", True)}
    if view == "iso":
        picture(drawing)


@pytest.mark.parametrize("view", ["front", "right"])
def test_edge_on_a_line(view):
    drawing = hlr.draw(plate(), view, **AT_SIZE)
    like(drawing, expect(drawing, RIM))


@pytest.mark.parametrize("side", [1, -1])
def test_its_back_hides_too(side):
    """A square behind it, seen through the hole only where the hole is: the hole is larger than half of it."""
    square = cq.Workplane(origin=(12, 0, -3 * side)).rect(6, 6).extrude(1).faces("<Z").val()
    drawing = hlr.draw(compound(plate(), square), (0, 0, side), **AT_SIZE)
    small = walk([(12 + x, y, 0) for x, y in ((-3, -3), (3, -3), (3, 3), (-3, 3), (-3, -3))])
    like(drawing, expect(drawing, RIM + ring(6), small))


def test_half_a_sphere_alone_has_an_outline_inside_and_out():
    """Seen from obliquely below into the bowl: border whole, the outline where the bowl turns away."""
    bowl = cq.Workplane().sphere(10).intersect(cq.Workplane().box(40, 40, 20).translate((0, 0, -10)))
    face = bowl.faces("%SPHERE").val()
    drawing = hlr.draw(face, (0, -1, 1), **AT_SIZE)
    u, v = (10 * np.asarray(axis) for axis in (drawing.view.right, drawing.view.up))
    # The lower half of the great circle across the view bounds the outside; the border is seen whole from above. Both
    # ends of the half circle (curvature 1/10) touch the ellipse (1/5 there), less than a fifth of the accuracy away.
    touch = 2 * np.sqrt(2 * 0.2 * drawing.accuracy.used / (1 / 5 - 1 / 10))
    like(drawing, expect(drawing, ring(10) + arc((0, 0, 0), u, v, 180, 360)), touching=touch)
    assert kinds(drawing) == {("boundary", True), ("outline", True)}
