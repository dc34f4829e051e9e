"""The distinct values of an array."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

Number = TypeVar("Number", bound=np.generic)


def distinct(values: npt.NDArray[Number]) -> npt.NDArray[Number]:
    """The different values of an array of any shape, ascending, as (n,).

    `np.unique` does the same, but loads NumPy's masked arrays, which takes longer than many drawings.
    """
    ordered: npt.NDArray[Any] = np.sort(values, axis=None)
    first = np.ones(len(ordered), bool)
    first[1:] = ordered[1:] != ordered[:-1]
    return np.asarray(ordered[first])
