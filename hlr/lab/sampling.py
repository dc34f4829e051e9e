"""Points along lines: the one sampler of the lab, the benches and the tests.

A segment is a row (x0, y0, x1, y1), millimetres on paper. Neighbouring samples are at most `step` millimetres apart:

::

    with_ends     o----o----o----o     every end is a sample
    middles       --o----o----o---     each sample stands in the middle of its piece
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.chords import Index, numbered


@dataclass(frozen=True, slots=True)
class Samples:
    """Points (n, 2) along segments, the segment (n,) on which each lies, and its parameter (n,) there, 0 to 1.

    length, pieces (m,)   each segment's length in millimetres, and the number of pieces into which it was cut
    """

    points: Floats
    segment: Index
    share: Floats
    length: Floats
    pieces: Index


def with_ends(segments: Floats, step: float) -> Samples:
    """Sample every segment (m, 4) at its ends and between them, at most `step` apart."""
    length, pieces = _cut(segments, step)
    segment, number = numbered(pieces + 1)
    return _samples(segments, segment, number / pieces[segment], length, pieces)


def middles(segments: Floats, step: float) -> Samples:
    """Cut every segment (m, 4) into equal pieces of at most `step`, and sample the middle of each piece."""
    length, pieces = _cut(segments, step)
    segment, number = numbered(pieces)
    return _samples(segments, segment, (number + 0.5) / pieces[segment], length, pieces)


def line_middles(segments: Floats, line: Index, step: float) -> tuple[Floats, Index]:
    """Cut whole lines into equal pieces that may span corners: their middles (n, 2), and the line (n,) of each.

    line: (m,) the line of each segment (m, 4), ascending.
    """
    length = np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1])
    # The running length goes on over all lines; a line's own length counts from its start.
    ends = np.cumsum(length)
    last = np.flatnonzero(np.append(line[1:] != line[:-1], True)) if len(line) else np.zeros(0, np.int64)
    total = np.diff(np.append(0.0, ends[last]))
    pieces = np.maximum(np.ceil(total / step), 1.0).astype(np.int64)
    which, number = numbered(pieces)
    along = (ends[last] - total)[which] + (number + 0.5) * (total / pieces)[which]
    segment = np.minimum(np.searchsorted(ends, along), last[which])
    with np.errstate(all="ignore"):
        t = np.nan_to_num((along - (ends[segment] - length[segment])) / length[segment])[:, None]
    points = segments[segment, :2] * (1.0 - t) + segments[segment, 2:] * t
    return np.ascontiguousarray(points), line[last][which]


def polyline(points: Floats, step: float) -> Floats:
    """(m, d) a polyline's points (n, d), with points added so that neighbours are at most `step` apart."""
    way = np.diff(points, axis=0)
    pieces = np.maximum(np.ceil(np.linalg.norm(way, axis=1) / step), 1.0).astype(np.int64)
    segment, number = numbered(pieces)
    inner = points[segment] + ((number + 1) / pieces[segment])[:, None] * way[segment]
    return np.concatenate([points[:1], inner])


def _cut(segments: Floats, step: float) -> tuple[Floats, Index]:
    length = np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1])
    return length, np.maximum(np.ceil(length / step), 1.0).astype(np.int64)


def _samples(segments: Floats, segment: Index, share: Floats, length: Floats, pieces: Index) -> Samples:
    start, way = segments[:, :2], segments[:, 2:] - segments[:, :2]
    return Samples(start[segment] + way[segment] * share[:, None], segment, share, length, pieces)
