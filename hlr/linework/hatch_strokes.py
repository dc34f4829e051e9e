"""The strokes of a hatch within a box, and what of them lies inside a face."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats
from hlr.drawing.hatch_pattern import Row, Tiles

Numbers = npt.NDArray[np.int64]

MOST_STROKES = 100_000
"""Of one section."""

CROSSINGS = 1_000_000
"""Strokes times sides that are looked at together: bounds the memory."""


def strokes_within(pattern: tuple[Row, ...] | Tiles, low: Floats, high: Floats) -> Floats | None:
    """The strokes (n, 2, 2) of a pattern that may reach into the box from low to high (2,), in its own coordinates.

    None: there would be more than MOST_STROKES.
    """
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [low[0], high[1]], [high[0], high[1]]])
    if isinstance(pattern, Tiles):
        return _tiled(pattern, corners)
    rows = [_ruled(row, corners) for row in pattern]
    if any(row is None for row in rows):
        return None
    strokes = np.concatenate([row for row in rows if row is not None])
    return strokes if len(strokes) <= MOST_STROKES else None


def _ruled(row: Row, corners: Floats) -> Floats | None:
    across = np.array([-row.direction[1], row.direction[0]])
    spacing = float(row.offset @ across)
    heights = (corners - row.origin) @ across / spacing
    first, last = math.ceil(float(heights.min())), math.floor(float(heights.max()))
    if last - first >= MOST_STROKES:
        return None
    numbers = np.arange(first, last + 1, dtype=np.float64)
    starts = row.origin + numbers[:, None] * row.offset
    along = (corners - row.origin) @ row.direction
    skipped = (starts - row.origin) @ row.direction
    low, high = float(along.min()) - skipped, float(along.max()) - skipped
    if not row.dashes:
        spans = np.stack([low, high], axis=1)
        return np.asarray(starts[:, None] + spans[..., None] * row.direction)
    ends = np.cumsum(np.abs(row.dashes))
    period = float(ends[-1])
    if period <= 0.0 or float((high - low).sum()) / period * len(ends) > MOST_STROKES:
        return None
    dashes = [(end - abs(length), end) for end, length in zip(ends.tolist(), row.dashes, strict=True) if length >= 0.0]
    parts = [np.zeros((0, 2, 2))]
    for start, a, b in zip(starts, low.tolist(), high.tolist(), strict=True):
        turns = np.arange(math.floor(a / period), math.ceil(b / period)) * period
        spans = (turns[:, None, None] + np.array(dashes)).reshape(-1, 2)
        parts.append(start + spans[..., None] * row.direction)
    return np.concatenate(parts)


def _tiled(tiles: Tiles, corners: Floats) -> Floats | None:
    numbers = np.linalg.solve(tiles.steps.T, corners.T).T
    low, high = np.floor(numbers.min(axis=0)) - 1, np.ceil(numbers.max(axis=0)) + 1
    if float(np.prod(high - low)) * len(tiles.strokes) > MOST_STROKES:
        return None
    right, up = np.meshgrid(*(np.arange(a, b) for a, b in zip(low, high, strict=True)))
    shifts = np.stack([right.ravel(), up.ravel()], axis=1) @ tiles.steps
    return np.asarray((shifts[:, None, None] + tiles.strokes).reshape(-1, 2, 2))


def inside(strokes: Floats, sides: Floats, *, winding: bool = False) -> Floats:
    """What of strokes (n, 2, 2) lies inside a face: (k, 2, 2).

    sides (m, 2, 2): of all its loops. winding: they run anticlockwise, holes clockwise, and where two loops overlap is
    inside as well; else the even-odd rule tells it
    """
    parts = [np.zeros((0, 2, 2))]
    parts += [_pieces(some, *_spans(some, sides, winding)) for some in _few(strokes, sides)]
    return np.concatenate(parts)


def uncovered(strokes: Floats, sides: Floats) -> Floats:
    """What of strokes (n, 2, 2) lies outside all faces: (k, 2, 2). sides (m, 2, 2): of their loops, anticlockwise."""
    parts = [np.zeros((0, 2, 2))]
    for some in _few(strokes, sides):
        which, spans = _spans(some, sides, True)
        every = np.arange(len(some))
        begins = np.concatenate([np.zeros(len(some)), spans[:, 1]])
        ends = np.concatenate([spans[:, 0], np.ones(len(some))])
        of_begins, of_ends = np.concatenate([every, which]), np.concatenate([which, every])
        one, other = np.lexsort((begins, of_begins)), np.lexsort((ends, of_ends))
        gaps = np.stack([begins[one], ends[other]], axis=1)
        left = gaps[:, 1] > gaps[:, 0]
        parts.append(_pieces(some, of_begins[one][left], gaps[left]))
    return np.concatenate(parts)


def _few(strokes: Floats, sides: Floats) -> Iterator[Floats]:
    """Some strokes at a time."""
    rows = max(1, CROSSINGS // max(len(sides), 1))
    return (strokes[k : k + rows] for k in range(0, len(strokes), rows))


def _pieces(strokes: Floats, which: Numbers, spans: Floats) -> Floats:
    """Pieces (k, 2, 2) of strokes, by the number (k,) of the stroke, and shares (k, 2) of its way."""
    start, along = strokes[:, 0], strokes[:, 1] - strokes[:, 0]
    return np.asarray(start[which, None] + spans[..., None] * along[which, None])


def _spans(strokes: Floats, sides: Floats, winding: bool) -> tuple[Numbers, Floats]:
    """The number (k,) of the stroke of each piece inside, and from where to where on it the piece reaches: (k, 2)."""
    start, along = strokes[:, 0], strokes[:, 1] - strokes[:, 0]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    # How far the ends of each side lie to the left of each stroke. An end on it counts as left, once and for all.
    left = np.einsum("nk,mek->nme", across, sides) - np.einsum("nk,nk->n", across, start)[:, None, None]
    crossed = (left[..., 0] >= 0.0) != (left[..., 1] >= 0.0)
    share = np.where(crossed, left[..., 0], 0.0) / np.where(crossed, left[..., 0] - left[..., 1], 1.0)
    places = sides[None, :, 0] + share[..., None] * (sides[:, 1] - sides[:, 0])[None]
    length = np.maximum(np.einsum("nk,nk->n", along, along), 1e-300)
    t = np.einsum("nmk,nk->nm", places - start[:, None], along) / length[:, None]
    t = np.where(crossed, t, np.inf)
    if winding:
        which, spans = _wound(t, np.where(crossed, np.where(left[..., 0] >= 0.0, 1, -1), 0))
    else:
        t = np.sort(t, axis=1)
        # Along its straight line the face is entered at the first crossing, left at the second, and so on.
        pairs = t[:, : t.shape[1] // 2 * 2].reshape(len(t), -1, 2)
        which, pair = np.nonzero(np.isfinite(pairs[..., 0]))
        spans = pairs[which, pair]
    spans = np.clip(np.where(np.isfinite(spans), spans, 2.0), 0.0, 1.0)
    some = spans[:, 1] > spans[:, 0]
    return which[some], spans[some]


def _wound(t: Floats, sense: Numbers) -> tuple[Numbers, Floats]:
    """Spans (k, 2) of lines in which loops run around them, and the number (k,) of the line of each.

    t (n, m): where line n crosses side m; sense (n, m): 1 where it enters a loop there, -1 where it leaves one
    """
    order = np.argsort(t, axis=1, kind="stable")
    t, sense = np.take_along_axis(t, order, axis=1), np.take_along_axis(sense, order, axis=1)
    after = np.cumsum(sense, axis=1)
    before = after - sense
    enters, leaves = (before == 0) & (after != 0), (before != 0) & (after == 0)
    return np.nonzero(enters)[0], np.stack([t[enters], t[leaves]], axis=1)
