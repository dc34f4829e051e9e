"""From the camera's image plane to pixels, as one matrix."""

from __future__ import annotations

import math
from dataclasses import dataclass
from numbers import Integral
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.errors import OptionError
from hlr.image.camera import NEAR, Camera

LARGEST = 8192
"""Pixels along a side: with 256 steps to a pixel, exact comparisons stay within 128 bits."""

MARGIN = 0.02
"""Share of the picture that is left empty on each side of a model that is fitted into it."""

Matrix = tuple[tuple[float, float, float, float], ...]
Window = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Screen:
    """A camera for polygons that are given in pixels already: x right, y down, z depth.

    nearer: whether smaller or larger z are nearer to the viewer.
    """

    nearer: str = "smaller"


SCREEN = Screen()


@dataclass(frozen=True, slots=True)
class Viewport:
    """What the kernel needs of a camera: a matrix (x, y, z, 1) -> (u, v, q, w); pixels u / w and v / w, depth q / w.

    front, back: depths of the front and back planes, infinite where there is none; near: w at the near plane.
    """

    matrix: Matrix
    size: tuple[int, int]
    front: float
    back: float
    near: float
    image_space: bool

    def kernel(self) -> tuple[Matrix, tuple[int, int], tuple[float, float, float], bool]:
        """The same as a tuple of the kernel's arguments."""
        return self.matrix, self.size, (self.front, self.back, self.near), self.image_space


def checked_size(size: Any) -> tuple[int, int]:
    """Width and height in pixels; raises OptionError."""
    try:
        width, height = size
    except (TypeError, ValueError):
        raise OptionError(f"size needs width and height in pixels, such as (1920, 1080), not {size!r}") from None
    for side in (width, height):
        if not isinstance(side, Integral) or isinstance(side, bool) or not 1 <= int(side) <= LARGEST:
            raise OptionError(
                f"a picture of {width} x {height} pixels cannot be made: give 1 to {LARGEST} for each side"
            )
    return int(width), int(height)


def viewport(
    camera: Camera | Screen,
    points: Floats,
    size: Any,
    *,
    window: Window | None = None,
    front: float | None = None,
    back: float | None = None,
    space: str = "image",
) -> Viewport:
    """The viewport of a camera for points (n, 3).

    window  (x0, y0, x1, y1) of the image plane, model units, y up; None: around the points, or the frame of a camera
            whose field of view was given
    front, back  distances of the front and back planes along the view, in perspective from the eye; with space "image"
            nothing before the one or beyond the other is drawn
    space   "image": clip in three dimensions, then hide; "object": hide first, then clip in two dimensions
    """
    width, height = checked_size(size)
    if space not in ("image", "object"):
        raise OptionError(f"no space is called {space!r}: use image or object")
    for name, value in (("front", front), ("back", back)):
        if value is not None and not math.isfinite(value):
            raise OptionError(f"{name} needs a finite distance, not {value!r}")
    if front is not None and back is not None and not front < back:
        raise OptionError(f"the front plane at {front:g} must lie before the back plane at {back:g}")
    if isinstance(camera, Screen):
        sign = -1.0 if camera.nearer == "larger" else 1.0
        rows = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, sign, 0.0), (0.0, 0.0, 0.0, 1.0))
        low, high = _planes(front, back)
        if sign < 0.0:
            low, high = -high, -low
        return Viewport(rows, (width, height), low, high, -math.inf, space == "image")
    if not isinstance(camera, Camera):
        raise OptionError(f"{type(camera).__name__} is no camera: give an hlr.view camera, or SCREEN for pixels")
    x0, y0, x1, y1 = window or _window(camera, points, width / height)
    if not (x1 > x0 and y1 > y0 and all(map(math.isfinite, (x0, y0, x1, y1)))):
        raise OptionError(f"the window {window!r} is empty: give x0, y0, x1, y1 with x0 < x1 and y0 < y1")
    scale = min(width / (x1 - x0), height / (y1 - y0))
    shift = (0.5 * width - scale * 0.5 * (x0 + x1), 0.5 * height + scale * 0.5 * (y0 + y1))
    if camera.eye is None or camera.distance is None:
        u = _row(camera.right, scale, shift[0])
        v = _row(camera.up, -scale, shift[1])
        q = _row(camera.direction, -1.0, 0.0)
        low, high = _planes(front, back)
        return Viewport((u, v, q, (0.0, 0.0, 0.0, 1.0)), (width, height), low, high, -math.inf, space == "image")
    d = camera.distance
    away = _through(camera.direction, -1.0, camera.eye)
    x, y = _through(camera.right, scale * d, camera.eye), _through(camera.up, -scale * d, camera.eye)
    u, v = (_sum(a, away, s) for a, s in ((x, shift[0]), (y, shift[1])))
    q = (0.0, 0.0, 0.0, -d * d)
    near = NEAR * d
    for name, value in (("front", front), ("back", back)):
        if value is not None and value < near:
            raise OptionError(f"in perspective {name} must be at least {near:g} from the eye, not {value:g}")
    low = -math.inf if front is None else -d * d / front
    high = math.inf if back is None else -d * d / back
    return Viewport((u, v, q, away), (width, height), low, high, near, space == "image")


Row = tuple[float, float, float, float]


def _planes(front: float | None, back: float | None) -> tuple[float, float]:
    return (-math.inf if front is None else front, math.inf if back is None else back)


def _row(v: tuple[float, float, float], factor: float, shift: float) -> Row:
    return (v[0] * factor, v[1] * factor, v[2] * factor, shift)


def _through(v: tuple[float, float, float], factor: float, eye: tuple[float, float, float]) -> Row:
    a, b, c = (component * factor for component in v)
    return (a, b, c, -(a * eye[0] + b * eye[1] + c * eye[2]))


def _sum(a: Row, b: Row, factor: float) -> Row:
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2], a[3] + factor * b[3])


def _window(camera: Camera, points: Floats, aspect: float) -> Window:
    """The rectangle of the image plane that holds the points, with a margin."""
    if camera.framed and camera.distance is not None and camera.fov is not None:
        half = camera.distance * math.tan(math.radians(camera.fov) * 0.5)
        return (-half * aspect, -half, half * aspect, half)
    if camera.eye is not None and camera.distance is not None:
        points = points[camera.ahead(points) > NEAR * camera.distance]
    if not len(points):
        return (-1.0, -1.0, 1.0, 1.0)
    flat = camera.project(points)[:, :2]
    low, high = flat.min(axis=0), flat.max(axis=0)
    extent = high - low
    least = max(float(extent.max()), 1e-9 * float(np.abs(flat).max()), 1e-300)
    pad = np.where(extent > 0.0, MARGIN * np.maximum(extent, 1e-3 * least), 0.5 * least)
    low, high = low - pad, high + pad
    return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))
