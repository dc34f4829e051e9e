"""A scene prepared for pictures: triangles with their normals and colours, held by the kernel."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats
from hlr.scene.colors import corner_colors
from hlr.scene.scene import Geometry
from hlr.shading.normals import corner_normals
from hlr.source.model import Appearance


@dataclass(frozen=True, slots=True)
class ShadedScene:
    """points (n, 3): of all that is shown; opacity: the least of all; glass (t,) bool: transparent triangles."""

    model: _kernel.ShadedModel
    points: Floats
    opacity: float
    glass: npt.NDArray[np.bool_]


def shaded_scene(scene: Geometry, looks: Mapping[str, Appearance], near: Floats | None = None) -> ShadedScene:
    """The triangles of a scene, ready for any number of pictures.

    near: (n,) zero or negative for points behind the near plane; None: there are none. Bodies that reach behind it are
    cut open and show their inside.
    """
    normals, corner = corner_normals(scene)
    colours, paint = corner_colors(scene, looks)
    opened = np.zeros(len(scene.groups), bool)
    glass = np.asarray((colours[:, 3] < 1.0)[paint].any(axis=1))
    opened[scene.triangle_group[glass]] = True
    if near is not None:
        behind = (near[scene.triangles] <= 0.0).any(axis=1)
        opened[scene.triangle_group[behind]] = True
    cull = (scene.groups.cull & ~opened)[scene.triangle_group]
    used = np.zeros(len(scene.points), bool)
    used[scene.triangles] = True
    model = _kernel.ShadedModel(scene.points, scene.triangles, corner, normals, paint, colours, cull)
    return ShadedScene(model, scene.points[used], float(colours[paint, 3].min(initial=1.0)), glass)
