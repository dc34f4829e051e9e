"""Filled faces, under the lines of a drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.common.values import ByValue
from hlr.drawing.line import Points


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Gradient(ByValue):
    """Colours along a straight line on paper, the same across it.

    start, end  (2,) millimetres on paper, y up
    shares      (s,) of the way, ascending from 0 to 1
    colors      (s, 3) uint8 sRGB: the colour at each share
    """

    start: Points
    end: Points
    shares: Points
    colors: npt.NDArray[np.uint8]

    def __repr__(self) -> str:
        return f"<Gradient {len(self.shares)} colours>"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Fill(ByValue):
    """The visible areas of the faces, under the lines, in the order of painting.

    points     (n, 2) millimetres on paper, y up: corners of all loops
    loops      (l + 1,) int32: loop i has the points loops[i] to loops[i + 1] - 1
    faces      (f + 1,) int32: face i has the loops faces[i] to faces[i + 1] - 1, and is filled by the even-odd rule
    colors     (f, 4) uint8 sRGB and opacity
    gradient   (f,) int32 index into gradients, -1 where the colour is the same all over
    gradients  those that faces have
    part       (f,) int32 index into Drawing.parts
    spacing    millimetres on paper between the points at which visibility was sampled
    """

    points: Points
    loops: npt.NDArray[np.int32]
    faces: npt.NDArray[np.int32]
    colors: npt.NDArray[np.uint8]
    gradient: npt.NDArray[np.int32]
    gradients: tuple[Gradient, ...]
    part: npt.NDArray[np.int32]
    spacing: float

    def __repr__(self) -> str:
        return f"<Fill {len(self.part)} faces>"
