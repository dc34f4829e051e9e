"""Faces without a solid, as IGES files and compounds have them: each is turned as its surface happens to be.

Where two of them go on smoothly, and one looks outward and the other inward, their edge would be a crease. In IGES
files some of them are placed as mirror images besides, and a whole sphere is a face by itself. The drawing of the solid
is the oracle.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import same
from OCP.IGESControl import IGESControl_Writer
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum

import hlr
from hlr.source.cad.iges import open_iges
from support.at_size import AT_SIZE
from support.expected import differences, ink


def shelled() -> cq.Shape:
    """A box with round corners and a thin wall: its faces inside look the other way than the surfaces they lie on."""
    return cq.Workplane().box(40, 30, 20).edges("|Z").fillet(5).faces("<Z").shell(-2).val()


def ring() -> cq.Shape:
    return cq.Workplane().circle(15).circle(8).extrude(20).faces(">Z").edges().fillet(2).val()


def ball() -> cq.Shape:
    return cq.Workplane().sphere(10).val().moved(cq.Location(cq.Vector(35, 0, 10)))


def both() -> cq.Shape:
    return cq.Compound.makeCompound([ring(), ball()])


def hollow() -> cq.Shape:
    """A block with rounded edges, and with two cavities: a rounded one and a ball."""
    inner = cq.Workplane().box(15, 20, 10).edges().fillet(2).translate((-15, 0, 0))
    block = cq.Workplane().box(60, 30, 20).edges().fillet(3)
    return block.cut(inner).cut(cq.Workplane().sphere(7).translate((15, 0, 0))).val()


MODELS = {"shelled": shelled, "ring": ring, "ball": ball, "both": both, "hollow": hollow}


def as_faces(shape: cq.Shape, folder) -> str:
    """The shape in an IGES file of trimmed surfaces."""
    path = str(folder / "faces.igs")
    writer = IGESControl_Writer("MM", 0)
    writer.AddShape(shape.wrapped)
    writer.ComputeModel()
    assert writer.Write(path)
    return path


@pytest.mark.parametrize("view", ["front", "iso", (1.0, 2.0, -0.5)])
@pytest.mark.parametrize("name", MODELS)
def test_an_iges_file_is_drawn_as_the_solid(tmp_path, name, view):
    shape = MODELS[name]()
    drawing = hlr.draw(as_faces(shape, tmp_path), view, **AT_SIZE)
    assert drawing.notes == ()
    same(drawing, hlr.draw(shape, view, **AT_SIZE))


@pytest.mark.parametrize("beside", [1e-6, -5e-6])
def test_a_cut_beside_the_seam_leaves_no_film(tmp_path, beside):
    """Where the plane is moved onto the seam of the ball, two triangles of it lay on one another."""
    assert not hlr.draw(as_faces(both(), tmp_path), "front", section=beside, **AT_SIZE).notes


@pytest.mark.parametrize("name", MODELS)
def test_it_is_cut_and_hatched_as_the_solid(tmp_path, name):
    shape = MODELS[name]()
    found = [hlr.draw(each, "front", section=True, **AT_SIZE) for each in (as_faces(shape, tmp_path), shape)]
    assert found[0].notes == found[1].notes == ()
    drawn, wanted = (ink(drawing, ["hatch"]) for drawing in found)
    assert not differences(wanted, drawn, 2.0 * max(drawing.accuracy.used for drawing in found))
    if name != "both":
        same(*found)
    # The file has one part where the compound has two, so their hatches differ, but not where they are.
    across = [np.concatenate([line.points3[:, 0] for line in d.lines if line.kind == "hatch"]) for d in found]
    counts = [np.histogram(each, bins=np.arange(-27, 50, 5))[0] > 0 for each in across]
    assert counts[0].tolist() == counts[1].tolist()
    assert counts[0].any()


@pytest.mark.parametrize("view", ["front", "iso", (1.0, 2.0, -0.5)])
@pytest.mark.parametrize("name", MODELS)
def test_loose_faces_as_their_surfaces_look_are_drawn_as_the_solid(name, view):
    shape = MODELS[name]()
    forward = [cq.Face(face.wrapped.Oriented(TopAbs_Orientation.TopAbs_FORWARD)) for face in shape.Faces()]
    drawing = hlr.draw(cq.Compound.makeCompound(forward), view, **AT_SIZE)
    assert drawing.notes == ()
    same(drawing, hlr.draw(shape, view, **AT_SIZE))


def test_what_cannot_be_cut_as_a_solid_is_cut_open(tmp_path, monkeypatch):
    from hlr.source.cad import half_space

    as_it_is = half_space.cut_away

    def cut_away(leaves, origin, normal):
        if leaves[0].shape.ShapeType() == TopAbs_ShapeEnum.TopAbs_SOLID:
            raise half_space.UncuttableError(leaves[0].name, "its shape is not sound", "move the plane a little")
        return as_it_is(leaves, origin, normal)

    monkeypatch.setattr(half_space, "cut_away", cut_away)
    drawing = hlr.draw(as_faces(hollow(), tmp_path), "front", section=True, **AT_SIZE)
    assert any("without a hatch" in note.text for note in drawing.notes)
    assert drawing.lines and not any(line.kind == "hatch" for line in drawing.lines)


@pytest.mark.parametrize("seed", range(8))
def test_bodies_that_have_but_an_edge_in_common_are_turned_one_by_one(seed):
    large, small = cq.Workplane().box(20, 20, 20), cq.Workplane().box(12, 12, 20).translate((16, 16, 0))
    shape = large.union(small).val()
    turned = np.random.default_rng(seed).random(len(shape.Faces())) < 0.5
    faces = [cq.Face(f.wrapped.Reversed()) if t else f for f, t in zip(shape.Faces(), turned, strict=True)]
    for view in ("iso", (1.0, -0.6, 0.8)):
        drawing = hlr.draw(cq.Compound.makeCompound(faces), view, **AT_SIZE)
        same(drawing, hlr.draw(shape, view, **AT_SIZE))


def test_faces_that_are_rebuilt_keep_their_colours(tmp_path):
    from OCP.IGESCAFControl import IGESCAFControl_Writer
    from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFApp import XCAFApp_Application
    from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    XCAFApp_Application.GetApplication_s().InitDocument(document)
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    shape = ring()
    whole = shapes.AddShape(shape.wrapped, False)
    for i, face in enumerate(shape.Faces()):
        color = Quantity_Color(0.1 * (i + 1), 0.2, 0.9, Quantity_TypeOfColor.Quantity_TOC_sRGB)
        label = shapes.AddSubShape(whole, face.wrapped)
        colors.SetColor(label, color, XCAFDoc_ColorType.XCAFDoc_ColorSurf)
    writer = IGESCAFControl_Writer()
    writer.SetColorMode(True)
    writer.Transfer(document)
    writer.ComputeModel()
    path = tmp_path / "painted.igs"
    assert writer.Write(str(path))
    (look,) = open_iges(path).appearances().values()
    assert [round(10 * look.faces[i][0]) for i in range(6)] == [1, 2, 3, 4, 5, 6]


def test_picture(picture, tmp_path):
    picture(hlr.draw(as_faces(shelled(), tmp_path), "front", section=True, **AT_SIZE))
