"""Lines of a file that does not say which are hidden, beside visible lines of hlr: no fault where ink covers them."""

from __future__ import annotations

from dataclasses import replace

import ezdxf
import numpy as np
import pytest

import hlr
from hlr.compare import compare
from hlr.compare.matching.judge import judged as judge
from hlr.compare.reading.model import sides_of
from hlr.compare.verdict.verdicts import with_verdicts
from hlr.drawing.chords import chords

cq = pytest.importorskip("cadquery")

VIEW = (0, -1, 1)
TOLERANCE_MM = 0.03


@pytest.fixture(scope="module")
def cylinder():
    return cq.Workplane().circle(10).extrude(30)


@pytest.fixture
def file(cylinder, tmp_path):
    """A DXF of one layer and one linetype, with the whole lower rim: also where it dives under the outlines."""
    drawing = hlr.draw(cylinder, view=VIEW, scale=4, hidden=True, accuracy=0.02)
    rim = next(line.curve for line in drawing.visible if line.curve is not None and not line.curve.whole)
    others = [line for line in drawing.lines if line.curve is None or line.curve.whole]
    assert len(others) == 3
    document = ezdxf.new()
    document.units = 4
    for points in (
        chords(replace(rim, angles=np.array([0.0, 2.0 * np.pi])), 0.01),
        *(line.points if line.curve is None else chords(line.curve, 0.01) for line in others),
    ):
        document.modelspace().add_lwpolyline(points.tolist(), dxfattribs={"layer": "View"})
    document.saveas(tmp_path / "other.dxf")
    return tmp_path / "other.dxf"


def test_a_hidden_line_that_hlr_leaves_out_beside_an_outline_is_right_both_ways(cylinder, file):
    found = compare(file, cylinder, view=VIEW, scale=4, register="translation", tolerance_mm=TOLERANCE_MM)
    alone = [each for each in found.differences if each.kind == "gone"]
    assert alone
    assert {each.verdict for each in alone} == {"both right"}
    assert all("so close to a visible line" in each.reason for each in alone)
    assert found.wrong_mm == 0.0


def test_a_visible_line_that_hlr_lacks_is_its_fault_all_the_same(cylinder, file):
    before, after = sides_of(file, cylinder, TOLERANCE_MM, VIEW, scale=4)
    pieces = after.pieces
    longest = np.bincount(pieces.line[pieces.curved == 0], pieces.lengths[pieces.curved == 0]).argmax()
    after = replace(after, pieces=pieces.take(pieces.line != longest))
    found = with_verdicts(judge(before, after, TOLERANCE_MM), before, after, None, TOLERANCE_MM)
    assert [each.verdict for each in found.differences if each.length_mm > 50 and each.kind == "gone"] == [
        "first right"
    ]
