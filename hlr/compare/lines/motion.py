"""How a drawing lies beside another: turned by quarters, mirrored, scaled, moved."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hlr.compare.lines.pieces import Floats, Pieces

_QUARTERS = {
    0: ((1.0, 0.0), (0.0, 1.0)),
    90: ((0.0, -1.0), (1.0, 0.0)),
    180: ((-1.0, 0.0), (0.0, -1.0)),
    270: ((0.0, 1.0), (-1.0, 0.0)),
}

_NO_SCALE = 1e-4
"""A drawing that is larger by less is as large: files state six digits, and have pieces for curves."""


@dataclass(frozen=True, slots=True)
class Motion:
    """What is done to a drawing to lay it on another, in this order.

    mirrored  left and right are exchanged
    turn      degrees, counter-clockwise: 0, 90, 180 or 270
    scale     how many times as large it becomes
    shift     (x, y) millimetres
    """

    mirrored: bool = False
    turn: int = 0
    scale: float = 1.0
    shift: tuple[float, float] = (0.0, 0.0)

    @property
    def matrix(self) -> Floats:
        """(2, 2) what a point becomes before it is shifted: matrix @ point."""
        return self.scale * np.array(_QUARTERS[self.turn]) @ np.diag([-1.0 if self.mirrored else 1.0, 1.0])

    def applied(self, pieces: Pieces) -> Pieces:
        """Lines, laid down so."""
        return pieces.mapped(self.matrix).shifted(np.array(self.shift))

    def with_shift(self, shift: Floats) -> Motion:
        """The same motion to another place, (2,) millimetres."""
        x, y = shift.tolist()
        return replace(self, shift=(x, y))

    @property
    def upright(self) -> bool:
        """Whether it stays as it lies, neither mirrored nor turned."""
        return not self.mirrored and self.turn == 0

    @property
    def scales(self) -> bool:
        """Whether the size changes."""
        return abs(self.scale - 1.0) > _NO_SCALE

    def words(self) -> list[str]:
        """What is done, for people: ["mirrored", "turned by 90 degrees"]; a shift is not among them."""
        found = ["mirrored"] if self.mirrored else []
        if self.turn:
            found.append(f"turned by {self.turn} degrees")
        if self.scales:
            found.append(f"scaled by {self.scale:.6g}")
        return found

    def as_dict(self) -> dict[str, Any]:
        """The fields, for JSON."""
        return {"mirrored": self.mirrored, "turn": self.turn, "scale": self.scale, "shift": list(self.shift)}
