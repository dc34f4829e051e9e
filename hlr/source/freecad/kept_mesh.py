"""Meshes of a FreeCAD document, which keeps each in a file of its own (.bms).

```text
bytes        content
4, 4         0xA0B0C0D0, the version
256          text
4, 4         n points, m triangles
12 n         x, y, z, float32
24 m         three points, three neighbours, uint32
24           the box
```

The numbers are in the order of bytes of the machine that wrote them, which the first of them tells.
"""

from __future__ import annotations

import numpy as np

from hlr.common.types import Floats, Ints
from hlr.source.freecad.colors import Look
from hlr.source.freecad.document import Object
from hlr.source.mesh.mesh_source import Instance
from hlr.source.mesh.objects import Meshes
from hlr.source.transforms import MatrixRows, compose, matrix4

_MAGIC = bytes.fromhex("a0b0c0d0")
_HEAD, _COUNTS, _POINT, _TRIANGLE = 264, 8, 12, 24


def read_mesh(data: bytes) -> tuple[Floats, Ints]:
    """The points (n, 3) and triangles (m, 3) of a mesh that a document keeps; of an empty file none.

    Raises:
        ValueError: it is broken; the message says why.
    """
    if not data:
        return np.zeros((0, 3)), np.zeros((0, 3), np.int32)
    order = {_MAGIC: ">", _MAGIC[::-1]: "<"}.get(data[:4])
    start = _HEAD + _COUNTS
    if order is None or len(data) < start:
        raise ValueError("is damaged: it does not begin as a mesh does")
    points, triangles = map(int, np.frombuffer(data, f"{order}u4", 2, _HEAD))
    if len(data) < start + _POINT * points + _TRIANGLE * triangles:
        raise ValueError(f"is damaged: it holds fewer than its {points} points and {triangles} triangles")
    at = np.frombuffer(data, f"{order}f4", 3 * points, start).reshape(-1, 3)
    corners = np.frombuffer(data, f"{order}u4", 6 * triangles, start + _POINT * points).reshape(-1, 6)[:, :3]
    if triangles and int(corners.max()) >= points:
        raise ValueError("is damaged: a triangle has a corner that does not exist")
    return at.astype(np.float64), corners.astype(np.int32)


class KeptMeshes:
    """The meshes of a document. What several instances have in common is read once."""

    def __init__(self) -> None:
        self._read: dict[str, tuple[Floats, Ints]] = {}

    def placed(self, thing: Object, name: str, place: MatrixRows, placed: bool, look: Look | None) -> Meshes:
        """An instance of an object's mesh. placed: by its own placement as well, inside `place`.

        Raises:
            ValueError: it is missing or broken; the message says why.
        """
        if thing.name not in self._read:
            data = thing.values.content("Mesh")
            if data is None:
                raise ValueError("is missing in the document")
            self._read[thing.name] = read_mesh(data)
        whole = compose(place, thing.values.placement("Placement")) if placed else place
        color, opacity = (None, 1.0) if look is None else (look.whole[:3], look.whole[3])
        instance = Instance(name, 0, matrix4(whole), color, opacity=opacity)
        return Meshes([self._read[thing.name]], [instance])
