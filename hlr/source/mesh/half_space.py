"""Meshes cut by a plane, by manifold3d: what lies on one side of it is taken away, and bodies are closed there."""

from __future__ import annotations

import numpy as np

from hlr.common.types import Floats, Ints
from hlr.errors import SourceError
from hlr.source.model import PartMesh


def cut_mesh(
    part: PartMesh, origin: Floats, normal: Floats, file: str, alone: bool = True
) -> tuple[Floats, Ints] | None:
    """Points (n, 3) and triangles (m, 3) of a part without what lies on the side to which the normal points.

    origin, normal (3,): of the plane, the normal of length 1; file: what the source is called;
    alone: the part is all of it. None: nothing is left.

    Raises:
        SourceError: the part is not closed, so that it has no inside.
    """
    from manifold3d import Manifold, Mesh64

    # Numbers near zero lose nothing where the plane is set against them.
    middle = 0.5 * (part.points.min(axis=0) + part.points.max(axis=0))
    mesh = Mesh64(part.points - middle, part.triangles.astype(np.uint64))
    mesh.merge()
    body = Manifold(mesh)
    if body.status().name == "NoError" and body.volume() < 0.0:  # turned inside out
        mesh = Mesh64(part.points - middle, part.triangles[:, ::-1].astype(np.uint64, order="C"))
        mesh.merge()
        body = Manifold(mesh)
    if body.status().name != "NoError" or body.is_empty():
        whole = "" if alone else "keep it whole (uncut), "
        raise SourceError(
            f'Part "{part.name}" of {file} cannot be cut for a section, because its triangles do not close: repair the '
            f"mesh, {whole}or draw the CAD model that it was made of."
        )
    left = body.trim_by_plane((-normal).tolist(), float((middle - origin) @ normal)).to_mesh64()
    if not len(left.tri_verts):
        return None
    return np.asarray(left.vert_properties)[:, :3] + middle, np.asarray(left.tri_verts).astype(np.int32)
