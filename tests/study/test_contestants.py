"""Lines of other programs, on shapes whose lines are known."""

import numpy as np
import pytest

from hlr.image.camera import resolve
from hlr.lab.polylines import drawing_of
from hlr.lab.study import occt
from hlr.lab.study.watch import Watch
from hlr.request.options import Options
from hlr.source import open_source
from hlr.source.model import Frame


def camera():
    return resolve("iso", Options(), Frame(), np.array([[0.0, 0, 0], [10, 10, 10]]))


def length(ink, visible):
    pieces = ink.segments(ink.visible == visible)
    return np.hypot(pieces[:, 2] - pieces[:, 0], pieces[:, 3] - pieces[:, 1]).sum()


@pytest.mark.parametrize("method", ["poly", "exact"])
def test_opencascade_draws_a_box(method):
    import cadquery as cq

    shape = cq.Workplane().box(10, 10, 10).val().wrapped
    watch = Watch()
    ink = (
        occt.poly(shape, camera(), 2.0, 0.1, 0.5, watch)
        if method == "poly"
        else occt.exact(shape, camera(), 2.0, watch)
    )
    edge = 2 * 10 * np.sqrt(2 / 3)
    assert length(ink, True) == pytest.approx(9 * edge)
    assert length(ink, False) == pytest.approx(3 * edge)
    assert {"visibility", "linework"} <= set(watch.stages)


def test_parts_are_drawn_where_they_stand():
    import cadquery as cq
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = cq.Workplane().box(2, 2, 2)
    assembly = cq.Assembly(box).add(box, loc=cq.Location((30, 0, 0), (0, 0, 1), 90))
    bounds = Bnd_Box()
    BRepBndLib.AddOptimal_s(open_source(assembly).shape(), bounds)
    assert bounds.Get() == pytest.approx((-1, -1, -1, 31, 1, 1), abs=1e-6)


def test_bare_lines_are_written_like_a_drawing():
    import cadquery as cq

    from hlr.drawing.saving import render
    from hlr.pipeline.finish import drawn_view

    ink = occt.poly(cq.Workplane().box(10, 10, 10).val().wrapped, camera(), 1.0, 0.1, 0.5, Watch())
    drawing = drawing_of(ink, "box", drawn_view(camera()), 1.0, 0.05)
    assert len(drawing.lines) == len(ink.visible)
    assert b"<path" in render(drawing, "svg")
