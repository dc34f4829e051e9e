"""A section a hundred-thousandth of a millimetre beside the seam of a tube, a cone, a ring or a bore.

Between the plane and the seam a strip of the surface is left. With the rest of its face on the other side of the seam
it was too narrow to be meshed, and the drawing warned that the part is open.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.sections import measured_area, opencascade_cuts

BESIDE = [
    sign * share * 10.0**power for power in (-6, -5, -4) for share in (1.0, 2.0, 5.0, 9.0) for sign in (1.0, -1.0)
]
"""How far the plane lies beside the axis, and the seam."""


def tube() -> cq.Workplane:
    return cq.Workplane().circle(20).circle(12).extrude(40)


def rounded() -> cq.Workplane:
    return cq.Workplane().circle(15).circle(8).extrude(20).faces(">Z").edges().fillet(2)


MODELS = {
    "tube": (tube(), 2 * 8 * 40.0),
    "rounded tube": (rounded(), 2 * (7 * 20.0 - 2 * 4 * (1 - np.pi / 4))),
    "cone": (cq.Workplane(cq.Solid.makeCone(10, 4, 20)), 14 * 20.0),
    "torus": (cq.Workplane(cq.Solid.makeTorus(20, 5)), 2 * np.pi * 25.0),
    "bore": (cq.Workplane().box(40, 40, 10).faces(">Z").workplane().hole(12), 28 * 10.0),
}
"""Each with the area of its section."""


@pytest.mark.parametrize("beside", BESIDE)
@pytest.mark.parametrize("name", MODELS)
def test_it_is_closed_and_hatched(name: str, beside: float) -> None:
    model, area = MODELS[name]
    drawing = hlr.draw(model, "front", section=beside, **AT_SIZE)
    assert not drawing.notes
    found = measured_area(drawing)
    assert found == pytest.approx(area, rel=0.04)
    middle = hlr.draw(model, "front", section=0.0, **AT_SIZE)
    assert found == pytest.approx(measured_area(middle), rel=0.002)


@pytest.mark.parametrize("beside", [-5e-6, -1e-5, -2e-5])
def test_the_lines_are_those_of_opencascades_cut(monkeypatch, beside: float) -> None:
    own = hlr.draw(tube(), "front", section=beside, **{**AT_SIZE, "smooth": True})
    opencascade_cuts(monkeypatch)
    other = hlr.draw(tube(), "front", section=beside, **{**AT_SIZE, "smooth": True})
    kinds = [sorted((line.kind, line.visible) for line in drawing.lines) for drawing in (own, other)]
    assert kinds[0] == kinds[1]


def test_picture(picture):
    picture(hlr.draw(rounded(), "front", section=-1e-5, **AT_SIZE))
