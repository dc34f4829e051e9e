"""Balls in a groove of their own radius: the edge of the groove runs along the outlines of the balls.

Seen obliquely, an edge of the groove lies behind the outline of a ball for 1.8 mm of its length, but no further than
0.028 mm on paper. That is less than the accuracy, so it may be drawn visible. The report called it mislabelled: on one
side of the edge its rays met the ball, on the other the fillet of the ring itself, which rises toward the viewer.
"""

from __future__ import annotations

from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.rays import Caster, contradicted
from hlr.lab.measure.written import in_model, written
from hlr.source import open_source

PITCH, RADIUS = 15.0, 3.0
TURNS = np.radians(40.0 * np.arange(9))
CENTRES = PITCH * np.stack([np.cos(TURNS), np.sin(TURNS), 0.0 * TURNS], axis=1)
ACCURACY, SCALE = 0.05, 5.0


def bearing() -> cq.Assembly:
    profile = cq.Workplane("XZ").moveTo(8.0, -5.0).lineTo(13.0, -5.0).lineTo(13.0, 5.0).lineTo(8.0, 5.0).close()
    ring = profile.revolve(360.0, (0, 0, 0), (0, 1, 0))
    groove = cq.Workplane(cq.Solid.makeTorus(PITCH, RADIUS))
    ring = ring.cut(groove).faces("%TORUS").edges().fillet(0.4)
    model = cq.Assembly().add(ring, name="ring")
    for centre in CENTRES:
        model.add(cq.Workplane().sphere(RADIUS).translate(tuple(centre)), name=f"ball{len(model.children)}")
    return model


@pytest.fixture(scope="module")
def model():
    return open_source(bearing())


@pytest.fixture(scope="module")
def drawing(model):
    return hlr.draw(model, "iso", scale=SCALE, accuracy=ACCURACY, smooth=True, hidden=False)


def sunk_behind_a_ball(points, toward):
    """How far behind the outline of a ball points lie on paper, mm; negative beside all balls, or before them."""
    way = CENTRES[None] - points[:, None]
    depth = way @ toward
    beside = RADIUS - np.sqrt((way**2).sum(axis=2) - depth**2)
    return SCALE * np.where(depth > 0.0, beside, -np.inf).max(axis=1)


def wrong(model, drawing):
    """Points along the visible lines that the report's rays contradict, in the model, with the line of each."""
    drawn, paper = written(drawing), Paper.of(drawing)
    caster = Caster.of(model, drawing, paper, drawing.accuracy.deflection / 4)
    points, line = drawn.middles(0.25 * ACCURACY)
    found = contradicted(drawing, drawn, points, line, caster)
    return in_model(drawing, points[found], line[found]), line[found]


@pytest.mark.slow
def test_the_edge_of_the_groove_may_be_called_either_way(model, drawing):
    rim = [
        line
        for line in drawing.lines
        if line.visible and line.kind == "smooth" and drawing.parts[line.part].name == "ring"
    ]
    points = np.concatenate([line.points3 for line in rim])
    sunk = sunk_behind_a_ball(points, np.array(drawing.view.direction))
    # By the equations of the balls, what is drawn visible of the rim is nowhere further behind one than the accuracy.
    assert sunk.max() < ACCURACY
    found, _ = wrong(model, drawing)
    assert len(found) == 0


@pytest.mark.slow
def test_what_is_well_behind_a_ball_or_the_ring_is_still_found(model, drawing):
    whole = hlr.draw(model, "iso", scale=SCALE, accuracy=ACCURACY, smooth=True, hidden=True)
    false = replace(whole, lines=tuple(replace(line, visible=True) for line in whole.lines))
    found, line = wrong(model, false)
    hidden = np.array([not x.visible for x in whole.lines])
    assert hidden[line].all()
    # Of the ring's own lines: those behind a ball, and those that the ring itself hides.
    behind = sunk_behind_a_ball(found, np.array(whole.view.direction)) > ACCURACY
    own = np.array([whole.parts[x.part].name == "ring" for x in whole.lines])[line]
    assert (own & behind).sum() > 1000 and (own & ~behind).sum() > 1000


def test_what_is_far_behind_a_seam_of_two_parts_is_found():
    """A plate of the line's own part covers it on one side, and another part on the other: both far before it."""
    clamp = cq.Workplane().box(20, 30, 20).cut(cq.Workplane().box(15, 20, 20).translate((2.5, 0, 0)))
    cover = cq.Workplane().box(20, 5, 20).translate((20 - 1e-3, -12.5, 0))
    opened = open_source(cq.Assembly().add(clamp, name="clamp").add(cover, name="cover"))
    drawing = hlr.draw(opened, "front", scale=SCALE, accuracy=ACCURACY)
    caster = Caster.of(opened, drawing, Paper.of(drawing), drawing.accuracy.deflection)
    edge = np.stack([np.full(9, 10.0), np.full(9, 10.0), np.linspace(-8.0, 8.0, 9)], axis=1)
    clamped = [part.name for part in drawing.parts].index("clamp")
    assert caster.blocked_surely(edge, np.full(9, clamped)).all()
    # By itself the clamp covers half of the rays.
    alone = caster._of(caster.part == clamped)
    assert not alone.blocked_surely(edge, np.full(9, clamped)).any()
