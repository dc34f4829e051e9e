"""The colour at each corner of each triangle, in linear light."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from hlr.scene.scene import Scene
from hlr.source.model import PLAIN, Floats, Ints, Look, Rgba
from hlr.source.weld import equal_rows

Colours = npt.NDArray[np.float32]


def corner_paint(scene: Scene, looks: Mapping[str, Look]) -> tuple[Colours, Ints]:
    """Colours (k, 4), linear light and opacity, and (t, 3) which of them each corner has."""
    table: dict[Rgba, int] = {}
    painted: list[npt.NDArray[np.float32]] = []
    paint = np.zeros((len(scene.triangles), 3), np.int32)
    # Triangles are sorted by part.
    bounds = np.searchsorted(scene.triangle_part, np.arange(len(scene.parts) + 1)).tolist()
    for i, part in enumerate(scene.parts):
        a, b = bounds[i : i + 2]
        look = looks.get(part.name, Look())
        whole = look.whole or ((*part.color, 1.0) if part.color is not None else PLAIN)
        paint[a:b] = table.setdefault(whole, len(table))
        for face, color in look.faces.items():
            paint[a:b][scene.triangle_face[a:b] == face] = table.setdefault(color, len(table))
        if look.corners is not None and look.points is not None and look.triangles is not None:
            # Numbers from the end on, until it is known how many others there are.
            first = sum(map(len, painted))
            corners = scene.triangles[a:b].copy()
            turned = scene.turned[a:b]
            corners[turned] = corners[turned][:, [0, 2, 1]]
            own = look.corners[_kept(scene.points[corners], look.points[look.triangles])]
            own[turned] = own[turned][:, [0, 2, 1]]
            painted.append(own.reshape(-1, 4))
            paint[a:b] = -1 - first - np.arange(3 * (b - a), dtype=np.int32).reshape(-1, 3)
    plain = np.array(list(table), np.float32).reshape(-1, 4)
    paint = np.where(paint < 0, len(plain) - 1 - paint, paint).astype(np.int32)
    every = np.concatenate([plain, *painted])
    return _linear(every), np.ascontiguousarray(paint)


def _kept(now: Floats, before: Floats) -> npt.NDArray[np.intp]:
    """For each triangle of a scene's part which one of the mesh it is, by where their corners (m, 3, 3) are.

    The scene has dropped those that are there twice; it has moved none, and left them in their order.
    """
    if len(now) == len(before):
        return np.arange(len(now))
    _, number = equal_rows(np.concatenate([before, now]).reshape(-1, 3))
    corner = number.reshape(-1, 3).astype(np.int64)
    _, first, inverse = np.unique(corner, axis=0, return_index=True, return_inverse=True)
    return np.asarray(first[inverse.ravel()[len(before) :]], np.intp)


def _linear(srgb: Colours) -> Colours:
    """Colours as numbers of a screen -> linear light; opacity stays."""
    out = srgb.copy()
    c = np.clip(srgb[:, :3], 0.0, 1.0)
    out[:, :3] = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    return np.ascontiguousarray(out)
