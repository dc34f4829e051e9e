"""Colours of mesh parts: from materials, else from vertices or faces."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Ints, Rgba
from hlr.source.mesh.cleaning import CleanMesh
from hlr.source.model import Appearance, PartMesh, rgba
from hlr.source.transforms import determinant_sign

Corners = npt.NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class FileColors:
    """Colours of a file: (k, 4) uint8, one per point of the triangles (m, 3); one per triangle where that is None."""

    colors: npt.NDArray[np.uint8]
    triangles: Ints | None


def mesh_appearance(part: PartMesh, mesh: Any, clean: CleanMesh, opacity: float = 1.0) -> Appearance:
    """How a part looks. mesh: the trimesh object or `FileColors` it comes from, or None; clean: its mesh as cleaned.

    opacity: of its colour where it has no material
    """
    visual = getattr(mesh, "visual", None)
    material = getattr(visual, "material", None)
    whole: Rgba | None = rgba(part.color, opacity if material is None else _opacity(material))
    corners = None
    # Unreadable colours are no reason to refuse a model, and trimesh raises any exception for broken tables.
    with suppress(Exception):
        corners = _corners(mesh, visual, material, clean)
    if corners is None:
        return Appearance(whole)
    if determinant_sign(part.transform) < 0:  # the part's triangles are reversed then
        corners = corners[:, [0, 2, 1]]
    first = corners[0, 0]
    if (corners == first).all():
        r, g, b, a = (round(float(c), 6) for c in first)
        return Appearance((r, g, b, a))
    return Appearance(whole, corners=np.ascontiguousarray(corners), points=part.points, triangles=part.triangles)


def _opacity(material: Any) -> float:
    """Opacity of a material, 0 to 1. In glTF the fourth number of a colour counts only in the alpha mode BLEND."""
    factor = getattr(material, "baseColorFactor", None)
    if factor is not None and str(getattr(material, "alphaMode", None) or "OPAQUE").upper() != "BLEND":
        return 1.0
    values = np.asarray(factor if factor is not None else getattr(material, "diffuse", None))
    if values.shape != (4,):
        return 1.0
    return float(values[3]) / (255.0 if values.dtype.kind in "ui" else 1.0)


def _corners(mesh: Any, visual: Any, material: Any, clean: CleanMesh) -> Corners | None:
    """(m, 3, 4) sRGB and opacity; None where the part has one colour."""
    if isinstance(mesh, FileColors):
        if mesh.triangles is not None:
            return np.asarray(_scaled(mesh.colors)[clean.of_corners(mesh.triangles)])
        return np.repeat(_scaled(clean.of_triangles(mesh.colors))[:, None], 3, axis=1)
    kind = getattr(visual, "kind", None)
    if kind == "vertex":
        return np.asarray(_scaled(visual.vertex_colors)[clean.of_corners(np.asarray(mesh.faces))])
    if kind == "face":
        return np.repeat(clean.of_triangles(_scaled(visual.face_colors))[:, None], 3, axis=1)
    image = getattr(material, "image", None)
    image = getattr(material, "baseColorTexture", None) if image is None else image
    if kind == "texture" and image is not None and visual.uv is not None:
        # A texture is sampled at the vertices only.
        return np.asarray(_scaled(visual.to_color().vertex_colors)[clean.of_corners(np.asarray(mesh.faces))])
    return None


def _scaled(colors: Any) -> Corners:
    table = np.asarray(colors)
    values = table.astype(np.float32) / (np.float32(255.0) if table.dtype.kind in "ui" else np.float32(1.0))
    if values.shape[1] == 3:
        values = np.concatenate([values, np.ones((len(values), 1), np.float32)], axis=1)
    return np.asarray(np.clip(values, 0.0, 1.0), np.float32)
