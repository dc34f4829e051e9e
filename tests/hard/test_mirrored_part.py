"""A part placed by a transform that mirrors: its triangles run the other way round, so inside and outside swap."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle
from support.meshes import BOX_EDGES, box, merged, moved

MIRRORS = [np.diag(d) for d in ((-1.0, 1, 1, 1), (1, -1, 1, 1), (1, 1, -1, 1), (-1, -1, -1, 1), (-2, 1, 0.5, 1))]


@pytest.mark.parametrize("mirror", MIRRORS)
@pytest.mark.parametrize("view", ["iso", (2, 1, -1), "front"])
def test_it_is_drawn_like_the_mirrored_mesh(picture, mirror, view):
    # A post on a slab, off the middle, so that no mirror image is the part itself.
    slab, post = box((2, 1, -1), (14, 9, 3)), box((3, 2, 3), (6, 4, 11))
    scene = trimesh.Scene()
    for name, mesh in (("slab", slab), ("post", post)):
        scene.add_geometry(
            trimesh.Trimesh(*mesh, process=False), geom_name=name, node_name=name + "-node", transform=mirror
        )
    drawing = hlr.draw(scene, view, **AT_SIZE)
    points, triangles = moved(merged(slab, post), lambda p: p @ mirror[:3, :3].T)
    edges = [*BOX_EDGES, *((i + 8, j + 8) for i, j in BOX_EDGES)]
    agrees(drawing, by_oracle(drawing, points, triangles, edges), step=0.3)
    if mirror is MIRRORS[0] and view == "iso":
        picture(drawing)
    assert all(part.defects == () for part in hlr.info(scene).parts)
