"""Two boxes of an assembly run into one another: edges end in the middle of faces, by numbers known exactly.

Where an edge pierces a face no contour passes; a program that changes visibility only at contours leaks the rest of
the edge (CadQuery's and FreeCAD's exact mode do).
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import like

import hlr
from support.at_size import AT_SIZE
from support.expected import expect, of_kind

VIEW = (1, -2, 1.5)
"""From before, right and above."""
BASE = ((0, 0, 0), (30, 20, 10))
BLOCK = ((10, -5, 4), (18, 12, 24))
"""Stands in the base with its foot, and comes out of its front."""


def model():
    assembly = cq.Assembly()
    for name, (low, high) in (("base", BASE), ("block", BLOCK)):
        size = [b - a for a, b in zip(low, high, strict=True)]
        assembly.add(cq.Workplane(obj=cq.Solid.makeBox(*size, cq.Vector(*low))), name=name)
    return assembly


ON_PAPER_FRONT = {
    # Seen from the front, y does not matter: the block, nearest, is whole; the base is cut where it is behind it.
    "seen": [
        ((10, 4), (18, 4)), ((18, 4), (18, 24)), ((18, 24), (10, 24)), ((10, 24), (10, 4)),
        ((0, 0), (30, 0)), ((30, 0), (30, 10)), ((30, 10), (18, 10)), ((10, 10), (0, 10)), ((0, 10), (0, 0)),
    ],
    "unseen": [((10, 10), (18, 10))],
}  # fmt: skip


def test_from_the_front(picture):
    drawing = hlr.draw(model(), "front", **AT_SIZE)
    seen, unseen = ([((a, 0, b), (c, 0, d)) for (a, b), (c, d) in ON_PAPER_FRONT[k]] for k in ("seen", "unseen"))
    like(drawing, expect(drawing, seen, unseen), without=["intersection"])
    picture(drawing, "front")


def test_from_the_top():
    """The upright edges are points; the block's foot is inside the base; its front sticks out over it."""
    drawing = hlr.draw(model(), "top", **AT_SIZE)
    seen = [((0, 0, 10), (10, 0, 10)), ((18, 0, 10), (30, 0, 10)), ((30, 0, 10), (30, 20, 10))]
    seen += [((30, 20, 10), (0, 20, 10)), ((0, 20, 10), (0, 0, 10))]
    seen += [((10, -5, 24), (18, -5, 24)), ((18, -5, 24), (18, 12, 24)), ((18, 12, 24), (10, 12, 24))]
    seen += [((10, 12, 24), (10, -5, 24))]
    like(drawing, expect(drawing, seen, [((10, 0, 10), (18, 0, 10))]), without=["intersection"])


def test_edges_end_where_they_pierce():
    """The lower edge of the block's right side runs back into the base's front and is hidden from there."""
    drawing = hlr.draw(model(), VIEW, **AT_SIZE)
    found = [
        line
        for line in drawing.lines
        if line.kind == "sharp" and {tuple(p) for p in line.points3[:, [0, 2]].round(6).tolist()} == {(18.0, 4.0)}
    ]
    ends = {line.visible: sorted(line.points3[[0, -1], 1].tolist()) for line in found}
    assert ends[True] == pytest.approx([-5, 0], abs=0.01)
    assert ends[False] == pytest.approx([0, 12], abs=0.01)


def test_the_lines_of_intersection_are_drawn():
    drawing = hlr.draw(model(), VIEW, **AT_SIZE)
    whole = [((10, 0, 4), (18, 0, 4)), ((18, 0, 4), (18, 0, 10)), ((10, 0, 4), (10, 0, 10))]
    whole += [((18, 0, 10), (18, 12, 10)), ((10, 0, 10), (10, 12, 10)), ((10, 12, 10), (18, 12, 10))]
    length = sum(abs(a[0] - b[0]) + abs(a[1] - b[1]) + abs(a[2] - b[2]) for a, b in whole)
    found = of_kind(drawing, "intersection")
    assert sum(abs(line.points3[1:] - line.points3[:-1]).sum() for line in found) == pytest.approx(length, rel=0.1)
    seen = [line for line in found if line.visible]
    # On the right, from the base's front up and back: (18, 0, 4) to (18, 0, 10) to (18, 12, 10).
    assert sum(abs(line.points3[1:] - line.points3[:-1]).sum() for line in seen) == pytest.approx(18, abs=0.2)
