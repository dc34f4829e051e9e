"""What lies before the planes of a section: parts that were left whole. They hide cut faces, and so their hatches."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence

import numpy as np

from hlr.common.types import Floats
from hlr.source.mesh.clipping import split_at
from hlr.source.model import PartMesh
from hlr.source.stepped import Stepped


def cover_of(parts: Sequence[PartMesh], names: Collection[str], planes: Stepped, near: float) -> Floats:
    """(k, 2, 3) the borders, as sides, of what lies before planes: the faces that look to the viewer, cut at them.

    names: of the parts that may reach there; near: of a plane, model units
    The sides run anticlockwise seen from the viewer, holes clockwise.
    """
    found = [np.zeros((0, 2, 3))]
    found += [_sides(part, planes, near) for part in parts if part.name in names]
    return np.concatenate(found)


def _sides(part: PartMesh, planes: Stepped, near: float) -> Floats:
    corners = part.points[part.triangles]
    turned = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) @ planes.normal > 0.0
    found = split_at(part.points, part.triangles[turned], planes, near)
    ahead = found.triangles[planes.heights(found.points[found.triangles].mean(axis=1)) > near]
    # What two triangles share is no border: there the sides cancel each other out.
    kept: Counter[tuple[int, int]] = Counter()
    for a, b in ahead[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist():
        if kept[b, a]:
            kept[b, a] -= 1
        else:
            kept[a, b] += 1
    return np.asarray(found.points[np.array(list(kept.elements()), int).reshape(-1, 2)])
