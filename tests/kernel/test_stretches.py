"""Stretches of edges whose own faces are seen nearly edge-on, as arrays hand them over."""

from __future__ import annotations

import numpy as np
import pytest

from hlr import _kernel

COLUMNS = {
    "edge": np.array([1, 1, 3], np.int32),
    "range": np.array([[0.0, 0.5], [0.5, 1.0], [0.0, 1.0]]),
    "line": np.array([4, 5, 3], np.int32),
    "beside": np.zeros(3, np.uint8),
    "dented": np.zeros(3, bool),
    "offsets": np.array([0, 1, 2, 4], np.int32),
    "face": np.array([0, 0, 1, 2], np.int32),
    "off": np.array([6, 7, 8, 9], np.int32),
    "sheet": np.array([0, 1, 1], np.int32),
}


def test_an_edge_that_is_cut_takes_all_its_stretches_with_it():
    stretches = _kernel.Stretches(**COLUMNS)
    target = np.arange(10, dtype=np.int32)
    assert len(stretches) == len(stretches.renumbered(target)) == 3
    target[5] = -1
    assert len(stretches.renumbered(target)) == 1


@pytest.mark.parametrize(
    ("name", "wrong", "said"),
    [
        ("edge", [3, 1, 1], "edge"),
        ("range", [[0.0, 1.0]], "range"),
        ("line", [4, 5], "line"),
        ("offsets", [0, 1, 2], "offsets"),
        ("offsets", [0, 2, 1, 4], "offsets"),
        ("off", [6, 7, 8], "off"),
        ("face", [0, 0, 1, 3], "face"),
        ("sheet", [0, 1, 3], "sheet"),
    ],
)
def test_columns_that_do_not_fit_are_refused(name, wrong, said):
    with pytest.raises(ValueError, match=said):
        _kernel.Stretches(**{**COLUMNS, name: np.array(wrong, COLUMNS[name].dtype)})


def test_edges_that_are_not_there_are_refused():
    with pytest.raises(ValueError, match="own edge"):
        _kernel.Stretches(**COLUMNS).renumbered(np.arange(9, dtype=np.int32))
