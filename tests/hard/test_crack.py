"""A surface glued from two halves that do not quite meet: through the crack a line of sight reaches what lies behind.

Exporters that mesh each face for itself leave such cracks; a ray caster shows bright pinholes there. On paper a crack
narrower than the accuracy is none: no line behind may shine through it, whether it crosses the crack or runs along it.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import differences, expect, ink
from support.meshes import as_parts, box, box_lines, face, grid, merged

ACCURACY = 0.05
WIDTHS = [0.0, 0.001, 0.1, 0.5, 0.9]
"""Of a crack, in accuracies."""


def halves(width, behind):
    """The square -20..20 in the plane z = 0, cracked along x = 0 from side to side; `behind` lies below it."""
    w = width * ACCURACY / 2
    left = face((-20, -20, 0), (-w, -20, 0), (-w, 20, 0), (-20, 20, 0))
    right = face((w, -20, 0), (20, -20, 0), (20, 20, 0), (w, 20, 0))
    return left, right, behind


def hidden_behind(drawing, lines):
    """What is drawn visible of all that lies below the sheet, and what is missing of these hidden lines."""
    told = differences(expect(drawing, [], lines), ink(drawing), ACCURACY)
    shining = [str(x.points3) for x in drawing.lines if x.visible and (x.points3[:, 2] < -1).any()]
    return [t for t in told if t.startswith("hidden")] + shining


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_lines_across_the_crack_are_hidden(picture, how, width, turn):
    block = box((-10, -5, -9), (10, 5, -5))
    drawing = hlr.draw(how(*halves(width, block)), (turn, turn / 2, 1), accuracy=ACCURACY, **AT_SIZE)
    assert hidden_behind(drawing, box_lines((-10, -5, -9), (10, 5, -5))) == []
    if width == 0.5 and turn:
        picture(drawing)


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("width", WIDTHS)
def test_a_line_along_the_crack_is_hidden(how, width):
    # A needle whose one side lies exactly under the crack, from end to end of it but for 10.
    needle = face((0, -10, -5), (0, 10, -5), (8, 0, -5))
    sheet = halves(width, needle)
    drawing = hlr.draw(how(*sheet), "top", accuracy=ACCURACY, **AT_SIZE)
    # Something visible is there anyway: the sides of the crack. But it belongs to the sheet, not to what lies behind.
    shining = [x for x in drawing.lines if x.visible and np.allclose(x.points3[:, 2], -5)]
    assert shining == []


def test_a_gap_three_accuracies_wide_is_looked_through():
    block = box((-10, -5, -9), (10, 5, -5))
    drawing = hlr.draw(merged(*halves(3.0, block)), "top", accuracy=ACCURACY, **AT_SIZE)
    crossing = [x for x in drawing.lines if x.visible and np.allclose(np.abs(x.points3[:, 1]), 5)]
    assert len(crossing) == 2
    assert {tuple(np.abs(x.points3[:, 0]).round(6)) for x in crossing} == {(0.075, 0.075)}


@pytest.mark.parametrize("view", ["top", (0.2, -0.1, 1), (1, 2, 3)])
def test_a_t_junction_lets_nothing_through(view):
    # Left of x = 0 two squares, right of it three: their corners do not meet, but their sides do.
    left = grid(np.array([[(x, y, 0.1 * y) for y in (-20, 0, 20)] for x in (-20.0, 0.0)]))
    right = grid(np.array([[(x, y, 0.1 * y) for y in (-20, -20 / 3, 20 / 3, 20)] for x in (0.0, 20.0)]))
    low, high = (-5, -6, -9), (5, 4, -7)
    drawing = hlr.draw(merged(left, right, box(low, high)), view, **AT_SIZE)
    seen = [x for x in drawing.lines if x.visible and (x.points3[:, 2] < -6.5).all()]
    assert seen == []
    told = differences(expect(drawing, [], box_lines(low, high)), ink(drawing), drawing.accuracy.used)
    assert not [t for t in told if t.startswith("hidden ink is missing")]
