"""Models that are triangles from the start: mesh files, arrays, objects of trimesh and manifold3d."""
