"""What the kernel made of the contours of meshes: smooth curves, and points along them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.linework.exact import CUBIC, DrawnLines
from hlr.source.geometry import starts
from hlr.source.model import Floats, Ints
from hlr.view.camera import Camera


def lifted(found: dict[str, Any], smoothed: npt.NDArray[np.bool_], camera: Camera, per_model: float) -> Floats:
    """(n, 3) points in space of all lines of `found`, those of smoothed (lines,) ones where their image now is.

    The kernel moved a contour on paper; in space it moves as far, square to the line of sight, at its depth.
    """
    space: Floats = found["space"]
    offsets: Ints = found["offsets"]
    moved = np.repeat(smoothed, np.diff(offsets))
    if not moved.any():
        return space
    at = space[moved]
    step = (found["flat"][moved] - camera.project(at)[:, :2] * per_model) / per_model
    if camera.eye is not None and camera.distance is not None:
        step *= (camera.ahead(at) / camera.distance)[:, None]
    out = space.copy()
    out[moved] = at + step[:, :1] * np.asarray(camera.right) + step[:, 1:] * np.asarray(camera.up)
    return out


def with_contours(drawn: DrawnLines, found: dict[str, Any]) -> DrawnLines:
    """The lines, those of contours with the kernel's curves, from where they now begin to where they end."""
    count = np.diff(found["curve_offsets"])
    smooth = np.flatnonzero(count)
    if len(smooth) == 0:
        return drawn
    form, bounds = drawn.form.copy(), drawn.bounds.copy()
    form[smooth] = CUBIC
    curves = found["curve"].copy()
    first, last = found["curve_offsets"][smooth], found["curve_offsets"][smooth + 1] - 1
    curves[first], curves[last] = drawn.flat[drawn.offsets[smooth]], drawn.flat[drawn.offsets[smooth + 1] - 1]
    low, high = found["curve_bounds"][smooth].transpose(1, 0, 2)
    bounds[smooth, 0] = np.minimum(bounds[smooth, 0], low)
    bounds[smooth, 1] = np.maximum(bounds[smooth, 1], high)
    # A line has either numbers of its own, or those of a contour.
    length = np.where(count > 0, 2 * count, np.diff(drawn.data_offsets))
    offsets = starts(length)
    of_contour = np.repeat(count > 0, length)
    data = np.empty(len(of_contour))
    data[of_contour] = curves.ravel()
    data[~of_contour] = drawn.data
    return DrawnLines(drawn.offsets, drawn.flat, drawn.space, form, offsets, data, bounds)
