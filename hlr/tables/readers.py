"""File endings: what is read, and what else belongs to a model."""

from __future__ import annotations

ENDINGS = {
    ".step": "step",
    ".stp": "step",
    ".iges": "iges",
    ".igs": "iges",
    ".brep": "brep",
    ".brp": "brep",
    ".py": "script",
    ".stl": "stl",
    ".obj": "obj",
    ".ply": "ply",
    ".off": "off",
    ".3mf": "3mf",
    ".glb": "glb",
}
"""What is read, by file ending."""

BESIDE = (".mtl", ".gltf")
"""What models refer to, or are kept in, without being read."""
