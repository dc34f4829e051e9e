"""The same solid twice at one place: in an assembly, as one shape used twice, within one part: drawn like one.

Equal depths everywhere: with the wrong rule for ties each hides the other, or every line is there twice.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, compound, like, once, same
from OCP.BRep import BRep_Builder
from OCP.TopoDS import TopoDS_Solid

import hlr
from support.at_size import AT_SIZE
from support.expected import expect


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


def faces_of_both():
    """Loose faces, as a file of surfaces has them: one part in which every face is there twice, with its own edges."""
    return compound(*part().Faces(), *part().Faces())


def shells_of_both():
    solid, builder = TopoDS_Solid(), BRep_Builder()
    builder.MakeSolid(solid)
    for shell in (*part().Shells(), *part().Shells()):
        builder.Add(solid, shell.wrapped)
    return cq.Solid(solid)


MODELS = [in_an_assembly, one_shape_twice, built_twice, turned_over, faces_of_both, shells_of_both]


@pytest.mark.parametrize("view", ["iso", "front", (0.3, -1, -0.4)])
def test_a_box_three_times_is_twelve_edges(view):
    box = cq.Solid.makeBox(30, 20, 10)
    drawing = hlr.draw(compound(box, box.copy(), box.rotate((15, 10, 5), (15, 10, 6), 180)), view, **AT_SIZE)
    like(drawing, expect(drawing, *box_edges((0, 0, 0), (30, 20, 10), drawing.view.direction)))


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", "front", (0.3, -1, -0.4)])
@pytest.mark.parametrize(
    "model", [in_an_assembly, one_shape_twice, built_twice, turned_over, faces_of_both, shells_of_both]
)
def test_it_is_drawn_like_one(model, view, picture):
    drawing = hlr.draw(model(), view, **AT_SIZE)
    same(hlr.draw(part(), view, **AT_SIZE), drawing)
    once(drawing)
    if view == "iso" and model is built_twice:
        picture(drawing, twice=1.0)


@pytest.mark.parametrize("model", [faces_of_both, shells_of_both])
def test_within_one_part_it_is_said(model):
    (one,) = hlr.info(part()).parts
    (found,) = hlr.info(model()).parts
    # Faces outside a solid may touch anything: they are meshed more finely.
    assert found.triangles >= one.triangles and found.closed
    assert found.defects == (f"{found.triangles} duplicated triangles",)
    (note,) = hlr.draw(model(), **AT_SIZE).notes
    assert note.text.endswith("duplicated triangles.")


def test_one_face_too_many():
    extra = part().faces(">Z").copy()
    (found,) = hlr.info(compound(*part().Faces(), extra)).parts
    assert found.closed and len(found.defects) == 1 and "duplicated" in found.defects[0]


def test_bodies_that_touch_with_equal_faces_keep_both():
    box = cq.Solid.makeBox(10, 10, 10)
    both = compound(*box.Faces(), *box.moved(cq.Location((0, 0, 10))).Faces())
    (found,) = hlr.info(both).parts
    assert (found.triangles, found.closed, found.defects) == (24, True, ())
