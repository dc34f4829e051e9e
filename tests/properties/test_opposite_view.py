"""Look from the opposite side: what is visible from there is a line here, visible or hidden.

In a parallel view both sides see the same edges and outlines, mirrored. A line that is hidden here and not drawn at all
leaves no trace in this drawing; from the other side it may be visible, and is missed.
"""

from __future__ import annotations

from pathlib import Path

import cadquery as cq
import numpy as np
import pytest
from properties import models

import hlr
from support.ink import Ink, beside, ink, strokes

NEAR = 0.15
"""Millimetres on paper: a hidden line this close to a visible one lies under its ink and is not drawn."""
STEP = 0.05
LONGEST = 0.3
"""Millimetres of a line that may be missing where it ends."""
AXES = {"front": (0, -1, 0), "right": (1, 0, 0), "top": (0, 0, 1)}
SKEW = {"skew": (0.4, -0.7, 0.5)}


def post():
    """A post with a rounded end, and a fillet at its flange: from below, the flange hides the whole post."""
    flange = cq.Workplane().circle(20).extrude(4).faces(">Z").workplane()
    return flange.circle(6).extrude(20).edges("%CIRCLE").fillet(1.5)


def rounded_box():
    return cq.Workplane().box(30, 20, 10).edges().fillet(3).faces(">Z").hole(8)


def tray():
    return cq.Workplane().box(40, 30, 12).edges("|Z").fillet(5).faces("<Z").edges().fillet(2).faces(">Z").shell(-1.5)


SHAPES = {"post": post, "rounded box": rounded_box, "tray": tray}


def both(model, view):
    up = (0, 0, 1) if abs(view[2]) < 1 else (0, 1, 0)
    here = hlr.draw(model, view, hidden=True, details=True, up=up)
    return here, hlr.draw(model, tuple(-c for c in view), hidden=True, details=True, up=up, scale=here.scale)


def mirrored(of: Ink) -> Ink:
    return Ink(of.points * (-1, 1), of.length, of.visible, of.line)


def missing(here, there) -> float:
    """Millimetres of visible ink of the opposite view without any ink here."""
    mine = ink(strokes(here), STEP)
    other = mirrored(ink([stroke for stroke in strokes(there) if stroke[0]], STEP))
    found = beside(other.points, mine, True, NEAR) | beside(other.points, mine, False, NEAR)
    lengths = np.bincount(other.line[~found], other.length[~found])
    return float(lengths[lengths > LONGEST].sum())


def expect_the_same_lines(model, view):
    here, there = both(model, view)
    assert len(here.lines) and len(there.lines)
    assert (missing(here, there), missing(there, here)) == (0.0, 0.0)


@pytest.mark.parametrize("view", [*AXES, *SKEW])
@pytest.mark.parametrize("shape", SHAPES)
def test_a_shape_has_the_same_lines_from_both_sides(shape, view):
    expect_the_same_lines(SHAPES[shape](), (AXES | SKEW)[view])


@pytest.mark.slow
@pytest.mark.parametrize("view", [*AXES, *SKEW])
@pytest.mark.parametrize("name", models.SOLIDS)
def test_a_model_has_the_same_lines_from_both_sides(name, view):
    expect_the_same_lines(Path(models.DATA, name), (AXES | SKEW)[view])
