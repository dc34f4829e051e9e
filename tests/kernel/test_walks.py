"""Walks over mesh edges: what the kernel takes for them, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest

from hlr import _kernel


def ints(*values: int) -> np.ndarray:
    return np.array(values, np.int32)


def walks(**columns: np.ndarray) -> _kernel.Walks:
    """Two walks, along edges 0 and 1 and along edge 2, of parts 0 and 1; columns: what is different."""
    usual = {
        "offsets": ints(0, 2, 3),
        "edges": ints(0, 1, 2),
        "reversed": np.zeros(3, bool),
        "kind": np.zeros(2, np.uint8),
        "part": ints(0, 1),
    }
    return _kernel.Walks(**(usual | columns))


def test_what_is_not_said_is_none():
    found = walks()
    assert len(found) == 2 and found.bent() == 0
    for name in ("index", "other", "face", "curve"):
        assert getattr(found, name).tolist() == [-1, -1]
    assert found.straight.tolist() == [False, False]
    assert walks(index=ints(4, 5), straight=np.array([True, False])).bent() == 1


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"offsets": ints(0, 3)}, "offsets"),
        ({"offsets": ints(0, 2, 4)}, "offsets"),
        ({"offsets": ints(0, 0, 3)}, "offsets must ascend"),
        ({"reversed": np.zeros(2, bool)}, "reversed"),
        ({"part": ints(0)}, "part"),
        ({"index": ints(0)}, "index"),
        ({"straight": np.zeros(3, bool)}, "straight"),
        ({"curve": ints(0, 1, 2)}, "curve"),
    ],
)
def test_columns_that_do_not_fit_are_refused(columns, words):
    with pytest.raises(ValueError, match=words):
        walks(**columns)


def test_edges_that_the_mesh_does_not_have_are_refused():
    with pytest.raises(ValueError, match="edges of walks"):
        walks().moved(ints(0, 1), np.zeros(2, bool))
    with pytest.raises(ValueError, match="swapped"):
        walks().moved(ints(0, 1, 2), np.zeros(2, bool))


def test_walks_are_merged_by_part_and_moved_edge_by_edge():
    found = walks().merged(walks(part=ints(0, 2), index=ints(7, 8)))
    assert (found.part.tolist(), found.index.tolist()) == ([0, 0, 1, 2], [-1, 7, -1, 8])
    moved = found.moved(ints(5, -1, 4), np.array([True, False, False]))
    assert (moved.edges.tolist(), moved.reversed.tolist()) == ([5, 5, 4, 4], [True, True, False, False])
    assert moved.offsets.tolist() == [0, 1, 2, 3, 4]
