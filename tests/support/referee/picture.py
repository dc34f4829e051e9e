"""A picture for people: the model in grey, the visible lines, and every fault the referee found."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from support.referee.depth import Hits, Sheet
from support.referee.exchange import Exchange, Floats
from support.referee.lost import Lost
from support.referee.missing import Missing
from support.referee.off_curve import Off

ZOOM = 2
RING = 14
"""Pixels of the picture around places that are wrong."""
MISSING, WRONG, OFF, LOST = (220, 0, 0), (255, 140, 0), (200, 0, 200), (90, 150, 255)


def save(
    path: Path,
    drawing: Exchange,
    sheet: Sheet,
    image: Hits,
    gaps: Missing,
    *,
    wrong: Floats,
    off: list[Off],
    lost: Lost | None,
) -> None:
    """Write a PNG. Red: missing visible line; orange rings: wrong visibility; purple: off its curve; blue: lost faces.

    wrong: places on paper (n, 2).
    """
    from PIL import Image, ImageDraw

    facing = np.abs(image.normal @ drawing.camera.direction)
    shade = np.where(image.met, 170 + 70 * facing, 255).astype(np.uint8)
    pixels = np.repeat(shade[:, :, None], 3, axis=2)
    if lost is not None:
        pixels[lost.mask] = LOST
    picture = Image.fromarray(pixels[::-1]).resize((sheet.columns * ZOOM, sheet.rows * ZOOM))
    brush = ImageDraw.Draw(picture)

    def place(points: Floats) -> list[tuple[float, float]]:
        at = (points - sheet.low) / sheet.pixel * ZOOM
        return [(x + ZOOM / 2, sheet.rows * ZOOM - y - ZOOM / 2) for x, y in at.tolist()]

    for line in drawing.lines:
        if line.visible:
            brush.line(place(line.ink(sheet.pixel)), fill=(0, 0, 0), width=1)
    for each in off:
        brush.line(place(drawing.lines[each.line].ink(sheet.pixel)), fill=OFF, width=3)
    for x, y in place(gaps.places):
        brush.rectangle((x - 1, y - 1, x + 1, y + 1), fill=MISSING)
    for x, y in place(np.array([run.at for run in gaps.faults]).reshape(-1, 2)):
        brush.ellipse((x - RING, y - RING, x + RING, y + RING), outline=MISSING, width=2)
    for x, y in place(wrong):
        brush.ellipse((x - RING / 2, y - RING / 2, x + RING / 2, y + RING / 2), outline=WRONG, width=2)
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.save(path)
