"""The drawing's visible lines as straight pieces in pixels."""

from __future__ import annotations

import math

import numpy as np

from hlr._kernel import Lens
from hlr.common.colors import is_dark
from hlr.drawing.curve import Arc, Bezier, raised
from hlr.drawing.line import Line, Points

FLATNESS = 0.02
"""Pixels: how far a chord may be off its curve."""


def pieces(lines: list[Line], origin: tuple[float, float], per_mm: float, centre: tuple[float, float]) -> Points:
    """(n, 4) x0 y0 x1 y1 in pixels, y down; origin: `Drawing.origin`; centre: of the picture's lens, in pixels."""
    found = []
    for line in lines:
        flat = flattened(line, per_mm)
        x = (flat[:, 0] + origin[0]) * per_mm + centre[0]
        y = centre[1] - (flat[:, 1] + origin[1]) * per_mm
        at = np.stack([x, y], axis=1)
        found.append(np.concatenate([at[:-1], at[1:]], axis=1))
    return np.ascontiguousarray(np.concatenate([np.zeros((0, 4)), *found]))


CUES = 24
"""Inks between near and far."""

PALEST = 0.22
"""Share of its ink that the farthest line has."""


def ink_on(background: tuple[int, ...]) -> tuple[int, int, int, int]:
    """The ink of lines without faces: black, or white where the background is dark; black where it is transparent."""
    ink = 255 if is_dark(_ground(background)) else 0
    return (ink, ink, ink, 255)


def _ground(background: tuple[int, ...]) -> tuple[int, ...]:
    return background[:3] if background[3] == 255 else (255, 255, 255)


def cues(background: tuple[int, ...]) -> list[tuple[int, int, int, int]]:
    """Inks from far to near, opaque: that of `ink_on`, which fades toward the background."""
    ground, ink = _ground(background), ink_on(background)[0]
    shares = [PALEST + (1.0 - PALEST) * k / (CUES - 1) for k in range(CUES)]
    r, g, b = ([round(share * ink + (1.0 - share) * c) for share in shares] for c in ground)
    return [(r[k], g[k], b[k], 255) for k in range(CUES)]


def pieces_by_depth(
    lines: list[Line], origin: tuple[float, float], per_mm: float, eye: Lens, levels: int
) -> list[Points]:
    """The pieces in `levels` lists, from far to near; each is divided where it passes from one level to the next."""
    centre, ahead, at_eye = eye.centre, np.array(eye.ahead), np.array(eye.origin)
    found, depths = [], []
    for line in lines:
        x = (line.points[:, 0] + origin[0]) * per_mm + centre[0]
        y = centre[1] - (line.points[:, 1] + origin[1]) * per_mm
        at = np.stack([x, y], axis=1)
        depth = (line.points3 - at_eye) @ ahead
        found.append(np.concatenate([at[:-1], at[1:]], axis=1))
        depths.append(np.stack([depth[:-1], depth[1:]], axis=1))
    if not found:
        return [np.zeros((0, 4))] * levels
    piece, depth = np.concatenate(found), np.concatenate(depths)
    low, high = float(depth.min()), float(depth.max())
    nearness = (high - depth) / (high - low if high > low else 1.0) * levels
    count = np.floor(np.abs(nearness[:, 1] - nearness[:, 0])).astype(np.int64) + 1
    which = np.repeat(np.arange(len(count)), count)
    within = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    start, end = within / count[which], (within + 1) / count[which]
    way = piece[which, 2:] - piece[which, :2]
    cut = np.concatenate([piece[which, :2] + start[:, None] * way, piece[which, :2] + end[:, None] * way], axis=1)
    middle = nearness[which, 0] + 0.5 * (start + end) * (nearness[which, 1] - nearness[which, 0])
    level = np.clip(middle.astype(np.int64), 0, levels - 1)
    return [np.ascontiguousarray(cut[level == k]) for k in range(levels)]


def flattened(line: Line, per_mm: float) -> Points:
    """(n, 2) millimetres along a line's true curve, with chords that are off it by FLATNESS at most."""
    if isinstance(line.curve, Arc):
        turn = float(line.curve.angles[1] - line.curve.angles[0])
        reach = max(line.curve.radii) * per_mm
        # The sagitta of a chord over the angle a is r (1 - cos a/2), about r a^2 / 8.
        count = max(2, math.ceil(abs(turn) * math.sqrt(reach / (8.0 * FLATNESS))) + 1)
        return line.curve.at(line.curve.angles[0] + turn * np.arange(count) / (count - 1))
    if isinstance(line.curve, Bezier):
        return _chain(line.curve, per_mm)
    return line.points


def _chain(curve: Bezier, per_mm: float) -> Points:
    chain = curve if curve.degree == 3 else raised(curve)
    p = chain.points
    a, b, c, d = p[:-1:3], p[1::3], p[2::3], p[3::3]
    # A cubic is off its n chords by at most |second differences| * 6 / (8 n^2) (Wang's formula).
    second = np.maximum(np.abs(a - 2.0 * b + c).max(axis=1), np.abs(b - 2.0 * c + d).max(axis=1)) * math.sqrt(2.0)
    count = np.maximum(1, np.ceil(np.sqrt(0.75 * second * per_mm / FLATNESS))).astype(np.int64)
    first = np.cumsum(count) - count
    within = (np.arange(count.sum()) - np.repeat(first, count)) / np.repeat(count, count)
    piece = np.repeat(np.arange(len(count)), count)
    return chain.at(np.append(piece + within, float(len(count))))
