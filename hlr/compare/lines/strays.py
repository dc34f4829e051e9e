"""Lines that run far away from all others: they say nothing of the size of a drawing."""

from __future__ import annotations

import numpy as np

from hlr.compare.lines.pieces import Pieces

_MOST = 90.0
"""Percent of the lines that are where the drawing is."""

_FAR = 20.0
"""Times the reach of those: what goes on farther is a stray."""


def without_strays(pieces: Pieces) -> Pieces:
    """The pieces of all lines that stay near the others.

    FreeCAD draws an arc of 20 metres beside a part of 300 millimetres, for one.
    """
    if not len(pieces):
        return pieces
    line = pieces.number_of_line
    first = np.flatnonzero(np.diff(line, prepend=-1))
    centre = np.median(pieces.start[first], axis=0)
    away = np.maximum(np.hypot(*(pieces.start - centre).T), np.hypot(*(pieces.end - centre).T))
    reach = np.zeros(int(line[-1]) + 1)
    np.maximum.at(reach, line, away)
    near = reach <= _FAR * float(np.percentile(reach, _MOST))
    return pieces.take(near[line])
