"""Faces that are nothing but triangles, as tessellated STEP has them: planes stay flat beside rounds of few facets."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

from hlr.scene.build import build
from hlr.shading.normals import corner_normals
from hlr.source import open_source

PLANES = [0, 2]


def face(points, triangles):
    """A face without surface."""
    from OCP.BRep import BRep_Builder
    from OCP.gp import gp_Pnt
    from OCP.Poly import Poly_Triangle, Poly_Triangulation
    from OCP.TopoDS import TopoDS_Face

    mesh, made = Poly_Triangulation(len(points), len(triangles), False), TopoDS_Face()
    for i, point in enumerate(points):
        mesh.SetNode(i + 1, gp_Pnt(*map(float, point)))
    for i, (a, b, c) in enumerate(triangles):
        mesh.SetTriangle(i + 1, Poly_Triangle(a + 1, b + 1, c + 1))
    BRep_Builder().MakeFace(made, mesh)
    return cq.Face(made)


def strip(profile):
    """A profile (n, 2) in x and z, drawn out along y."""
    n = len(profile)
    points = [(x, y, z) for y in (0.0, 40.0) for x, z in profile]
    quads = [(i, i + 1, n + i + 1, n + i) for i in range(n - 1)]
    return face(points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


@pytest.fixture(scope="module")
def scene():
    """A wall, a round of 72 degrees in three facets, and a top: each folds against the next by 24 degrees or 12."""
    angles = np.radians([0, 24, 48, 72])
    arc = np.stack([10 * np.cos(angles), 10 * np.sin(angles)], axis=1)
    way = np.array([-np.sin(angles[-1]), np.cos(angles[-1])])
    shape = cq.Compound.makeCompound([strip([(10, -30), arc[0]]), strip(arc), strip([arc[-1], arc[-1] + 30 * way])])
    source = open_source(shape)
    return build(source.mesh(0.1, 0.3), 30.0, 0.1)


def test_faces_of_the_file_are_kept(scene):
    assert np.bincount(scene.triangle_face).tolist() == [2, 6, 2]
    assert not (scene.edge_kind == 0).any(), "nothing there is a crease"


def test_planes_have_their_own_normal_and_give_it_to_the_round(scene):
    normals, corner = corner_normals(scene)
    on_plane = np.isin(scene.triangle_face, PLANES)
    for number in PLANES:
        assert len(np.unique(corner[scene.triangle_face == number])) == 1
    for number, at in ((0, 0.0), (2, 72.0)):
        shared = np.intersect1d(scene.triangles[scene.triangle_face == number], scene.triangles[~on_plane])
        there = np.isin(scene.triangles, shared) & ~on_plane[:, None]
        expected = np.cos(np.radians(at)), 0.0, np.sin(np.radians(at))
        assert there.sum() == 3
        for corners in (corner[there], corner[scene.triangle_face == number]):
            assert np.abs(np.abs(normals[corners]) - expected).max() < 1e-6
