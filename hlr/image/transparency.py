"""Transparent parts: an image in which they hide nothing, though their own lines are drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from hlr.drawing.notes import Note
from hlr.image.image import Image
from hlr.scene.colors import corner_colors
from hlr.scene.scene import Scene
from hlr.source.model import Appearance
from hlr.tables.line_classes import EdgeClass


def opacity_of(look: Appearance) -> float:
    """The least opacity of a part."""
    found = [1.0 if look.whole is None else look.whole[3], *(color[3] for color in look.faces.values())]
    if look.corners is not None:
        found.append(float(look.corners[..., 3].min(initial=1.0)))
    return min(found)


def glass_of(scene: Scene, looks: Mapping[str, Appearance]) -> npt.NDArray[np.bool_]:
    """(t,) bool: the triangle is transparent at one corner at least."""
    colours, paint = corner_colors(scene, looks)
    return np.asarray((colours[:, 3] < 1.0)[paint].any(axis=1))


def hiding(scene: Scene, looks: Mapping[str, Appearance]) -> list[Note]:
    """The remark that transparent parts hide others, where they may."""
    if not looks or len(scene.parts) < 2:
        return []
    clear = [p.name for p in scene.parts.labels if opacity_of(looks.get(p.name, Appearance())) < 1.0]
    if not clear:
        return []
    which = f'Part "{clear[0]}" is transparent and hides' if len(clear) == 1 else f"{len(clear)} transparent parts hide"
    cure = "--see-through shows it (in Python, see_through=True)"
    return [Note("glass-hides", f"{which} what is behind, as in other CAD drawings: {cure}.")]


def without_glass(image: Image, glass: npt.NDArray[np.bool_]) -> Image:
    """The image without the triangles of glass (t,) bool: they hide nothing. Edges of glass alone stay as wires."""
    kept = ~glass
    number = np.cumsum(kept, dtype=np.int32) - 1
    held = kept[image.incident]
    per_edge = np.add.reduceat(np.append(held, False), image.offsets[:-1]) if len(image.edges) else np.zeros(0, int)
    # For an edge without triangles reduceat gives the next value: its count is zero.
    per_edge = np.where(np.diff(image.offsets) > 0, per_edge, 0)
    opened = np.zeros(len(image.groups), bool)
    opened[image.triangle_group[glass]] = True
    silhouettes = image.silhouettes
    if silhouettes is not None:
        # An intersection line may be that of glass with another part.
        silhouettes = silhouettes.opened(opened[image.edge_group] | (image.edge_kind == EdgeClass.INTERSECTION))
    surfaces = image.true_surfaces
    return replace(
        image,
        triangles=np.ascontiguousarray(image.triangles[kept]),
        triangle_part=image.triangle_part[kept],
        triangle_group=np.ascontiguousarray(image.triangle_group[kept]),
        triangle_face=image.triangle_face[kept],
        triangle_origin=image.triangle_origin[kept],
        turned=image.turned[kept],
        facets=None if image.facets is None else image.facets[kept],
        offsets=np.concatenate([[0], np.cumsum(per_edge)]).astype(np.int32),
        incident=np.ascontiguousarray(number[image.incident[held]], np.int32),
        groups=image.groups.opened(opened),
        true_surfaces=None if surfaces is None else replace(surfaces, corner=surfaces.corner[kept]),
        silhouettes=silhouettes,
        convex=False,
    )
