"""Where an edge turns behind its own face, with something else in front of it; outlines beside other outlines."""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
from hlr.lab.measure import measured
from hlr.source import open_source
from support.at_size import AT_SIZE

ACCURACY = 0.5
"""Coarse: a chord of the rim below is 6 mm long, twelve accuracies."""

VIEW = (0, -1, 0.6)


def keeps(model, view=VIEW):
    source = open_source(model)
    drawing = hlr.draw(source, view, accuracy=ACCURACY, **AT_SIZE)
    reached = measured(source, drawing, samples=4000)
    assert reached.labels.longest <= ACCURACY, reached.labels
    assert reached.changes.worst <= ACCURACY
    assert reached.lost.worst <= ACCURACY
    return drawing


@pytest.mark.parametrize("x", [13.5, 15.0, 16.5, 18.0])
def test_what_is_in_front_of_the_last_chord_hides_it_up_to_its_own_border(x):
    """The lower rim of a cylinder turns behind it on a chord; a post in front covers part of that chord."""
    can = cq.Workplane("XY").circle(20).extrude(12)
    post = cq.Workplane("XY").box(2.0, 2.0, 30).translate((x, -30, 0))
    keeps(cq.Assembly().add(can, name="can").add(post, name="post"), (0.3, -1, 0.6))


@pytest.mark.parametrize("inside", [0.6, 0.9, 1.2])
def test_an_outline_close_behind_another_is_hidden(inside):
    """Less than two accuracies away: moved out of its own facets by more than that, it would be seen beside it."""
    front = cq.Workplane("XY").circle(20).extrude(40)
    back = cq.Workplane("XY").circle(20.0 - inside).extrude(40).rotate((0, 0, 20), (0, 1, 20), 0.5)
    drawing = keeps(cq.Assembly().add(front, name="front").add(back.translate((0, 60, 0)), name="back"), (0, -1, 0))
    outlines = [x for x in drawing.lines if x.kind == "outline" and drawing.parts[x.part].name.endswith("back")]
    assert outlines and not any(x.visible for x in outlines)
