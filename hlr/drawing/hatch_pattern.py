"""Patterns of hatches: parallel lines, or tiles of strokes."""

from __future__ import annotations

from dataclasses import dataclass

from hlr.common.types import Floats


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """Parallel lines. Millimetres, y up.

    origin, direction, offset (2,): of one line, along it, and to the next one; dashes: lengths, gaps below zero
    """

    origin: Floats
    direction: Floats
    offset: Floats
    dashes: tuple[float, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Tiles:
    """Strokes that are repeated. strokes (n, 2, 2): ends, mm, y up; steps (2, 2): to the next tile, right and up."""

    strokes: Floats
    steps: Floats
