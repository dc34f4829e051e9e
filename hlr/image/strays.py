"""Stray parts: a few parts far from all others, which make the drawing much larger. A note names them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hlr.common.numbers import typed
from hlr.common.types import Floats
from hlr.drawing.notes import Note
from hlr.image.camera import Camera
from hlr.source.model import Source

MOST = 3
"""The largest number of strays; they are also a quarter of all parts at most."""

STRETCH = 3.0
"""Strays make the drawing at least this many times as large."""

GAP = 1.0
"""Least distance of each stray from the rest, in diagonals of the rest."""


def stray_note(source: Source, camera: Camera) -> Note | None:
    """A note where some of a source's parts stretch the view."""
    names = source.names()
    if camera.framed or len(names) < 4:
        return None
    boxes = source.boxes()
    some = [i for i, box in enumerate(boxes) if len(box)]
    if len(some) < 4:
        return None
    low, high = _flat([boxes[i] for i in some], camera)
    found = strays(low, high)
    if not found:
        return None
    stray = [names[some[i]] for i in found]
    ratio = _diagonal(low, high) / _diagonal(np.delete(low, found, axis=0), np.delete(high, found, axis=0))
    cure = " ".join(f'--hide "{name}"' for name in stray)
    who = f'the part "{stray[0]}" lies' if len(stray) == 1 else f"{len(stray)} parts lie"
    them = "it" if len(stray) == 1 else "them"
    listed = ", ".join(f'"{name}"' for name in stray)
    larger = f"the drawing is {typed(ratio, 2)} times as large for {them}"
    text = f"{who} far from the rest, and {larger}: leave {them} out with"
    return Note("stray-parts", f"{text} {cure} (in Python, hide=[{listed}]).")


def strays(low: Floats, high: Floats) -> list[int]:
    """Numbers of the parts that lie apart, by the corners (n, 2) of their boxes on paper; none where there are many."""
    whole, kept, out = _diagonal(low, high), np.arange(len(low)), []
    most = min(MOST, len(low) // 4)
    # With so many taken out, the rest reaches at least as far as this: nearly always enough to say that there are none.
    least = np.hypot(*(np.partition(high, -1 - most, axis=0)[-1 - most] - np.partition(low, most, axis=0)[most]))
    if least * STRETCH > whole:
        return []
    for _ in range(most):
        # Of the parts that touch the box around all, take out the one that leaves the smallest rest.
        rim = {int(i) for i in (*low[kept].argmin(axis=0), *high[kept].argmax(axis=0))}
        rests = {i: np.delete(kept, i) for i in sorted(rim)}
        best = min(rests, key=lambda i: _diagonal(low[rests[i]], high[rests[i]]))
        out.append(int(kept[best]))
        kept = rests[best]
        rest = _diagonal(low[kept], high[kept])
        gaps = np.maximum(low[out] - high[kept].max(axis=0), low[kept].min(axis=0) - high[out]).max(axis=1)
        if rest * STRETCH <= whole and (gaps >= GAP * rest).all():
            return sorted(out)
    return []


def _flat(boxes: Sequence[Floats], camera: Camera) -> tuple[Floats, Floats]:
    """Corners (n, 2) on the image plane of boxes around points in model coordinates."""
    points, first = np.concatenate(boxes), np.cumsum([0, *map(len, boxes[:-1])])
    ends = np.stack([np.minimum.reduceat(points, first), np.maximum.reduceat(points, first)], axis=1)
    corners = np.stack([ends[:, [i, j, k], [0, 1, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)], axis=1)
    flat = camera.project(corners.reshape(-1, 3))[:, :2].reshape(len(boxes), 8, 2)
    return flat.min(axis=1), flat.max(axis=1)


def _diagonal(low: Floats, high: Floats) -> float:
    return float(np.hypot(*(high.max(axis=0) - low.min(axis=0))))
