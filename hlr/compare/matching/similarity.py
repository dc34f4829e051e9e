"""Registration of drawings of different programs: by quarter turns, mirror, scale and translation.

Each of the eight ways to lay a sheet down is tried with a few scales, coarsely; the best ones are then matched like
drawings of one program. The scale is improved at the end, together with the shift.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace

import numpy as np

from hlr.compare.lines.motion import Motion
from hlr.compare.lines.pieces import Floats, Index, Pieces
from hlr.compare.lines.strays import without_strays
from hlr.compare.matching.match import Rule, divided_by, partners
from hlr.compare.matching.register import corners, several, thinned, translation
from hlr.compare.matching.scales import different, rectangle_scales, voted_scales

_FEW, _SOME, _MANY = 300, 1_200, 6_000
"""Pieces that are looked at: to choose what is tried, to choose among that, and at the end."""

_COARSE = 1.0 / 150.0
"""Share of the size within which lines lie on one another when what is tried is chosen."""

_TRIED = 6
_AS_GOOD = 0.85
"""How many are tried, of those that are nearly as good as the best."""

_ENOUGH = 0.995
"""Share of the length: nothing better will come."""

_FOUND = 0.9
"""Share of the length: the place need not be searched for. Less may be lines of one direction, which slide along.

A drawing that lies so mirrored or turned may be nearly symmetrical: as it lies is searched for then.
"""

_BETTER = 1.02
"""Another way to lay it down has to be that much better, or lay all on all: as it lies comes first."""

_SMALLEST = 10.0
"""Tolerances: a drawing that is not larger lies on everything."""

_FITTED = 0.1
"""Share of the scale by which fitting may change it."""

_UNLIKE = 1e-3
"""Weight of straight pieces beside a curve."""


@dataclass(frozen=True, slots=True)
class Registered:
    """A motion, and the share of the length of the moved lines that it lays on the others, 0 to 1."""

    motion: Motion
    share: float


def similarity(moving: Pieces, fixed: Pieces, tolerance_mm: float, scale: float | None = None) -> Registered:
    """How `moving` has to be turned, mirrored, scaled and moved, so that the most of its length lies on `fixed`.

    scale  where it is known; None: it is found
    """
    moving, fixed = without_strays(moving), without_strays(fixed)
    if min(moving.extent.max(), fixed.extent.max()) < _SMALLEST * tolerance_mm:
        return Registered(Motion(scale=scale or 1.0), 0.0)
    best = Registered(Motion(scale=scale or 1.0), -1.0)
    motions = _to_try(moving, fixed, tolerance_mm, scale)
    for search in (False, True):
        for motion in motions:
            shift, share = translation(moving.mapped(motion.matrix), fixed, tolerance_mm, _SOME, search)
            found = Registered(motion.with_shift(shift), share)
            if scale is None:
                found = _fitted(moving, fixed, found, tolerance_mm, _SOME)
            if found.share > best.share * _BETTER or found.share > _ENOUGH:
                best = found
            if best.share > _ENOUGH:
                break
        if best.share > (_FOUND if best.motion.upright else _ENOUGH):
            break
    return best if scale is not None else _fitted(moving, fixed, best, tolerance_mm, _MANY)


def _to_try(moving: Pieces, fixed: Pieces, tolerance_mm: float, scale: float | None) -> list[Motion]:
    """The motions that lay bounding rectangles on one another best, without shifts: as it lies, then the best first."""
    coarse = max(_COARSE * float(fixed.extent.max()), tolerance_mm)
    rule = Rule(coarse, coarse)
    found: list[tuple[float, Motion]] = []
    few = thinned(moving, _FEW)
    voted = [scale] if scale is not None else voted_scales(moving, fixed)
    for mirrored, turn in itertools.product((False, True), (0, 90, 180, 270)):
        turned = moving.mapped(Motion(mirrored, turn).matrix)
        for factor in [scale] if scale is not None else different([*voted, *rectangle_scales(turned, fixed)]):
            motion = Motion(mirrored, turn, factor)
            whole, some = moving.mapped(motion.matrix), few.mapped(motion.matrix)
            covered = max(
                _length(divided_by(some.shifted(guess), fixed, rule)[0])
                for guess in several(corners(whole, fixed), coarse)
            )
            found.append((covered / max(_length(some), 1e-12), motion))
    most = max(score for score, _ in found)

    def sure(motion: Motion) -> bool:
        """As it lies is tried anyway, at the scale of its lines: lines that one drawing has alone spoil rectangles."""
        return motion.upright and motion.scale in voted

    found = [each for each in found if each[0] >= _AS_GOOD * most or sure(each[1])]
    found.sort(key=lambda each: (not sure(each[1]), -round(each[0], 2)))
    return sorted((motion for _, motion in found[:_TRIED]), key=lambda motion: not motion.upright)


def _fitted(moving: Pieces, fixed: Pieces, start: Registered, tolerance_mm: float, most_pieces: int) -> Registered:
    """The scale and the shift, improved: lines are pulled across their direction onto those nearest to them."""
    some, motion = thinned(moving, most_pieces), start.motion
    reach = max(_COARSE * float(fixed.extent.max()), tolerance_mm)
    for _ in range(16):
        moved = motion.applied(some)
        near, _off = partners(moved, fixed, Rule(reach, tolerance_mm))
        which = np.flatnonzero(near >= 0)
        if len(which) < 3:
            return start
        scale, shift = _step(moved, fixed, which, near[which], reach)
        larger = replace(motion, scale=motion.scale * scale)
        motion = larger.with_shift(scale * np.array(motion.shift) + shift)
        if reach <= tolerance_mm and abs(scale - 1.0) < 1e-7 and float(np.hypot(*shift)) < 1e-5:
            break
        reach = max(0.5 * reach, tolerance_mm)
    if abs(motion.scale / start.motion.scale - 1.0) > _FITTED:
        return start  # small enough, a drawing lies on any line
    moved = motion.applied(thinned(moving, _SOME))
    share = covered_share(moved, fixed, tolerance_mm)
    return Registered(motion, share) if share >= start.share else start


def _step(moved: Pieces, fixed: Pieces, which: Index, near: Index, reach: float) -> tuple[float, Floats]:
    """The scale and the shift that lay each piece best on the line of its partner."""
    way = fixed.end[near] - fixed.start[near]
    normal = np.stack([-way[:, 1], way[:, 0]], axis=1) / np.hypot(*way.T)[:, None]
    middle = 0.5 * (moved.start[which] + moved.end[which])
    off = ((fixed.start[near] - middle) * normal).sum(axis=1)
    # Straight pieces lie inside the curve that they stand for: they would make the drawing larger.
    alike = np.where(moved.curved[which] == fixed.curved[near], 1.0, _UNLIKE)
    weight = alike * moved.lengths[which] / (1.0 + (off / (0.3 * reach)) ** 2) ** 2
    about = (middle * weight[:, None]).sum(axis=0) / weight.sum()
    rows = np.column_stack([((middle - about) * normal).sum(axis=1), normal])
    grow, x, y = np.linalg.pinv((rows * weight[:, None]).T @ rows, rcond=1e-12) @ (rows * (weight * off)[:, None]).sum(
        axis=0
    )
    scale = 1.0 + float(np.clip(grow, -0.5, 0.5))
    return scale, np.array([x, y]) + (1.0 - scale) * about


def covered_share(moved: Pieces, fixed: Pieces, tolerance_mm: float) -> float:
    """How much of the length lies on the others, 0 to 1; half of it counts only within a tenth of the tolerance."""
    close = [divided_by(moved, fixed, Rule(share * tolerance_mm, tolerance_mm))[0] for share in (1.0, 0.1)]
    return sum(map(_length, close)) / max(2.0 * _length(moved), 1e-12)


def laid_share(one: Pieces, other: Pieces, tolerance_mm: float) -> float:
    """How much of the length of both lies on the other, 0 to 1. Lines to nowhere do not count."""
    one, other = without_strays(one), without_strays(other)
    lengths = _length(one), _length(other)
    shares = [covered_share(thinned(some, _MANY), rest, tolerance_mm) for some, rest in ((one, other), (other, one))]
    return float(np.dot(shares, lengths)) / max(sum(lengths), 1e-12)


def _length(pieces: Pieces) -> float:
    return float(pieces.lengths.sum())
