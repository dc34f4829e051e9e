"""Wrong and missing intersection lines are found, and a right drawing passes."""

from __future__ import annotations

from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest
from peers import crossings

from hlr.drawing.lines import Lines

FAR = 1e3


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """A block, a pin that goes through it, a plate let into it, a block beside it; their drawing and common volumes."""
    block = cq.Workplane().box(20, 20, 20).val()
    pin = cq.Solid.makeCylinder(3, 40, cq.Vector(0, 0, -20))
    let_in = cq.Workplane().box(4, 4, 2).translate((7, 7, 9)).val()
    beside = cq.Workplane().box(20, 20, 20).translate((20, 0, 0)).val()
    path = tmp_path_factory.mktemp("crossings") / "parts.step"
    cq.exporters.export(cq.Workplane(cq.Compound.makeCompound([block, pin, let_in, beside])), str(path))
    return path, crossings.common_volumes(path, 60.0)


def test_a_right_drawing_passes(found):
    path, common = found
    assert {pair for pair, thick in common.thickness.items() if thick > 0} == {(0, 1), (0, 2)}
    for accuracy in (0.05, 0.01):
        _, told = crossings.compared(path, accuracy, common)
        assert told == crossings.Compared(both=[(0, 1)], wrong=[], missing=[], untold=0)


def test_a_missing_and_a_wrong_line_are_found(found):
    path, common = found
    drawing, _ = crossings.compared(path, 0.05, common)
    boxes = crossings.part_boxes(crossings.open_source(path), 0.05)
    without = replace(drawing, lines=[line for line in drawing.lines if line.kind != "intersection"])
    assert crossings.compare(without, boxes, common).missing == [(0, 1)]
    pins = [line for line in drawing.lines if line.kind == "intersection"]
    assert pins and isinstance(drawing.lines, Lines)
    false = replace(drawing, lines=[*drawing.lines, replace(pins[0], part=0, other=3)])
    assert crossings.compare(false, boxes, common).wrong == [(0, 3)]


def test_parts_that_are_no_solids_and_volumes_that_were_not_told_are_counted(found):
    path, common = found
    drawing, _ = crossings.compared(path, 0.05, common)
    boxes = crossings.part_boxes(crossings.open_source(path), 0.05)
    assert crossings.compare(drawing, boxes + FAR, common).untold == 1
    assert crossings.compare(drawing, boxes, replace(common, thickness={})).untold == 1
    assert crossings.compare(drawing, boxes, crossings.Common(np.zeros((0, 6)), {})).untold == 1


def test_a_process_that_takes_too_long_leaves_what_it_told(found):
    path, _ = found
    assert crossings.common_volumes(path, 1e-3).thickness == {}


def test_exit_code(found, capsys):
    path, _ = found
    assert crossings.main([str(path), "--accuracy", "0.05"]) == 0
    assert "1 pairs cross, wrong [], missing []" in capsys.readouterr().out
