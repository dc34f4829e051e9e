"""Creases that go on below the crease angle: what they need, limit by limit, on a single row of edges."""

from __future__ import annotations

import numpy as np
import pytest

from hlr.scene.fading_creases import fading_edges
from support.meshes import mesh_facts

CREASE, INTERIOR = 0, 255


def followed(folds, beside=2.0, chosen=6, turn=0.0, part_of_gap=0, longer=1.0, crease_beside=False):
    """How many edges a row goes on: `chosen` creases of 40 degrees, then `folds`, then `part_of_gap` creases again.

    longer: how much longer than the others the edges of `folds` are; crease_beside: the edges beside are creases.

    To one side of the row lies a strip of triangles, beyond it a row of edges with the fold `beside`. `turn`: degrees
    from edge to edge.
    """
    row = [40.0] * chosen + list(folds) + [40.0] * part_of_gap
    along = np.radians(np.cumsum([turn] * len(row)))
    steps = np.stack([np.cos(along), np.sin(along), 0 * along], axis=1)
    steps[chosen : chosen + len(folds)] *= longer
    points = np.concatenate([[(0, 0, 0)], np.cumsum(steps, axis=0)])
    points = np.concatenate([points, points + (0, 0, 5)])
    n = len(row) + 1
    triangles = np.array([t for i in range(n - 1) for t in ((i, i + 1, n + i), (i + 1, n + i + 1, n + i))], np.int32)
    facts = mesh_facts(points, triangles)
    first, second = facts.edges.T
    fold = np.zeros(len(facts.edges))
    in_row, next_row = (second == first + 1) & (second < n), (second == first + 1) & (first >= n)
    fold[in_row] = row
    fold[next_row] = beside
    kind = np.full(len(fold), INTERIOR, np.uint8)
    crease = np.flatnonzero(in_row)
    kind[crease[:chosen]] = kind[crease[chosen + len(folds) :]] = CREASE
    kind[next_row & crease_beside] = CREASE
    found = fading_edges(kind, facts, triangles, np.cos(np.radians(fold)), points)
    assert found == crease[chosen : chosen + len(found)].tolist()
    return len(found)


def test_it_goes_on_while_it_stands_out():
    assert followed([28, 22, 16, 12, 8]) == 5
    assert followed([28, 22, 16, 12, 8], beside=5) == 4
    assert followed([28, 22, 16, 12, 8], beside=12) == 1


def test_it_does_not_go_on_in_a_facet_of_a_curved_face():
    assert followed([15, 15, 15]) == 0
    assert followed([25, 25, 25], beside=25) == 0


def test_creases_beside_it_count_as_facets_do():
    assert followed([28, 22, 16], beside=35, crease_beside=True) == 0


def test_an_edge_much_longer_than_the_last_is_no_part_of_a_gap():
    assert followed([2, 1, 2], chosen=90, part_of_gap=90, longer=2.5) == 3
    assert followed([2, 1, 2], chosen=90, part_of_gap=90, longer=3.5) == 0


def test_it_ends_where_hardly_a_fold_is_left():
    assert followed([22, 12, 7, 5, 3, 2], beside=0) == 4


@pytest.mark.parametrize(("turn", "edges"), [(10, 3), (20, 0)])
def test_it_goes_straight_on(turn, edges):
    assert followed([28, 22, 16], turn=turn) == edges


def test_short_creases_are_not_followed():
    assert followed([28, 22, 16], chosen=3) == 0


def test_a_short_gap_between_two_is_closed():
    assert followed([28, 2, 1, 2, 28], chosen=20, part_of_gap=20) == 5
    assert followed([2, 1, 2], chosen=20, part_of_gap=20) == 3
    assert followed([2, 1, 2], chosen=20, part_of_gap=10) == 0
    assert followed([0.5] * 12, chosen=90, part_of_gap=90) == 12
    assert followed([0.5] * 13, chosen=90, part_of_gap=90) == 0
