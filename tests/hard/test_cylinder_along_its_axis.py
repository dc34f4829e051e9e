"""Pipes seen along their axes: whole walls are edge-on, and every rim lies upon rims further back.

OpenCASCADE's exact algorithm hardly comes to an end on a pipe with hollow branches seen along a branch (OCCT#1276).
Here every line is known: circles, generators at the radius, and nothing else.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import arc, kinds, like, ring, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

HALF, OUTER, INNER = 50.0, 20.0, 18.0
BRANCH, BORE, TOP = 8.0, 6.0, 35.0


def pipe():
    """Along x, with a hollow branch up along z whose bore opens into it."""
    along = cq.Workplane("YZ").workplane(offset=-HALF)
    outside = along.circle(OUTER).extrude(2 * HALF).union(cq.Workplane().circle(BRANCH).extrude(TOP))
    return outside.cut(along.circle(INNER).extrude(2 * HALF)).cut(cq.Workplane().circle(BORE).extrude(TOP))


def test_along_the_branch(picture):
    drawing = hlr.draw(pipe(), "top", **AT_SIZE)
    box = [((-HALF, -y, 0), (HALF, -y, 0)) for y in (OUTER, -OUTER)]
    box += [((x, -OUTER, 0), (x, OUTER, 0)) for x in (HALF, -HALF)]
    inside = [((-HALF, y, 0), (HALF, y, 0)) for y in (INNER, -INNER)]
    like(drawing, expect(drawing, [*box, *ring(BRANCH), *ring(BORE)], inside))
    picture(drawing)


def test_along_the_pipe(picture):
    drawing = hlr.draw(pipe(), "right", **AT_SIZE)
    circles = [piece for r in (OUTER, INNER) for piece in arc((0, 0, 0), (0, r, 0), (0, 0, r))]
    foot, inner_foot = (OUTER**2 - BRANCH**2) ** 0.5, (INNER**2 - BORE**2) ** 0.5
    branch = [((0, y, foot), (0, y, TOP)) for y in (BRANCH, -BRANCH)] + [((0, -BRANCH, TOP), (0, BRANCH, TOP))]
    bore = [((0, y, inner_foot), (0, y, TOP)) for y in (BORE, -BORE)]
    like(drawing, expect(drawing, circles + branch, bore))
    picture(drawing, "pipe")


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0, 1e-9, -1e-7, 1e-5, 2e-4])
@pytest.mark.parametrize("seam", [False, True])
def test_a_cylinder_is_one_circle_on_its_axis_and_hardly_off_it(degrees, seam):
    view = turn((0, 0, 1), (1, 1, 0), degrees)
    drawing = hlr.draw(cq.Workplane().cylinder(40, 10), view, seam=seam, **AT_SIZE)
    like(drawing, expect(drawing, ring(10, 20)))
    # At most a dot of the seam, upon the rim.
    assert kinds(drawing) <= {("sharp", True), ("sharp", False), *([("seam", True)] if seam else [])}
