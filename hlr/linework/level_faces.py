"""Faces that lay in the plane of a section before the model was cut: they are seen there, and are no cut faces.

The floor of a pocket that ends in the plane is such a face. Before it there was no material; before a cut face there
was.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.source.model import PartMesh

Booleans = npt.NDArray[np.bool_]

WEIGHTS = np.array([0.31, 0.33, 0.36])
"""Where in a triangle its point lies: nowhere that symmetry would put an edge of another triangle."""

PAIRS = 2_000_000
"""Points times triangles that are looked at together: bounds the memory."""


def with_level_faces(parts: Iterable[PartMesh], origin: Floats, normal: Floats, near: float) -> dict[str, PartMesh]:
    """Those of the parts of a whole model that have a face on a plane which looks to where its normal points, by name.

    origin, normal (3,): of the plane, the normal of length 1; near: model units
    """
    found = {}
    for part in parts:
        on = np.abs((part.points - origin) @ normal) <= near
        if not on.any():
            continue
        flat = part.triangles[on[part.triangles].all(axis=1)]
        a, b, c = part.points[flat].transpose(1, 0, 2)
        if (np.cross(b - a, c - a) @ normal > 0.0).any():
            found[part.name] = part
    return found


def cut_ones(part: PartMesh, flat: Ints, face: Ints, whole: PartMesh, normal: Floats, near: float) -> Booleans:
    """Which of the triangles (k, 3) of a part on the plane of a section were inside the whole part.

    face (k,): of each; whole: the part before it was cut; the faces of a B-rep are cut faces as a whole or not at all
    """
    a, b, c = part.points[flat].transpose(1, 0, 2)
    inside = _inside(np.einsum("c,ckx->kx", WEIGHTS, np.stack([a, b, c])), whole, normal, near)
    if not part.brep:
        return inside
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    # Beside an outline the meshes may lie aside of one another: the larger share of a face decides.
    share = np.bincount(face, area * inside) > 0.5 * np.bincount(face, area)
    return np.asarray(share[face])


def _inside(points: Floats, whole: PartMesh, normal: Floats, near: float) -> Booleans:
    """(k,) whether just before points (k, 3), in the direction of the normal, lies the inside of a part."""
    axis = np.eye(3)[int(np.argmin(np.abs(normal)))]
    right = np.cross(axis, normal) / np.linalg.norm(np.cross(axis, normal))
    frame = np.stack([right, np.cross(normal, right), normal], axis=1)
    corners, at = (whole.points @ frame)[whole.triangles], points @ frame
    corners = corners[(corners[..., 2] > at[:, 2].max() + near).any(axis=1)]
    area = _cross(corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2])
    corners, area = corners[area != 0.0], area[area != 0.0]
    found = np.zeros(len(points), bool)
    rows = max(1, PAIRS // max(len(corners), 1))
    for k in range(0, len(points), rows):
        some = at[k : k + rows, None]
        # The share of each corner, as areas of triangles with the point.
        shares = [
            _cross(corners[:, (i + 1) % 3, :2] - some[..., :2], corners[:, (i + 2) % 3, :2] - some[..., :2]) / area
            for i in range(3)
        ]
        above = sum(share * corners[:, i, 2] for i, share in enumerate(shares)) > some[..., 2] + near
        hit = np.all([share >= 0.0 for share in shares], axis=0) & above
        found[k : k + rows] = (hit * np.sign(area)).sum(axis=1) != 0.0
    return found


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
