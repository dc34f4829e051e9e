"""The pixels of a shaded picture, and its maps: how deep each pixel is, and which face it shows."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr._kernel import Lens, Light
from hlr.common.types import Floats, Ints
from hlr.image.camera import NEAR, Camera
from hlr.request.picture_effects import AMBIENT, DIFFUSE, SHOULDER, Effects, PreviewOptions
from hlr.scene.scene import Scene
from hlr.shading.lens import light_lens, toward_light
from hlr.shading.scene import ShadedScene

Pixels = npt.NDArray[np.uint8]


def empty_picture(size: tuple[int, int], background: tuple[int, ...]) -> Pixels:
    """(h, w, 4) a picture of nothing. size: width and height in pixels; background: sRGB and opacity, 0 to 255."""
    return np.full((size[1], size[0], 4), background, np.uint8)


def shaded_picture(
    shaded: ShadedScene, camera: Camera, eye: Lens, effects: Effects, background: tuple[int, ...]
) -> Pixels:
    """(h, w, 4) the faces that the lens shows, lit from over the viewer's shoulder."""
    toward = toward_light(camera, SHOULDER)
    sun = light_lens(toward, camera, shaded.points, effects.shadows) if effects.shadows else None
    return shaded.model.picture(
        eye,
        Light(toward=toward, ambient=AMBIENT, diffuse=DIFFUSE, specular=effects.specular),
        _linear_light(background),
        effects.antialias,
        sun,
        effects.occlusion,
    )


def before_the_eye(scene: Scene, camera: Camera) -> Floats | None:
    """(n,) positive for points before the near plane; None for parallel views."""
    if camera.eye is None or camera.distance is None:
        return None
    return np.asarray(camera.ahead(scene.points) - NEAR * camera.distance)


def first_faces(scene: Scene) -> Ints:
    """(p + 1,) faces of all parts numbered together; a mesh has one."""
    count = np.array([max(part.faces, 1) for part in scene.parts], np.int32)
    if len(scene.triangles):
        np.maximum.at(count, scene.triangle_part, scene.triangle_face + 1)
    return np.concatenate([[0], np.cumsum(count)]).astype(np.int32)


def maps(
    scene: Scene, shaded: ShadedScene, eye: Lens, options: PreviewOptions, unit: float
) -> tuple[Floats | None, Ints | None]:
    """The depth map (h, w) in millimetres and the map of faces (h, w), each where the options ask for it.

    unit: millimetres per model unit.
    """
    if not options.depth and not options.ids:
        return None, None
    ahead, triangle = shaded.model.maps(eye)
    face = first_faces(scene)[scene.triangle_part] + scene.triangle_face
    ids = np.where(triangle >= 0, np.append(face, -1)[triangle], -1).astype(np.int32)
    return (ahead * unit if options.depth else None), (ids if options.ids else None)


def _linear_light(color: tuple[int, ...]) -> tuple[float, float, float, float]:
    """sRGB and opacity, 0 to 255, -> linear light, premultiplied."""
    opacity = color[3] / 255.0
    share = [c / 255.0 for c in color[:3]]
    r, g, b = (opacity * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4) for c in share)
    return (r, g, b, opacity)
