"""Registration: how one drawing has to be moved to lie on another, found from the lines themselves."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

import numpy as np

from hlr.compare.lines.pieces import Floats, Pieces
from hlr.compare.matching.match import Rule, divided_by, partners

_CELLS = 512
"""Of the picture in which both are first laid on one another, along its longer side."""

_PEAKS = 6
"""Places in that picture that are tried."""

_ALL = 0.9999
"""Share of the length that is matched as closely as can be: nothing better will come."""

_MOST_FITTED = 6_000
"""Pieces that are moved to find the shift; the whole drawing is matched with it later."""


def translation(
    moving: Pieces, fixed: Pieces, tolerance_mm: float, most_pieces: int = _MOST_FITTED, search: bool = True
) -> tuple[Floats, float]:
    """(2,) millimetres by which `moving` has to be moved, so that the most of its length lies on `fixed`, and how much.

    most_pieces  of `moving` that are looked at
    search       whether other places are tried than those where corners and middles lie on one another
    """
    if not len(moving) or not len(fixed):
        return np.zeros(2), 0.0
    cell = max(
        float(np.ptp(np.concatenate([points_of(moving), points_of(fixed)]), axis=0).max()) / _CELLS, tolerance_mm
    )
    few, other = thinned(moving, most_pieces), fixed
    best, most, whole = np.zeros(2), -1.0, 2.0 * float(few.lengths.sum())
    for guess in chain(several(corners(moving, fixed), tolerance_mm), _peaks(moving, fixed) if search else ()):
        if most > _ALL * whole:
            break
        for shift in (guess, _fitted(few, other, guess, cell, tolerance_mm)):
            matched = _matched(few, other, shift, tolerance_mm)
            if matched > most * (1.0 + 1e-9) + 1e-6:
                best, most = shift, matched
    best = _fitted(few, other, best, tolerance_mm, tolerance_mm) if most > 0.0 else best
    return best, max(most, 0.0) / whole


def several(guesses: list[Floats], tolerance_mm: float) -> list[Floats]:
    """Those that are not nearly the same as one before them: fitting finds the rest."""
    found: list[Floats] = []
    for guess in guesses:
        if all(np.hypot(*(guess - other)) > tolerance_mm for other in found):
            found.append(guess)
    return found


def points_of(pieces: Pieces) -> Floats:
    """(2 n, 2) the ends of all pieces."""
    return np.concatenate([pieces.start, pieces.end])


def thinned(pieces: Pieces, most: int) -> Pieces:
    """At most so many of the pieces, evenly."""
    return pieces.take(slice(None, None, max(-(-len(pieces) // most), 1)))


def corners(moving: Pieces, fixed: Pieces) -> list[Floats]:
    """No shift, and those that lay corners and middles of the bounding rectangles on one another."""
    a, b = points_of(moving), points_of(fixed)
    low, high = b.min(axis=0) - a.min(axis=0), b.max(axis=0) - a.max(axis=0)
    return [np.zeros(2), low, high, 0.5 * (low + high), np.array([low[0], high[1]]), np.array([high[0], low[1]])]


def _peaks(moving: Pieces, fixed: Pieces) -> Iterator[Floats]:
    """Shifts at which pictures of both correlate best. A cell holds the length in it, with its direction as a phase."""
    a, b = points_of(moving), points_of(fixed)
    low_a, low_b = a.min(axis=0), b.min(axis=0)
    size = np.maximum(np.ptp(a, axis=0), np.ptp(b, axis=0))
    cell = max(float(size.max()) / _CELLS, 1e-3)
    shape = tuple(_quick(int(np.ceil(2.0 * side / cell + 4.0))) for side in size)
    one, two = (np.fft.fft2(_picture(each, low, cell, shape)) for each, low in ((moving, low_a), (fixed, low_b)))
    score = np.fft.ifft2(two * np.conj(one)).real
    for _ in range(_PEAKS):
        peak = np.array(np.unravel_index(int(np.argmax(score)), shape))
        step = np.where(peak > np.array(shape) // 2, peak - np.array(shape), peak)
        yield step * cell + low_b - low_a
        near = [np.arange(at - 2, at + 3) % length for at, length in zip(peak, shape, strict=True)]
        score[np.ix_(*near)] = -np.inf


def _quick(length: int) -> int:
    """The next length that a Fourier transform is quick at: a few times a power of two, at most an eighth longer."""
    step = 1 << max((length - 1).bit_length() - 4, 0)
    return -(-length // step) * step


def _picture(pieces: Pieces, low: Floats, cell: float, shape: tuple[int, ...]) -> Floats:
    out = np.zeros(shape, complex)
    pieces = pieces.divided(max(cell, float(pieces.lengths.sum()) / 2_000_000))
    at = np.floor((0.5 * (pieces.start + pieces.end) - low) / cell).astype(np.int64) + 1
    way = (pieces.end - pieces.start).astype(float)
    turned = (way[:, 0] + 1j * way[:, 1]) ** 2 / np.maximum(pieces.lengths, 1e-12)
    np.add.at(out, (at[:, 0], at[:, 1]), turned)
    return out


def _fitted(moving: Pieces, fixed: Pieces, shift: Floats, reach: float, tolerance_mm: float) -> Floats:
    """The shift, improved: the lines are pulled across their direction onto those nearest to them."""
    for _ in range(12):
        reach = max(reach, tolerance_mm)
        moved = moving.shifted(shift)
        near, _off = partners(moved, fixed, Rule(reach, tolerance_mm))
        which = np.flatnonzero(near >= 0)
        if not len(which):
            return shift
        j = near[which]
        way = fixed.end[j] - fixed.start[j]
        normal = np.stack([-way[:, 1], way[:, 0]], axis=1) / np.hypot(*way.T)[:, None]
        middle = 0.5 * (moved.start[which] + moved.end[which])
        off = ((fixed.start[j] - middle) * normal).sum(axis=1)
        # Lines that belong to nothing pull less.
        weight = moved.lengths[which] / (1.0 + (off / (0.3 * reach)) ** 2) ** 2
        square = (normal * weight[:, None]).T @ normal
        step = np.linalg.pinv(square, rcond=1e-6) @ (normal * (weight * off)[:, None]).sum(axis=0)
        shift = shift + step
        if np.hypot(*step) < 1e-5 and reach <= tolerance_mm:
            break
        reach *= 0.5
    return shift


def _matched(moving: Pieces, fixed: Pieces, shift: Floats, tolerance_mm: float) -> float:
    """Millimetres of the moved lines that lie on the others, the better the closer: a tenth of the tolerance counts."""
    moved = moving.shifted(shift)
    close = [divided_by(moved, fixed, Rule(share * tolerance_mm, tolerance_mm))[0] for share in (1.0, 0.1)]
    return sum(float(each.lengths.sum()) for each in close)
