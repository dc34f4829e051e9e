"""The overlay as PNG, by Pillow: drawn twice as large and made smaller, which smooths the lines."""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr.compare.lines.pieces import Floats
from hlr.compare.overlay.picture import PAPER, Overlay, Stroke
from hlr.drawing.chords import numbered
from hlr.writers.png import encoded

_PIXELS_PER_MM = 8.0
_MOST_PIXELS = 4000
"""On a side."""

_SMOOTH = 2
_DASH_MM, _GAP_MM = 2.0, 1.2


def png(page: Overlay) -> bytes:
    """The content of the file."""
    from PIL import Image, ImageDraw, ImageFont

    factor = min(_PIXELS_PER_MM, _MOST_PIXELS / max(page.width, page.height))
    size = (max(1, round(page.width * factor)), max(1, round(page.height * factor)))
    fine = factor * _SMOOTH
    image = Image.new("RGB", (size[0] * _SMOOTH, size[1] * _SMOOTH), PAPER)
    draw = ImageDraw.Draw(image)
    for mark in page.marks:
        if isinstance(mark, Stroke):
            _stroke(draw, mark, fine)
        else:
            font = ImageFont.load_default(max(mark.size * fine, 1.0))
            draw.text((mark.at[0] * fine, mark.at[1] * fine), mark.text, mark.color, font, anchor="ls")
    smooth = image.resize(size, Image.Resampling.BOX)
    return encoded(smooth, {"Title": page.title}, factor * 25.4)


def _stroke(draw: Any, mark: Stroke, fine: float) -> None:
    width = max(1, round(mark.width * fine))
    for points in mark.lines:
        for dash in _dashes(points) if mark.dashed else [points]:
            draw.line([(x, y) for x, y in (dash * fine).tolist()], mark.color, width, joint="curve")


def _dashes(points: Floats) -> list[Floats]:
    """The dashes of a polyline."""
    step = np.hypot(*np.diff(points, axis=0).T)
    at = np.concatenate([[0.0], np.cumsum(step)])
    starts = np.arange(0.0, at[-1], _DASH_MM + _GAP_MM)
    ends = np.minimum(starts + _DASH_MM, at[-1])
    first, last = np.searchsorted(at, starts, "right"), np.searchsorted(at, ends, "left")
    _, number = numbered(np.maximum(last - first, 0))
    inner = np.split(
        np.repeat(first, np.maximum(last - first, 0)) + number, np.cumsum(np.maximum(last - first, 0))[:-1]
    )
    out = []
    for start, end, between in zip(starts, ends, inner, strict=True):
        where = np.concatenate([[start], at[between], [end]])
        out.append(np.stack([np.interp(where, at, points[:, axis]) for axis in (0, 1)], axis=1))
    return out
