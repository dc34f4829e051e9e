"""Faces of a B-rep outside all solids may be open, unlike solids and meshes that ought to be closed."""

from __future__ import annotations

import cadquery as cq
import pytest
from OCP.BRep import BRep_Builder
from OCP.TopoDS import TopoDS_Solid

import hlr
from support.at_size import AT_SIZE
from support.expected import defects


def tray():
    """A block with rounded corners without its lid: four arcs and four straight edges bound one face only."""
    block = cq.Workplane().box(30, 20, 10).edges("|Z").fillet(4)
    return cq.Shell.makeShell(sorted(block.faces().vals(), key=lambda face: face.Center().z)[:-1])


def open_solid():
    solid, builder = TopoDS_Solid(), BRep_Builder()
    builder.MakeSolid(solid)
    builder.Add(solid, tray().wrapped)
    return cq.Shape.cast(solid)


def sketch():
    return cq.Sketch().rect(40, 30).vertices().fillet(3).reset().circle(8, mode="s")


def wall():
    return cq.Workplane().circle(10).extrude(20).faces("%CYLINDER").val()


def bowl():
    block = cq.Workplane("XY", (0, 0, 3)).box(20, 20, 6, (True, True, False))
    return cq.Workplane().sphere(5).cut(block).faces("%SPHERE").val()


def folded(size, rise, width=1.0):
    """Two rectangles side by side, the second of which rises, far from the origin and tilted; lengths by their size."""

    def rectangle(x0, z0, x1, z1):
        corners = [(x0, 0, z0), (x1, 0, z1), (x1, width, z1), (x0, width, z0)]
        places = [tuple(size * c for c in corner) for corner in corners]
        return cq.Face.makeFromWires(cq.Wire.makePolygon([cq.Vector(*place) for place in places], close=True))

    both = cq.Compound.makeCompound([rectangle(0, 0, 0.5, 0), rectangle(0.5, 0, 1, rise)])
    return both.rotate(cq.Vector(), cq.Vector(1, 2, 3), 40).translate(cq.Vector(30 * size, -20 * size, 10 * size))


@pytest.mark.parametrize(("make", "edges"), [(tray, 8), (wall, 2), (bowl, 1)])
def test_an_open_surface_is_a_remark_with_the_number_of_its_edges(make, edges):
    (note,) = hlr.draw(make(), "iso", strict=True, **AT_SIZE).notes
    number = "1 edge" if edges == 1 else f"{edges} edges"
    assert (note.code, note.is_warning) == ("open-surfaces", False)
    assert note.text == f'Part "part" holds faces and no solid: it is open, at {number}.'
    assert defects(make()) == [f"open: {edges} border edge{'' if edges == 1 else 's'}"]


def test_the_number_does_not_depend_on_how_finely_it_is_meshed():
    notes = [hlr.draw(tray(), "iso", scale=1, accuracy=accuracy).notes for accuracy in (0.1, 0.001)]
    assert notes[0] == notes[1]


def test_a_flat_sketch_is_told_nothing():
    drawing = hlr.draw(sketch(), "iso", strict=True, **AT_SIZE)
    assert drawing.lines and not drawing.notes
    (part,) = hlr.info(sketch()).parts
    assert not part.closed and not part.defects


@pytest.mark.parametrize("size", [1.0, 100_000.0])
def test_what_lies_in_one_plane_but_for_rounding_is_flat(size):
    """Millimetres: as small as a pin, and as long as a bridge."""
    assert not defects(folded(size, 0.0)) and not defects(folded(size, 1e-8))
    assert defects(folded(size, 1e-6)) and defects(folded(size, 0.1))


def test_a_strip_that_is_hardly_more_than_a_line_is_flat():
    """100 m by 1 mm, and by 1 nm, where rounding decides how it is turned around its length."""
    assert not defects(folded(100_000.0, 0.0, 1e-5)) and defects(folded(100_000.0, 1e-6, 1e-5))
    assert not defects(folded(100_000.0, 0.0, 1e-11))


def test_a_solid_that_is_open_is_a_warning_as_ever():
    (note,) = hlr.draw(open_solid(), "iso", **AT_SIZE).notes
    assert (note.code, note.text) == ("defects", 'Part "part" is drawn as it is: open: 8 border edges.')
    with pytest.raises(hlr.StrictError, match="open: 8 border edges"):
        hlr.draw(open_solid(), "iso", strict=True, **AT_SIZE)


def test_a_flat_mesh_is_a_warning_as_ever():
    with pytest.raises(hlr.StrictError, match="open: 3 border edges"):
        hlr.draw(([(0, 0, 0), (30, 0, 0), (0, 20, 0)], [(0, 1, 2)]), "top", strict=True, **AT_SIZE)


def test_of_many_open_surfaces_some_are_named():
    whole = cq.Assembly()
    for i in range(7):
        whole.add(wall(), name=f"wall{i}", loc=cq.Location((30 * i, 0, 0)))
    notes = hlr.draw(whole, "iso", **AT_SIZE).notes
    assert [note.code for note in notes] == ["open-surfaces"] * 6
    assert "wall0" in notes[0].text
    assert notes[-1].text == "2 more parts of faces and no solid are open: see hlr info."
