"""The faces of meshed parts that lie on the plane of a section, by their borders."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from hlr.common.types import Floats, Ints
from hlr.source.model import PartMesh

NEAR = 1e-7
"""Of the size of a model: faces that lie so close to the plane of a section lie on it."""


@dataclass(frozen=True, slots=True, eq=False)
class CutFace:
    """A face on the plane of a section, by its border.

    part    the name of the part whose face it is
    number  of the face in the part's TopExp face map; 0 where a mesh knows no faces
    points  (n, 3) of the model
    loops   into points, counter-clockwise seen from the side of the viewer, holes clockwise
    """

    part: str
    number: int
    points: Floats
    loops: list[Ints]

    @property
    def borders(self) -> list[Floats]:
        """Each loop as points (k, 3) of the model."""
        return [self.points[loop] for loop in self.loops]


def nearness(bounds: Floats) -> float:
    """How close to the plane a face lies on it, model units; bounds (2, 3): of the model."""
    low, high = bounds
    return NEAR * float(np.linalg.norm(high - low)) + NEAR


def cut_faces(parts: Iterable[PartMesh], origin: Floats, normal: Floats, near: float) -> Iterator[CutFace]:
    """The faces on a plane that look to where its normal points.

    origin, normal (3,): of the plane, the normal of length 1; near: model units
    """
    for part in parts:
        on = np.abs((part.points - origin) @ normal) <= near
        flat = on[part.triangles].all(axis=1)
        for face in np.flatnonzero(np.bincount(part.triangle_face[flat], minlength=len(part.face_planar))).tolist():
            own = part.triangles[flat & (part.triangle_face == face)]
            a, b, c = part.points[own].transpose(1, 0, 2)
            if np.cross(b - a, c - a).sum(axis=0) @ normal > 0.0:
                yield CutFace(part.name, face, part.points, _loops(own))


def _loops(triangles: Ints) -> list[Ints]:
    """The border of triangles (m, 3) that meet edge to edge, as loops in their sense."""
    sides = {(a, b) for t in triangles.tolist() for a, b in zip(t, (*t[1:], t[0]), strict=True)}
    onward: dict[int, list[int]] = {}
    for a, b in sorted(sides):
        if (b, a) not in sides:
            onward.setdefault(a, []).append(b)
    loops = []
    while onward:
        first = at = next(iter(onward))
        loop = []
        while at in onward:
            loop.append(at)
            following = onward[at]
            then = following.pop()
            if not following:
                del onward[at]
            at = then
            if at == first:
                break
        loops.append(np.array(loop))
    return loops
