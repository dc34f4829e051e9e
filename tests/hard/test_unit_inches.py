"""Files written in inches, feet and metres: a drawing is in millimetres whatever the file counts in.

Readers that take the number for the length draw an inch as a millimetre.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, like

import hlr
from support.at_size import ALL_LINES, AT_SIZE
from support.expected import expect

INCH = 25.4


@pytest.fixture
def unit():
    """Sets the unit of the files that OpenCASCADE writes, and puts it back."""
    from OCP.IGESControl import IGESControl_Controller
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import STEPControl_Controller

    # Without them there is nothing to set yet.
    STEPControl_Controller.Init_s()
    IGESControl_Controller.Init_s()
    yield lambda value: (
        Interface_Static.SetCVal_s("write.step.unit", value),
        Interface_Static.SetCVal_s("write.iges.unit", value),
    )
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    Interface_Static.SetCVal_s("write.iges.unit", "MM")


def write(path):
    """A block of 1 x 2 x 0.5 inches; the shape in memory is in millimetres."""
    shape = cq.Workplane().box(INCH, 2 * INCH, INCH / 2).val().wrapped
    if path.suffix == ".step":
        from OCP.STEPControl import STEPControl_AsIs, STEPControl_Writer

        writer = STEPControl_Writer()
        writer.Transfer(shape, STEPControl_AsIs)
    else:
        from OCP.IGESControl import IGESControl_Writer
        from OCP.Interface import Interface_Static

        writer = IGESControl_Writer(Interface_Static.CVal_s("write.iges.unit"), 0)
        writer.AddShape(shape)
        writer.ComputeModel()
    writer.Write(str(path))
    return path


@pytest.mark.parametrize("name", ["INCH", "FT", "M", "MM"])
@pytest.mark.parametrize("suffix", [".step", ".igs"])
def test_an_inch_is_25_4_mm(tmp_path, unit, name, suffix, picture):
    unit(name)
    path = write(tmp_path / f"block{suffix}")
    text = path.read_text()
    if suffix == ".step" and name == "INCH":
        assert "INCH" in text and "25.4" in text
    drawing = hlr.draw(path, "iso", **AT_SIZE)
    seen, unseen = box_edges((-INCH / 2, -INCH, -INCH / 4), (INCH / 2, INCH, INCH / 4), drawing.view.direction)
    like(drawing, expect(drawing, seen, unseen))
    if (suffix, name) == (".step", "INCH"):
        picture(drawing)


def test_the_scale_is_of_millimetres(tmp_path, unit):
    unit("INCH")
    x0, y0, x1, y1 = hlr.draw(write(tmp_path / "block.step"), "front", scale=0.5, **ALL_LINES).bounds
    assert (x1 - x0, y1 - y0) == pytest.approx((INCH / 2, INCH / 4), abs=1e-3)
