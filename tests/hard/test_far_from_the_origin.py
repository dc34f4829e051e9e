"""A part of one millimetre, a kilometre from the origin, as a B-rep: the digits that tell its shape are the last ones.

Single precision fails at once there; tolerances taken from the size of coordinates swallow the part.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, like, once, ring, same

import hlr
from support.at_size import ALL_LINES, AT_SIZE
from support.expected import expect

FAR = (1e6, -1e6, 5e5)


def part():
    return cq.Workplane().box(1, 1, 0.5).faces(">Z").workplane().hole(0.4)


@pytest.mark.slow
@pytest.mark.parametrize("view", ["front", "top", "iso", (1, -2, 0.7)])
@pytest.mark.parametrize("place", [FAR, (1e6, 1e6, 1e6), (0, 0, -3e6)])
def test_the_same_drawing_as_at_the_origin(view, place):
    near = hlr.draw(part(), view, scale=20, **ALL_LINES)
    far = hlr.draw(part().translate(place), view, scale=20, **ALL_LINES)
    moved = cq.Workplane(obj=part().val().located(cq.Location(place)))
    for drawing in (far, hlr.draw(moved, view, scale=20, **ALL_LINES)):
        # Each is held against its own lower left corner: where the paper is far away, its digits are rounded.
        assert drawing.bounds == pytest.approx(near.bounds, abs=0.01)
        assert sorted((line.kind, line.visible) for line in drawing.lines) == sorted(
            (line.kind, line.visible) for line in near.lines
        )
        once(drawing)


def test_by_hand(picture):
    x, y, z = FAR
    drawing = hlr.draw(part().translate(FAR), "iso", scale=20, **ALL_LINES)
    direction = drawing.view.direction
    seen, unseen = box_edges((x - 0.5, y - 0.5, z - 0.25), (x + 0.5, y + 0.5, z + 0.25), direction)
    upper = [tuple((p[0] + x, p[1] + y, p[2] + z) for p in e) for e in ring(0.2, 0.25)]
    drawn = [line for line in drawing.lines if line.visible]
    like(drawing, expect(drawing, seen + upper, unseen), either=hole(FAR), ends=0.02)
    assert drawn
    picture(drawing)


def hole(place):
    """Its lower rim and its two generators: which of them are seen is not the question here."""
    pieces = ring(0.2, -0.25)
    s = 0.2 / 2**0.5
    pieces += [((k * s, k * s, -0.25), (k * s, k * s, 0.25)) for k in (1, -1)]
    return [tuple(tuple(c + d for c, d in zip(p, place, strict=True)) for p in e) for e in pieces]


def test_two_of_them_far_apart_keep_their_shape():
    """A drawing of two such parts two metres apart at an accuracy that still resolves them."""
    pair = cq.Compound.makeCompound([part().val(), part().translate((2000, 0, 0)).val()])
    drawing = hlr.draw(pair, "front", accuracy=0.01, **AT_SIZE)
    widths = []
    for low, high in ((-1, 1), (1999, 2001)):
        xs = [x for line in drawing.lines for x in line.points3[:, 0] if low < x < high]
        widths.append(max(xs) - min(xs))
    assert widths == pytest.approx([1, 1], abs=0.02)
    same(drawing, drawing)
