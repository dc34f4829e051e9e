"""The camera in the form that the kernel's rasteriser takes: pixels, y down, and the range of depths of the scene."""

from __future__ import annotations

import math

import numpy as np

from hlr._kernel import Lens
from hlr.common.types import Floats
from hlr.image.camera import NEAR, Camera, dot
from hlr.request.directions import cross, normalized
from hlr.request.options import Vector

SINGLE = 2.0**-23
"""Error of a depth from 0 to 1 in single precision, which is rounded twice: at the corners, and between them."""

ROOM = 1e-6
"""The range of depths is widened by this share of itself, so that rounding keeps all points within."""


def lens(camera: Camera, points: Floats, scale: float, size: tuple[int, int]) -> Lens:
    """The lens for points (n, 3), all that is to be visible; scale: pixels per model unit in the image plane.

    The picture is centred on these points, or on the camera's target if its eye was given.
    """
    distance = 0.0 if camera.eye is None or camera.distance is None else camera.distance
    middle = (0.0, 0.0)
    if not camera.framed and (not distance or float(camera.ahead(points).min()) > NEAR * distance):
        flat = camera.project(points)[:, :2]
        low, high = flat.min(axis=0), flat.max(axis=0)
        middle = (float(low[0] + high[0]) * 0.5, float(low[1] + high[1]) * 0.5)
    return lens_at(camera, points, scale, size, middle)


def lens_at(camera: Camera, points: Floats, scale: float, size: tuple[int, int], middle: tuple[float, float]) -> Lens:
    """The lens of `lens`, but centred on a given point (2,) of the image plane, in model units."""
    ahead = camera.ahead(points)
    nearest, farthest = float(ahead.min()), float(ahead.max())
    distance = 0.0 if camera.eye is None or camera.distance is None else camera.distance
    if distance:
        nearest = max(nearest, NEAR * distance)
        farthest = max(farthest, 2.0 * nearest)
    room = ROOM * (farthest - nearest) or ROOM * max(1.0, abs(nearest))
    d = camera.direction
    return Lens(
        right=camera.right,
        up=camera.up,
        ahead=(-d[0], -d[1], -d[2]),
        origin=camera.eye or (0.0, 0.0, 0.0),
        scale=scale,
        centre=(0.5 * size[0] - middle[0] * scale, 0.5 * size[1] + middle[1] * scale),
        distance=distance,
        range=(nearest - (0.0 if distance else room), farthest + room),
        size=size,
    )


def depth_step(eye: Lens) -> float:
    """The least difference of depth that the picture resolves, at its farthest point: model units.

    The picture keeps depths from 0 to 1 in single precision; in perspective as 1 - nearest / depth, over its maximum.
    """
    nearest, farthest = eye.range
    if not eye.distance:
        return (farthest - nearest) * SINGLE
    return (farthest - nearest) * farthest / nearest * SINGLE


def frame_scale(camera: Camera, height: int) -> float | None:
    """Pixels per model unit where the eye was given, so that the camera frames the picture. None otherwise."""
    if not camera.framed or camera.distance is None or camera.fov is None:
        return None
    return 0.5 * height / (camera.distance * math.tan(math.radians(camera.fov) * 0.5))


def toward_light(camera: Camera, shoulder: Vector) -> Vector:
    """The unit vector toward a light that is given to the right, up and toward the viewer."""
    axes = (camera.right, camera.up, camera.direction)
    return normalized([sum(s * a[k] for s, a in zip(shoulder, axes, strict=True)) for k in range(3)], "the light")


def light_lens(toward: Vector, camera: Camera, points: Floats, texels: int) -> Lens:
    """The parallel view of all points from the light, in a square of `texels` texels a side."""
    right = normalized(cross(camera.up, toward), "the light")
    up = cross(toward, right)
    ahead = (-toward[0], -toward[1], -toward[2])
    x, y, z = dot(points, right), dot(points, up), dot(points, ahead)
    extent = max(float(np.ptp(x)), float(np.ptp(y))) or 1.0
    scale = (texels - 8) / extent
    centre = (
        0.5 * texels - 0.5 * (float(x.min()) + float(x.max())) * scale,
        0.5 * texels + 0.5 * (float(y.min()) + float(y.max())) * scale,
    )
    low, high = float(z.min()), float(z.max())
    room = ROOM * (high - low) or ROOM * max(1.0, abs(low))
    return Lens(
        right=right,
        up=up,
        ahead=ahead,
        origin=(0.0, 0.0, 0.0),
        scale=scale,
        centre=centre,
        distance=0.0,
        range=(low - room, high + room),
        size=(texels, texels),
    )
