"""A ball alone, of which nothing is drawn but its outline: that lies on the sphere itself, and a coarse mesh will do.

Nothing else is compared with the mesh, and of one convex body culling alone decides. But where the outline runs through
a pole, it is put together from the triangles there, and these must be as small as the accuracy asks.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hlr.scene.scene import Scene
from hlr.view.camera import Camera

COARSE = 1 / 40
"""Of the radius: how far the mesh may lie off the sphere. Its sides turn by a third of a radian then."""

SQUARE = 1e-3
"""Cosine between the axis and the way from a pole to the viewer, up to which the outline may run through the pole."""


def is_ball(scene: Scene, cameras: Iterable[Camera]) -> bool:
    """Whether a scene of one face on a sphere is all of it, and none of the cameras sees a pole edge-on."""
    on = scene.true_surfaces
    if on is None or not scene.convex:
        return False
    data, place = on.surfaces.records(on.number.tolist()).data, on.place[0]
    centre = place[:, :3] @ data[0:3] + place[:, 3]
    axis = place[:, :3] @ data[9:12]
    poles = np.stack([centre + data[12] * axis, centre - data[12] * axis])
    return all(bool((np.abs(camera.toward(poles) @ axis) > SQUARE).all()) for camera in cameras)
