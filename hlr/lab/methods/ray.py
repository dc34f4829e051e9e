"""One ray and all polygons it meets. Its parameter t is 0 at the eye, 1 at the pixel, negative behind the eye."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.errors import OptionError
from hlr.image.camera import Camera
from hlr.lab.methods.polygons import Polygons, polygons_of
from hlr.lab.methods.viewport import Screen, Window, viewport


@dataclass(frozen=True, slots=True)
class Hit:
    """Where a ray meets a polygon.

    t         of the point eye + t (pixel - eye): below 0 behind the eye, between 0 and 1 before the image plane
    polygon   number of the polygon
    point     (x, y, z) in model coordinates
    """

    t: float
    polygon: int
    point: tuple[float, float, float]


def ray_hits(
    scene: Any,
    camera: Camera | Screen,
    size: tuple[int, int],
    pixel: tuple[int, int],
    *,
    rule: str = "even-odd",
    window: Window | None = None,
) -> list[Hit]:
    """All polygons that the ray through the centre of pixel (column, row) meets, by t; those seen edge-on are left out.

    The first with t > 0 is the one that `render` shows there, unless the centre lies on a border and rounding decides.
    Raises OptionError for a camera without an eye: in a parallel view t has no origin.
    """
    polygons = polygons_of(scene, rule)
    if isinstance(camera, Screen) or camera.eye is None or camera.distance is None:
        raise OptionError("a parallel view has no eye for t to begin at: give a perspective camera")
    port = viewport(camera, polygons.points, size, window=window)
    column, row = pixel
    matrix, eye = np.array(port.matrix)[[0, 1, 3]], np.array(camera.eye)
    # On the image plane w is the distance. This gives three equations for the pixel's position in the model.
    wanted = camera.distance * np.array([column + 0.5, row + 0.5, 1.0])
    away = np.linalg.solve(matrix[:, :3], wanted - matrix[:, 3]) - eye
    found = []
    for number in range(len(polygons)):
        t = _met(polygons, number, eye, away)
        if t is not None:
            found.append(Hit(t, number, tuple((eye + t * away).tolist())))
    return sorted(found, key=lambda hit: (hit.t, hit.polygon))


def _met(polygons: Polygons, number: int, eye: Floats, away: Floats) -> float | None:
    runs = range(int(polygons.polygons[number]), int(polygons.polygons[number + 1]))
    loops = [polygons.points[polygons.corners[polygons.loops[k] : polygons.loops[k + 1]]] for k in runs]
    # The polygon's plane by Newell's method, over all corners.
    normal = sum((np.cross(loop, np.roll(loop, -1, axis=0)).sum(axis=0) for loop in loops), np.zeros(3))
    steep = float(normal @ away)
    if abs(steep) <= 1e-12 * float(np.linalg.norm(normal) * np.linalg.norm(away)):
        return None
    t = float(normal @ (loops[0].mean(axis=0) - eye)) / steep
    keep = [axis for axis in range(3) if axis != int(np.argmax(np.abs(normal)))]
    x, y = (eye + t * away)[keep].tolist()
    turns = sum(_turns(loop[:, keep], x, y) for loop in loops)
    return t if (turns != 0 if polygons.rule == "non-zero" else turns % 2 == 1) else None


def _turns(loop: Floats, x: float, y: float) -> int:
    """The winding number of a loop around the point (x, y)."""
    (ax, ay), (bx, by) = loop.T, np.roll(loop, -1, axis=0).T
    up, down = (ay <= y) & (by > y), (by <= y) & (ay > y)
    side = (bx - ax) * (y - ay) - (x - ax) * (by - ay)
    return int((up & (side > 0)).sum()) - int((down & (side < 0)).sum())
