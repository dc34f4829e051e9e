"""A mesh with a wire: an edge without triangles, for what the kernel says of a single line."""

from __future__ import annotations

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints


def mesh_with_wire(points: Floats, triangles: Ints, ends: tuple[int, int]) -> tuple[_kernel.Mesh, int]:
    """The mesh of triangles (t, 3) among points (n, 3), and the number of the wire, its last edge. ends: two points."""
    edges, offsets, incident = _kernel.edge_table(triangles, len(points))
    every = np.concatenate([edges, np.array([ends], np.int32)])
    return _kernel.Mesh(points, triangles, every, np.append(offsets, offsets[-1]).astype(np.int32), incident), len(
        edges
    )
