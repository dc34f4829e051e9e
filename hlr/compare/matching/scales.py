"""How many times as large one drawing is as another: guesses, before anything is known of how they lie."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hlr.compare.lines.pieces import Floats, Pieces

_LARGEST = 1e4
"""Scale."""

_SAME = 2e-3
"""Guesses that differ by less are one."""

_SHORTEST = 1e-3
"""Of the longest line: shorter ones do not vote."""

_DIFFERENT = 1.0 / 500.0
"""Lengths of lines that differ by less, as a share, vote once: a row of holes has no more to say than one of them."""

_BIN = 1.0 / 250.0
"""Width of a bin of votes, as a share."""

_MOST_LENGTHS = 1_500
"""Lengths that vote, the longest ones."""


def rectangle_scales(moving: Pieces, fixed: Pieces) -> list[float]:
    """As large as it is, and as large as the other by width, by height and by the length of all lines."""
    pairs = zip(moving.extent, fixed.extent, strict=True)
    wide = [float(other / one) for one, other in pairs if min(one, other) > 1e-9]
    return different([1.0, *wide, float(fixed.lengths.sum()) / max(float(moving.lengths.sum()), 1e-12)])


def voted_scales(moving: Pieces, fixed: Pieces) -> list[float]:
    """The ratio of lengths that the most pairs of lines have; empty where there is none.

    One drawing may have lines that the other has not, and is then wider or higher at the same scale: rectangles say
    nothing there.
    """
    logs = [_lengths(each) for each in (moving, fixed)]
    if not all(map(len, logs)):
        return []
    ratios = np.sort((logs[1][:, None] - logs[0]).ravel())
    votes = np.searchsorted(ratios, ratios + 2.0 * _BIN) - np.arange(len(ratios))
    best = int(votes.argmax())
    return different([float(np.exp(np.median(ratios[best : best + int(votes[best])])))])


def _lengths(pieces: Pieces) -> Floats:
    """The logarithms of the lengths of lines that are not nearly the same."""
    if not len(pieces):
        return np.zeros(0)
    first = np.flatnonzero(np.diff(pieces.number_of_line, prepend=-1))
    lengths = np.add.reduceat(pieces.lengths, first)
    logs = np.log(lengths[lengths > _SHORTEST * lengths.max()])
    return np.asarray(np.unique(np.round(logs / _DIFFERENT))[-_MOST_LENGTHS:] * _DIFFERENT)


def different(scales: Iterable[float]) -> list[float]:
    """Those that can be, each once."""
    found: list[float] = []
    for scale in scales:
        if 1.0 / _LARGEST < scale < _LARGEST and all(abs(scale / other - 1.0) > _SAME for other in found):
            found.append(scale)
    return found
