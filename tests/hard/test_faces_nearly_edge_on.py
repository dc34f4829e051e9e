"""Sheets seen at an angle of one in fifty to one in two hundred: no edge is hidden by the face it bounds.

Edges and outlines are drawn where they truly are, but what hides them are triangles, off the face by their deflection;
seen nearly edge-on, a triangle that is off by a hair covers an edge over centimetres, or lets one be seen that lies
behind the face. A straight border of a twisted face is one chord, however often the face turns over along it.

Judged by dense rays against the faces sampled far finer (`peers/edge_on.py`), both ways.
"""

from __future__ import annotations

import pytest

import hlr
from support import edge_on, sheets
from support.at_size import AT_SIZE

CASES = [
    ("twisted", 0.05, (0.8190332625407435, 0.5737153309804119, -0.0059358108041117075)),
    ("twisted", 0.5, (0.81937799835902, 0.573142201947924, 0.011300980109917)),
    ("ruled", 0.5, (0.9940554279071091, 0.0, 0.1088751865597209)),
    ("ruled", 0.05, (0.9873707016235099, 0.0, 0.15842694712547434)),
    ("saddle", 0.5, (0.7706857552823578, 0.5733182688539257, 0.27811801308653056)),
    ("saddle", 0.05, (0.7786465562597147, 0.5735692666007806, 0.2544166599024714)),
    ("flat patch", 0.5, (-0.5735692666007806, 0.819141804824441, -0.005)),
    ("wavy patch", 0.05, (-0.6028551297290489, 0.7908386383355772, -0.10554591737675906)),
    ("sharp pair", 0.5, (-0.5734298946190339, 0.8041057219833293, -0.15681882486127807)),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "accuracy", "view"), CASES)
def test_what_is_seen_is_drawn_and_nothing_else(name, accuracy, view, picture):
    shape = sheets.SHEETS[name]()
    truth = edge_on.Truth(shape, grid=200)
    drawing = hlr.draw(shape, view, accuracy=accuracy, **AT_SIZE)
    found = truth.judge(drawing)
    assert found.seen > 200 and found.judged > 50
    assert not found.gaps, found.gaps[:5]
    assert not found.wrong, found.wrong[:5]
    if (name, accuracy) == ("twisted", 0.05):
        picture(drawing)


def test_the_judge_can_find_both_faults():
    """A gentle patch without one of its visible lines, and with a hidden line called visible."""
    from dataclasses import replace

    shape = sheets.SHEETS["cylinder of 150 degrees"]()
    truth = edge_on.Truth(shape, grid=200)
    drawing = hlr.draw(shape, (1.0, 0.2, 0.3), accuracy=0.1, **AT_SIZE)
    found = truth.judge(drawing)
    assert not found.gaps and not found.wrong
    seen = [line for line in drawing.lines if line.visible]
    assert truth.judge(replace(drawing, lines=tuple(seen[1:]))).gaps
    assert any(not line.visible for line in drawing.lines)
    assert truth.judge(replace(drawing, lines=tuple(replace(x, visible=True) for x in drawing.lines))).wrong
