"""Faces that one mesh has and another lacks: two depth images of one sheet, pixel by pixel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.ndimage import binary_opening, label

from support.referee.depth import Hits, Sheet

BROAD = 5
"""Pixels: an area is at least this wide both ways. Borders, which differ by a tessellation, are not."""
DEEP = 2.0
"""Pixels of depth, and as much again as the surface falls on its way over as many."""


@dataclass(frozen=True)
class Lost:
    """Areas where the two meshes differ.

    mask   (rows, columns): the pixels
    areas  size of each in square millimetres and a point in it on paper, largest first
    """

    mask: npt.NDArray[np.bool_]
    areas: list[tuple[float, tuple[float, float]]]


def lost(sheet: Sheet, image: Hits, own: Hits) -> Lost:
    """Compare the depth image of the reference with that of the drawing's own triangles."""
    steep = np.minimum(*(np.linalg.norm(hits.slope, axis=2) for hits in (image, own)))
    with np.errstate(invalid="ignore"):
        apart = np.abs(image.depth - own.depth) > DEEP * sheet.pixel * (1 + steep)
    mask = np.where(image.met & own.met, apart, image.met != own.met)
    mask = binary_opening(mask, np.ones((BROAD, BROAD)))
    numbers, count = label(mask)
    areas = []
    for number in range(1, count + 1):
        inside = sheet.centres[numbers == number]
        nearest = inside[np.argmin(((inside - inside.mean(axis=0)) ** 2).sum(axis=1))]
        areas.append((len(inside) * sheet.pixel**2, (float(nearest[0]), float(nearest[1]))))
    return Lost(mask, sorted(areas, reverse=True))
