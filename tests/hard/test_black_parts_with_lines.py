"""Parts that are black, or nearly, shaded with the drawing's lines on top: a black line on them is not seen."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.shading.dark import DARK, LIGHT


def plug(color):
    """A plate with a boss, all in one colour."""
    shape = cq.Workplane().box(40, 30, 8).faces(">Z").workplane().circle(9).extrude(8)
    return cq.Assembly().add(shape, name="plug", color=cq.Color(*color))


def pictures(color, **options):
    bare, inked = (
        hlr.preview(plug(color), size=(300, 240), edges=edges, **options).pixels[:, :, :3].astype(int)
        for edges in (False, True)
    )
    return bare, inked


@pytest.mark.parametrize("shade", [0.0, 0.01, 0.03, 0.08])
@pytest.mark.parametrize("background", ["white", "black", "transparent"])
def test_lines_within_a_black_part_are_light(shade, background):
    _, inked = pictures((shade, shade, shade), background=background)
    light = (np.abs(inked - LIGHT[0]) < 12).all(axis=2)
    # The circle of the boss alone is longer than this, and a line is two pixels wide.
    assert light[60:180, 60:240].sum() > 150


def test_the_outline_of_a_black_part_on_white_stays_black():
    bare, inked = pictures((0.01, 0.01, 0.01))
    covered = bare.max(axis=2) < 200
    outside = ~covered
    # All that the outline adds beyond the part is darker than the background, and none of it is light ink on the part.
    border = np.zeros_like(covered)
    border[1:-1, 1:-1] = covered[1:-1, 1:-1] & (
        outside[:-2, 1:-1] | outside[2:, 1:-1] | outside[1:-1, :-2] | outside[1:-1, 2:]
    )
    assert border.sum() > 300
    assert inked[border].max() < 90


@pytest.mark.parametrize("color", [(0.7, 0.74, 0.79), (0.8, 0.1, 0.1), (0.3, 0.3, 0.3)])
def test_lines_of_other_parts_are_black(color):
    bare, inked = pictures(color)
    changed = np.abs(bare - inked).max(axis=2) > 0
    assert changed.sum() > 500
    assert (inked <= bare)[changed].all()
    assert bare.max(axis=2).min() >= DARK
