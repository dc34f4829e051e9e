"""Which pieces of two sets lie near one another: a grid of square cells, in NumPy."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hlr.compare.lines.pieces import Floats, Index, Pieces
from hlr.drawing.chords import numbered
from hlr.errors import OptionError

MOST_PAIRS = 2_000_000_000
"""Of pieces in neighbouring cells: some minutes. More have only lines that lie on one another by the thousand."""

_AT_ONCE = 1 << 20
"""Pairs in one batch."""


def pairs(a: Pieces, b: Pieces, reach_mm: float) -> Iterator[tuple[Index, Index]]:
    """Batches of pairs (i of a, j of b): all whose distance is at most `reach_mm`, and others.

    Raises OptionError where there are more than can be looked at.
    """
    if not len(a) or not len(b):
        return
    cell = float(max(a.lengths.max(), b.lengths.max())) + reach_mm
    low = np.minimum(a.start.min(axis=0), b.start.min(axis=0))
    in_a, in_b = (np.floor((_middles(each) - low) / cell).astype(np.int64) + 2 for each in (a, b))
    width = int(max(in_a[:, 1].max(), in_b[:, 1].max())) + 3
    of_b = in_b[:, 0] * width + in_b[:, 1]
    order = np.argsort(of_b, kind="stable")
    keys = of_b[order]
    # Cells in a column follow one another: three columns are three searches.
    ranges = []
    for column in (-1, 0, 1):
        key = (in_a[:, 0] + column) * width + in_a[:, 1]
        ranges.append((np.searchsorted(keys, key - 1, "left"), np.searchsorted(keys, key + 1, "right")))
    total = sum(int((last - first).sum()) for first, last in ranges)
    if total > MOST_PAIRS:
        raise OptionError(
            f"too many lines lie on top of one another to be compared ({total:,} pairs): draw fewer, or larger"
        )
    for first, last in ranges:
        yield from _batches(first, last - first, order)


def _batches(first: Index, count: Index, order: Index) -> Iterator[tuple[Index, Index]]:
    """The pairs of each piece i with order[first[i] : first[i] + count[i]]."""
    ends = np.cumsum(count)
    begin = 0
    while begin < len(count):
        done = ends[begin - 1] if begin else 0
        end = max(int(np.searchsorted(ends, done + _AT_ONCE, "right")), begin + 1)
        whose, number = numbered(count[begin:end])
        if len(whose):
            yield whose + begin, order[first[begin:end][whose] + number]
        begin = end


def _middles(pieces: Pieces) -> Floats:
    return 0.5 * (pieces.start + pieces.end)
