"""How large a model may be."""

from __future__ import annotations

import numpy as np

from hlr.errors import SourceError
from hlr.source.model import Floats

LARGEST = 1e60
"""Model units. Products of five coordinates are still numbers; no true model comes near."""


def checked(name: str, bounds: Floats) -> Floats:
    """The bounds (2, 3), if they can be calculated with.

    Raises:
        SourceError: a coordinate is beyond LARGEST, or is no number.
    """
    if not (np.abs(bounds) < LARGEST).all():  # also where one is NaN
        raise SourceError(f"{name} has no finite size, or coordinates beyond {LARGEST:g}: repair the model.")
    return bounds
