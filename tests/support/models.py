"""Small models with known drawings."""

from __future__ import annotations

from typing import Any

import numpy as np
import trimesh

Size = tuple[float, float, float]


def box(size: Size, centre: Size = (0.0, 0.0, 0.0)) -> trimesh.Trimesh:
    """A closed box, outward."""
    mesh = trimesh.creation.box(size)
    mesh.apply_translation(centre)
    return mesh


def parts(*meshes: trimesh.Trimesh) -> trimesh.Scene:
    """Several parts in this order, named part0, part1..."""
    scene = trimesh.Scene()
    for i, mesh in enumerate(meshes):
        scene.add_geometry(mesh, node_name=f"node{i}", geom_name=f"part{i}")
    return scene


def solids(*sizes: tuple[Size, Size]) -> Any:
    """The same as B-rep: an assembly of boxes, each given by size and centre."""
    import cadquery as cq

    assembly = cq.Assembly()
    for i, (size, centre) in enumerate(sizes):
        assembly.add(cq.Workplane().box(*size).translate(centre), name=f"part{i}")
    return assembly


def sheet(size: float, z: float) -> trimesh.Trimesh:
    """An open square, parallel to the ground."""
    h = size / 2
    corners = [[-h, -h, z], [h, -h, z], [h, h, z], [-h, h, z]]
    return trimesh.Trimesh(corners, [[0, 1, 2], [0, 2, 3]], process=False)


def turned(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """The same surface, inside out."""
    return trimesh.Trimesh(mesh.vertices, mesh.faces[:, ::-1], process=False)


def rotation(axis: Size, angle: float) -> np.ndarray:
    """(3, 3), radians."""
    return trimesh.transformations.rotation_matrix(angle, axis)[:3, :3]
