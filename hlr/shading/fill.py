"""The fill of a drawing: visible faces as areas on paper, coloured as in the shaded preview."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.drawing.fill import Fill, Gradient
from hlr.image.camera import NEAR, Camera
from hlr.request.accuracy import FILL_STEP
from hlr.request.picture_effects import AMBIENT, DIFFUSE, SHOULDER
from hlr.scene.scene import Scene
from hlr.shading.lens import lens_at, toward_light
from hlr.shading.scene import shaded_scene
from hlr.source.model import Appearance
from hlr.tables.line_classes import where

MOST = 6_000_000
"""Largest number of points of the grid on which visibility is sampled: about 150 MB while it is made."""

MOST_A_SIDE = 16_000
"""Largest number of points along one side of the grid."""

LEAST_A_SIDE = 400
"""Least number of points along the longer side, so that small drawings are sampled as finely as large ones."""

BAND = 0.3
"""Least width of a band of equal light, as a rule; millimetres on paper."""


def filled(
    scene: Scene,
    looks: Mapping[str, Appearance],
    camera: Camera,
    shown: Floats,
    per_model: float,
    origin: tuple[float, float],
    accuracy: float,
) -> Fill:
    """The visible areas of the faces, in the colours and the light of a preview.

    shown (n, 3): points of the model whose images bound the drawing. per_model, origin: as of the drawing's lines.
    accuracy: millimetres on paper. Visibility is sampled on a grid of that spacing, or of MOST points if that
    is coarser; borders are computed on the triangles themselves.
    """
    if not len(scene.triangles) or not len(shown):
        return _nothing()
    flat = camera.project(shown)[:, :2]
    low, high = flat.min(axis=0), flat.max(axis=0)
    extent = np.maximum(high - low, 1e-9 * max(float((high - low).max()), 1e-300))
    pixels = _per_mm(extent * per_model, accuracy) * per_model
    size = tuple(math.ceil(float(e) * pixels) + 4 for e in extent)
    middle = (float(low[0] + high[0]) * 0.5, float(low[1] + high[1]) * 0.5)
    before = None
    if camera.eye is not None and camera.distance is not None:
        before = np.asarray(camera.ahead(scene.points) - NEAR * camera.distance)
    shaded = shaded_scene(scene, looks, before)
    eye = lens_at(camera, shaded.points, pixels, (size[0], size[1]), middle)
    found = _kernel.filled_areas(
        shaded.model,
        eye,
        _kernel.Light(toward=toward_light(camera, SHOULDER), ambient=AMBIENT, diffuse=DIFFUSE),
        _labels(scene),
        max(1.0, BAND * pixels / per_model),
    )

    def paper(places: Floats) -> Floats:
        """Pixels -> millimetres."""
        off = (places - np.asarray(eye.centre)) * [per_model / pixels, -per_model / pixels]
        return np.asarray(off - np.asarray(origin), np.float64)

    return Fill(
        points=paper(found["points"]),
        loops=found["loops"],
        faces=found["areas"],
        colors=found["colours"],
        gradient=found["gradient"],
        gradients=tuple(
            Gradient(paper(line[:2]), paper(line[2:]), found["shares"][a:b], found["shades"][a:b, :3])
            for line, a, b in zip(found["lines"], found["stops"][:-1], found["stops"][1:], strict=True)
        ),
        part=scene.triangle_part[found["triangle"]].astype(np.int32),
        spacing=per_model / pixels,
    )


def _nothing() -> Fill:
    none, start = np.zeros(0, np.int32), np.zeros(1, np.int32)
    return Fill(np.zeros((0, 2)), start, start, np.zeros((0, 4), np.uint8), none, (), none, 0.0)


def _per_mm(extent: Floats, accuracy: float) -> float:
    """Points of the grid per millimetre of paper; extent (2,) millimetres."""
    wide, high = (float(e) for e in extent)
    longest = max(wide, high)
    wanted = max(1.0 / (FILL_STEP * accuracy), LEAST_A_SIDE / longest)
    return min(wanted, math.sqrt(MOST / (wide * high)), MOST_A_SIDE / longest)


def _labels(scene: Scene) -> Ints:
    """(t,) number of each triangle's face; a mesh's faces are its triangles connected without a crease."""
    face = scene.triangle_face.astype(np.int64)
    own = scene.triangle_part.astype(np.int64) * (int(face.max()) + 1) + face
    without_brep = scene.groups.without_brep[scene.triangle_group]
    if without_brep.any():
        smooth = where(lambda row: row.border and row.tangent, interior=True)[scene.edge_kind]
        inner = np.flatnonzero(smooth & (np.diff(scene.offsets) == 2))
        first = scene.offsets[:-1][inner]
        pairs = np.stack([scene.incident[first], scene.incident[first + 1]], axis=1)
        pairs = pairs[(own[pairs[:, 0]] == own[pairs[:, 1]]) & without_brep[pairs].all(axis=1)]
        # Each triangle is paired with itself as well: the components of these pairs are those of the triangles.
        alone = np.arange(len(own))
        joined = np.concatenate([np.stack([alone, alone], axis=1), pairs]).astype(np.int32)
        piece = _kernel.edge_components(np.ascontiguousarray(joined), len(own))[: len(own)].astype(np.int64)
        own = np.where(without_brep, int(own.max()) + 1 + piece, own)
    _, label = np.unique(own, return_inverse=True)
    return np.ascontiguousarray(label.ravel(), np.int32)
