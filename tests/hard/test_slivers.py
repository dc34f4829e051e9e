"""Triangles a million times longer than wide: their planes are known badly, and their normals worse.

Snapped to any grid a sliver tilts; a test of each triangle by its own plane then lets lines through in needles, and
creases appear in flat faces.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, expect
from support.meshes import as_parts, box, box_lines, grid, moved, ring, rotation

WIDTH = 1e-4
"""Of a strip 100 long."""
YS = np.unique(np.concatenate([[0, 20], *[y + WIDTH * np.arange(4) for y in (3, 8, 9.9999, 15)]]))


def plate():
    """0..100 x 0..20 in the plane z = 0, of strips of which most are slivers."""
    return grid(np.array([[(x, y, 0.0) for y in YS] for x in (0.0, 100.0)]))


CORNERS = [(0, 0, 0), (100, 0, 0), (100, 20, 0), (0, 20, 0)]
TURNS = [np.eye(3), rotation((1, 2, 3), 0.7), rotation((3, -1, 1), 2.0)]


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("toward", [(0, 0, 1), (0.3, -0.5, 1), (0.9, 0.1, 0.2)])
def test_a_plate_of_slivers_hides_what_lies_behind_and_has_no_creases(picture, turn, toward):
    low, high = (10, 6, -9), (60, 16, -5)
    model = as_parts(*(moved(m, lambda p: p @ turn.T) for m in (plate(), box(low, high))))
    drawing = hlr.draw(model, tuple(turn @ toward), up=tuple(turn @ (0, 1, 0)), **AT_SIZE)
    sides = [tuple(turn @ p for p in side) for side in ring(CORNERS)]
    lines = [tuple(turn @ p for p in line) for line in box_lines(low, high)]
    if toward == (0.9, 0.1, 0.2):
        # So flat that the block is seen beside the plate; only that nothing of the plate but its sides is drawn.
        plates = [line for line in drawing.lines if line.part == 0]
        assert all(line.kind == "boundary" for line in plates)
        return
    agrees(drawing, expect(drawing, sides, lines))
    if turn is TURNS[0] and toward == (0.3, -0.5, 1):
        picture(drawing)


@pytest.mark.parametrize("turn", TURNS)
def test_a_single_sliver_is_a_line(turn):
    points = np.array([(0, 0, 0), (100, 0, 0), (50, WIDTH, 0.0)]) @ turn.T
    drawing = hlr.draw((points, [[0, 1, 2]]), tuple(turn @ (0, 0.1, 1)), **AT_SIZE)
    agrees(drawing, expect(drawing, [(points[0], points[1])]))


@pytest.mark.parametrize("count", [10, 1000])
def test_a_fan_of_slivers(count):
    # All needles share a corner; the last one is as wide as all others together.
    xs = np.append(np.linspace(0, 0.5, count), 1.0) * 100
    points = np.concatenate([[(0, 50, 0)], np.stack([xs, 0 * xs, 0 * xs], axis=1)])
    fan = (points, np.array([[0, i, i + 1] for i in range(1, len(points) - 1)]))
    low, high = (5, 5, -9), (30, 12, -5)
    drawing = hlr.draw(as_parts(fan, box(low, high)), "top", **AT_SIZE)
    agrees(
        drawing,
        expect(drawing, ring([(0, 50, 0), (0, 0, 0), (100, 0, 0)]), box_lines(low, high)),
    )
