"""The same solid twice at one place, as copies in an assembly and as one shape used twice: drawn like one.

Equal depths everywhere: with the wrong rule for ties each hides the other, or every line is there twice.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, compound, like, once, same
from hard.expected import expect

import hlr


def part():
    return cq.Workplane().box(30, 20, 10).faces(">Z").workplane().hole(8).edges("|Z").fillet(3).val()


def in_an_assembly():
    assembly = cq.Assembly()
    assembly.add(part(), name="one").add(part(), name="other")
    return assembly


def one_shape_twice():
    shape = part()
    return compound(shape, shape)


def built_twice():
    return compound(part(), part())


def turned_over():
    """The other one upside down: the same solid, its faces numbered and meshed differently."""
    return compound(part(), part().rotate((0, 0, 0), (1, 0, 0), 180))


@pytest.mark.parametrize("view", ["iso", "front", (0.3, -1, -0.4)])
def test_a_box_three_times_is_twelve_edges(view):
    box = cq.Solid.makeBox(30, 20, 10)
    drawing = hlr.draw(compound(box, box.copy(), box.rotate((15, 10, 5), (15, 10, 6), 180)), view)
    like(drawing, expect(drawing, *box_edges((0, 0, 0), (30, 20, 10), drawing.view.direction)))


@pytest.mark.parametrize("view", ["iso", "front", (0.3, -1, -0.4)])
@pytest.mark.parametrize("model", [in_an_assembly, one_shape_twice, built_twice, turned_over])
def test_it_is_drawn_like_one(model, view, picture):
    drawing = hlr.draw(model(), view)
    same(hlr.draw(part(), view), drawing)
    once(drawing)
    if view == "iso" and model is built_twice:
        picture(drawing, twice=1.0)
