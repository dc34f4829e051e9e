"""What lies before the plane of a section: parts that were left whole. They hide cut faces, and so their hatches."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from hlr.common.types import Floats
from hlr.pipeline.section.plane import Plane
from hlr.source.model import PartMesh


def cover_of(parts: Sequence[PartMesh], names: Collection[str], plane: Plane) -> Floats:
    """(k, 2, 3) the borders, as sides, of what lies before a plane: the faces that look to the viewer, cut at it.

    names: of the parts that may reach there; the sides run anticlockwise seen from the viewer, holes clockwise
    """
    found = [np.zeros((0, 2, 3))]
    found += [_sides(part, plane) for part in parts if part.name in names]
    return np.concatenate(found)


def _sides(part: PartMesh, plane: Plane) -> Floats:
    normal, heights = np.array(plane.normal), plane.heights(part.points)
    corners, above = part.points[part.triangles], heights[part.triangles]
    turned = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) @ normal > 0.0
    chosen = turned & (above > plane.near).any(axis=1)
    pairs = zip(corners[chosen], above[chosen], strict=True)
    sides = [side for triangle, level in pairs for side in _cut(triangle, level)]
    # What two triangles share is no border: there the sides cancel each other out.
    kept: dict[tuple[tuple[float, ...], tuple[float, ...]], int] = {}
    for a, b in sides:
        if kept.get((b, a), 0):
            kept[b, a] -= 1
        else:
            kept[a, b] = kept.get((a, b), 0) + 1
    return np.array([side for side, count in kept.items() for _ in range(count)]).reshape(-1, 2, 3)


def _cut(triangle: Floats, level: Floats) -> list[tuple[tuple[float, ...], tuple[float, ...]]]:
    """The sides of what of a triangle (3, 3) lies before the plane; level (3,): how far its corners do."""
    corners: list[tuple[float, ...]] = []
    for i in range(3):
        j = (i + 1) % 3
        if level[i] >= 0.0:
            corners.append(tuple(triangle[i].tolist()))
        if (level[i] >= 0.0) != (level[j] >= 0.0):
            # From the corner before the plane to the one behind it, so that both triangles find the same point.
            a, b = (i, j) if level[i] >= 0.0 else (j, i)
            share = level[a] / (level[a] - level[b])
            corners.append(tuple((triangle[a] + share * (triangle[b] - triangle[a])).tolist()))
    return [(a, b) for a, b in zip(corners, (*corners[1:], *corners[:1]), strict=True) if a != b]
