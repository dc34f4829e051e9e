"""Types that all packages share: arrays, colours, progress callbacks."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Bools = npt.NDArray[np.bool_]
Color = tuple[float, float, float]
"""Red, green, blue as screens show them (sRGB); 0 to 1."""
Rgba = tuple[float, float, float, float]
"""The same, and opacity; 0 to 1."""
Progress = Callable[[str, float], None]
"""Called with the name of a stage and the fraction of it that is done, 0 to 1."""
