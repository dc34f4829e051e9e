"""Triangles with two corners in one place, a tenth of the mesh, and parts of loose sheets beside closed ones.

(2CylinderEngine.glb of pythonocc: 11,160 such triangles, 13,308 open edges, 34 geometries used 115 times.) A triangle
without area has no normal: taken for a fold it would draw all its edges; left out it must leave no crack.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hard.brep import same

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle
from support.meshes import BOX_EDGES, BOX_QUADS, box, split

TURN = trimesh.transformations.rotation_matrix(0.7, (1, 2, 3))


def cells(points, triangles):
    """Every triangle gets corners of its own, and each edge of a quad a second triangle from its ends to an end."""
    corners = points[triangles].reshape(-1, 3)
    numbers = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    flat = np.concatenate([numbers[:, [0, 1, 1]], numbers[:, [2, 2, 0]]])
    return corners, np.concatenate([numbers, flat])


def engine(tmp_path, spoil):
    """A closed box and an open tray, each used twice, as GLB."""
    scene = trimesh.Scene()
    points, closed = box((0, 0, 0), (0.03, 0.02, 0.01))
    for name, triangles in (("box", closed), ("tray", split(BOX_QUADS[:5]))):
        p, t = spoil(points, triangles)
        mesh = trimesh.Trimesh(p, t, process=False)
        for k, place in enumerate((np.eye(4), TURN)):
            move = place.copy()
            move[0, 3] += 0.05 * k + (0.1 if name == "tray" else 0)
            scene.add_geometry(mesh, geom_name=name, node_name=f"{name}{k}", transform=move)
    path = tmp_path / "engine.glb"
    scene.export(path)
    return path


@pytest.mark.parametrize("view", ["iso", "front", (0.3, -1, -0.4)])
def test_it_is_drawn_as_before(tmp_path, view, picture):
    sound = hlr.draw(engine(tmp_path, lambda p, t: (p, t)), view, **AT_SIZE)
    drawing = hlr.draw(engine(tmp_path, cells), view, **AT_SIZE)
    same(sound, drawing)
    assert len(drawing.parts) == 4
    if view == "iso":
        picture(drawing)


def test_one_of_them_by_the_oracle():
    points, triangles = box((0, 0, 0), (30, 20, 10))
    drawing = hlr.draw(cells(points, triangles), (1, -2, 1.5), **AT_SIZE)
    agrees(drawing, by_oracle(drawing, points, triangles, BOX_EDGES))


def test_they_are_counted(tmp_path):
    found = hlr.info(engine(tmp_path, cells))
    # Two for each of the twelve and ten triangles, both used twice.
    assert any("88 degenerate triangles" in note.text for note in found.notes)
    assert [part.closed for part in found.parts] == [False, False, True, True]
