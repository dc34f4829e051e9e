"""The faces under the lines of a filled drawing: flat-shaded, in the painter's order."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.drawing import Fill
from hlr.errors import OptionError
from hlr.scene.scene import Scene
from hlr.source.model import Floats, Ints
from hlr.surfaces.painters import PaintersList, painters_list
from hlr.surfaces.polygons import Polygons
from hlr.surfaces.regions import joined
from hlr.surfaces.render import NotFinishedError, render
from hlr.surfaces.viewport import LARGEST, Window
from hlr.view.camera import Camera, dot, normalized

MOST = 20_000
"""Faces: a vector drawing of more is larger than a picture in pixels, and slower to show."""

SIEVE = 3000
"""Pixels: a face that shows at none of so many along the longer side is left out."""

PATIENCE = 20_000_000
"""Comparisons of depth sort, which cuts little but may take long; beyond them the BSP tree, which is quick but cuts."""

GREY = (0.75, 0.75, 0.75)
"""Of parts without a colour."""

AMBIENT = 0.4
"""Light that a face has which is turned away from the lamp."""


def filled(scene: Scene, camera: Camera, per_model: float, origin: tuple[float, float]) -> Fill:
    """Visible faces on paper; per_model, origin: as of the drawing's lines.

    Raises OptionError where there are more than MOST.
    """
    chosen = _turned_toward(scene, camera)
    polygons, normals, part = joined(scene, chosen)
    flat = camera.project(scene.points)[:, :2]
    window = _window(flat)
    seen = _seen(polygons, camera, window)
    polygons, normals, part = polygons.chosen(seen), normals[seen], part[seen]
    if len(polygons) > MOST:
        raise OptionError(
            f"{len(polygons):,} faces are too many to be filled, {MOST:,} at most: give a coarser accuracy, or no fill"
        )
    width, height = _size(window, LARGEST)
    ordered = _ordered(polygons, camera, (width, height), window)
    # Pixels back to the image plane, and from there to paper.
    scale = min(width / (window[2] - window[0]), height / (window[3] - window[1]))
    centre = np.array([0.5 * (window[0] + window[2]), 0.5 * (window[1] + window[3])])
    pixels = ordered.points - np.array([0.5 * width, 0.5 * height])
    points = (centre + pixels * [1.0 / scale, -1.0 / scale]) * per_model - np.asarray(origin)
    colors = _shaded(scene, camera, polygons, normals, part)
    return Fill(points, ordered.loops, ordered.polygons, colors[ordered.ids], part[ordered.ids])


def _turned_toward(scene: Scene, camera: Camera) -> npt.NDArray[Any]:
    """Triangles that may be seen: all but those of closed parts that are turned away."""
    corners = scene.points[scene.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if camera.eye is None:
        toward = dot(normals, camera.direction)
    else:
        toward = ((np.asarray(camera.eye) - corners[:, 0]) * normals).sum(axis=1)
    return np.asarray((toward > 0.0) | ((toward < 0.0) & ~scene.groups.cull[scene.triangle_group]))


def _seen(polygons: Polygons, camera: Camera, window: Window) -> npt.NDArray[np.int64]:
    """Those that show at some pixel of a picture so fine that a line's width is many of them."""
    ids = render(polygons, camera, _size(window, SIEVE), "scan line", window=window).ids
    found = np.unique(ids)
    return np.asarray(found[found >= 0], np.int64)


def _ordered(polygons: Polygons, camera: Camera, size: tuple[int, int], window: Window) -> PaintersList:
    try:
        return painters_list(polygons, camera, size, "depth sort", window=window, most_comparisons=PATIENCE)
    except NotFinishedError:
        return painters_list(polygons, camera, size, "bsp", window=window)


def _window(flat: Floats) -> Window:
    """Around the points on the image plane, with a pixel to spare."""
    if not len(flat):
        return (-1.0, -1.0, 1.0, 1.0)
    low, high = flat.min(axis=0), flat.max(axis=0)
    pad = 2.0 / LARGEST * max(float((high - low).max()), 1e-12)
    return (float(low[0]) - pad, float(low[1]) - pad, float(high[0]) + pad, float(high[1]) + pad)


def _size(window: Window, largest: int) -> tuple[int, int]:
    """Pixels of a picture of the window, `largest` along its longer side."""
    wide, high = window[2] - window[0], window[3] - window[1]
    factor = largest / max(wide, high)
    return max(1, min(largest, math.ceil(wide * factor))), max(1, min(largest, math.ceil(high * factor)))


def _shaded(scene: Scene, camera: Camera, polygons: Polygons, normals: Floats, part: Ints) -> npt.NDArray[Any]:
    """(p, 3) uint8 sRGB: the part's colour, lit by a lamp above the viewer's left shoulder."""
    d, u, r = camera.direction, camera.up, camera.right
    lamp = normalized([d[k] + 0.7 * u[k] - 0.5 * r[k] for k in range(3)], "the light")
    base = np.array([p.color or GREY for p in scene.parts], np.float64).reshape(-1, 3)
    corner = polygons.points[polygons.corners[polygons.loops[polygons.polygons[:-1]]]]
    eye = np.asarray(d) if camera.eye is None else np.asarray(camera.eye) - corner
    # Of open surfaces the back is lit as well.
    sign = np.where((normals * eye).sum(axis=1) < 0.0, -1.0, 1.0)
    light = AMBIENT + (1.0 - AMBIENT) * np.clip(sign * dot(normals, lamp), 0.0, 1.0)
    return np.asarray(np.rint(255.0 * np.clip(base[part] * light[:, None], 0.0, 1.0)), np.uint8)
