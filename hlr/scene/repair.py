"""Per part, before anything is built on it: drop what cannot be seen or is there twice."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hlr.source.model import Ints, PartMesh


def without_duplicates(part: PartMesh) -> tuple[PartMesh, int]:
    """The part without repeated triangles (same corners, either orientation), and how many there were.

    Of several the first is kept: duplicated faces neither hide more nor bound a volume, but they would make every edge
    between them non-manifold.
    """
    triangles = part.triangles
    if len(triangles) == 0:
        return part, 0
    corners = np.sort(triangles, axis=1).astype(np.int64)
    n = np.int64(len(part.points))
    # Three indices do not fit 64 bits for large meshes: the first two are ranked, then joined with the third.
    _, pair = np.unique(corners[:, 0] * n + corners[:, 1], return_inverse=True)
    _, first = np.unique(pair.ravel() * n + corners[:, 2], return_index=True)
    if len(first) == len(triangles):
        return part, 0
    keep: Ints = np.sort(first).astype(np.int32)
    on = part.on_surfaces
    kept = replace(
        part,
        triangles=triangles[keep],
        triangle_face=part.triangle_face[keep],
        on_surfaces=replace(on, corner=on.corner[keep]) if on is not None else None,
    )
    return kept, len(triangles) - len(keep)
