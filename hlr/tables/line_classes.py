"""Line classes: why a line is drawn."""

from __future__ import annotations

from enum import IntEnum


class EdgeClass(IntEnum):
    """Why an edge is drawn; the names are those of the exchange format."""

    SHARP = 0
    SMOOTH = 1
    SEAM = 2
    BOUNDARY = 3
    OUTLINE = 4
    INTERSECTION = 5
