"""A box seen exactly from the front and a hair's breadth off: the same lines while the turn moves nothing on paper.

FreeCAD#9572: with a view direction whose components are "0 but not 0" (1e-17) lines of the projection vanish. At 1e-6
the edges behind are beside those in front by less than the accuracy: drawn as well, every line is there twice.
"""

from __future__ import annotations

import math

import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, differences, expect, ink
from support.measures import length
from support.meshes import BOX_EDGES, box, ring

LOW, HIGH = (-10, -15, -20), (10, 15, 20)
MESH = box(LOW, HIGH)
FRONT = ring([(-10, -15, -20), (10, -15, -20), (10, -15, 20), (-10, -15, 20)])
TURNS = [0.0, 1e-17, 1e-15, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3]
TILTS = [(1, 0), (0, 1), (1, 1), (-1, 1), (1, -1)]


def brep():
    import cadquery as cq

    return cq.Workplane().box(20, 30, 40)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["mesh", "brep"])
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("tilt", TILTS)
def test_the_same_lines_while_the_turn_moves_nothing(picture, kind, turn, tilt):
    x, z = math.sin(turn * tilt[0]), math.sin(turn * tilt[1])
    drawing = hlr.draw(MESH if kind == "mesh" else brep(), (x, -math.sqrt(1 - x * x - z * z), z), **AT_SIZE)
    agrees(drawing, by_oracle(drawing, *MESH, BOX_EDGES))
    used = drawing.accuracy.used
    if turn * 60 <= used / 2:
        assert sum(length(line) > used for line in drawing.lines) == 4
        assert all(line.visible for line in drawing.lines)
        assert not differences(expect(drawing, FRONT), ink(drawing), used)
    if kind == "mesh" and turn == 1e-6 and tilt == (1, 1):
        picture(drawing)


@pytest.mark.parametrize("turn", TURNS)
def test_a_direction_of_any_length_and_a_negative_zero(turn):
    for size in (1e-200, 1.0, 1e200):
        drawing = hlr.draw(MESH, (turn * size, -1.0 * size, -0.0), **AT_SIZE)
        assert {line.visible for line in drawing.lines} == {True} or turn > 1e-4
        agrees(drawing, by_oracle(drawing, *MESH, BOX_EDGES))


@pytest.mark.parametrize("turn", [1e-9, 1e-6, 1e-4])
def test_the_edges_that_point_at_the_viewer_are_not_drawn_as_dots(turn):
    drawing = hlr.draw(MESH, (turn, -1, turn), **AT_SIZE)
    assert len(drawing.lines) == 4
