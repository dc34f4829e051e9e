"""What several tests of sources ask of a part."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hlr.source.model import PartMesh

DATA = Path(__file__).parents[1] / "data"


@pytest.fixture
def data() -> Path:
    return DATA


@pytest.fixture
def gaps() -> Callable[[PartMesh], int]:
    """How many directed mesh edges lack their one opposite: 0 for a closed, oriented, conforming mesh."""

    def count(part: PartMesh) -> int:
        t = part.triangles.astype(np.int64)
        directed = np.concatenate((t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]))
        key = directed[:, 0] << 32 | directed[:, 1]
        opposite = directed[:, 1] << 32 | directed[:, 0]
        unique, counts = np.unique(key, return_counts=True)
        single = unique[counts == 1]
        return int(len(key) - np.isin(single, opposite[np.isin(opposite, single)]).sum())

    return count


@pytest.fixture
def volume() -> Callable[[PartMesh], float]:
    """Signed volume: positive where triangles are counter-clockwise seen from outside."""

    def measure(part: PartMesh) -> float:
        a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
        return float((a * np.cross(b, c)).sum() / 6)

    return measure


@pytest.fixture
def classes() -> Callable[[Any], list[int]]:
    """How many edges are sharp, smooth, seam and boundary."""

    def count(part: PartMesh) -> list[int]:
        return np.bincount(part.edge_class, minlength=4).tolist()

    return count
