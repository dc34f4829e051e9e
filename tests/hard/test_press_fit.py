"""A shaft that is a few micrometres thicker than its bore: the rim of the bore is seen, though it lies in the shaft.

Less deep than the accuracy, that is a contact, and there is no intersection line. But the rim was hidden: its chords
and those of the shaft are off by as much again, and seen at a slant what lies a little beneath a surface lies far
behind it. So no line at all was drawn where the parts meet.
"""

from __future__ import annotations

from pathlib import Path

import cadquery as cq
import pytest

import hlr
from support.at_size import ALL_LINES
from support.missing_ink import missing, visible_segments

DATA = Path(__file__).parents[1] / "data"
ACCURACY = 0.05
SCALE = 2.0
OVERLAPS = [0.2, 0.4, 0.6, 0.8, 0.9]
"""Accuracies. From one on there is an intersection line."""
APART = 0.25
"""Millimetres: within this a line stands for another."""
VIEWS = ["iso", (0.3, 0.5, 2.0), (2.0, 1.0, 1.0), (-1.0, 3.0, 4.0)]


def shaft(radius):
    return cq.Workplane().circle(radius).extrude(40)


def hub():
    return cq.Workplane().workplane(offset=10).circle(25).circle(10).extrude(20)


def shaft_in_a_hub(over):
    return shaft(10 + over), hub()


def shaft_in_a_hub_cut_open(over):
    return shaft(10 + over), hub().cut(cq.Workplane().box(60, 60, 60).translate((30, -30, 20)))


def ball_in_its_socket(over):
    return cq.Workplane().sphere(10 + over), cq.Workplane().box(40, 40, 14).translate((0, 0, -7)).cut(ball())


def ball():
    return cq.Workplane().sphere(10)


def dowel_in_a_chamfered_hole(over):
    block = cq.Workplane().box(40, 30, 12).translate((0, 0, 12)).faces(">Z").workplane().hole(10)
    return shaft(5 + over), block.faces(">Z").edges("%CIRCLE").chamfer(1.5)


def assembly(parts):
    out = cq.Assembly()
    for k, part in enumerate(parts):
        out.add(part, name=f"part {k}")
    return out


def seen(model, over, view):
    drawing = hlr.draw(assembly(model(over)), view, accuracy=ACCURACY, scale=SCALE, **ALL_LINES)
    return visible_segments(drawing)


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize(
    ("model", "most"),
    [
        (shaft_in_a_hub, 1.5),
        (shaft_in_a_hub_cut_open, 0.6),
        (ball_in_its_socket, 0.2),
        (dowel_in_a_chamfered_hole, 1.0),
    ],
)
def test_the_rim_is_seen_as_where_both_are_of_one_size(model, most, view):
    """most: millimetres that may be missing, beside the outline of the shaft, where it is seen edge-on."""
    exact = seen(model, 0.0, view)
    for accuracies in OVERLAPS:
        found = seen(model, accuracies * ACCURACY / SCALE, view)
        assert missing(exact, found, APART) <= most, accuracies
        assert missing(found, exact, APART) == 0.0, accuracies


def test_what_lies_deeper_has_its_line():
    for over in (1.2, 2.0, 4.0):
        exact, found = (seen(shaft_in_a_hub, x * ACCURACY / SCALE, (0.3, 0.5, 2.0)) for x in (0.0, over))
        assert missing(exact, found, APART) <= 0.5


def test_no_bits_of_rims_are_left_beside_outlines():
    """Bolts in holes of their own size: a rim is seen up to the outline of its bolt, and no bit of it beyond."""
    drawing = hlr.draw(DATA / "as1-oc-214.stp", "iso", accuracy=ACCURACY, scale=1.0, **ALL_LINES)
    assert min(line.length_mm for line in drawing.visible) > 1.0


def test_picture(picture):
    picture(hlr.draw(assembly(shaft_in_a_hub_cut_open(0.02)), "iso", accuracy=ACCURACY, scale=SCALE))
