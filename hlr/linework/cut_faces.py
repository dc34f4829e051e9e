"""The faces of meshed parts that lie on the plane of a section, by their borders."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from hlr.common.types import Floats, Ints
from hlr.linework.level_faces import Booleans, cut_ones
from hlr.source.model import PartMesh

Whole = Callable[[str], PartMesh | None]
"""Of the name of a part: that part before it was cut."""

NEAR = 1e-7
"""Of the size of a model: faces that lie so close to the plane of a section lie on it."""


@dataclass(frozen=True, slots=True, eq=False)
class CutFace:
    """A face on the plane of a section, by its border.

    part    the name of the part whose face it is
    number  of the face in the part's TopExp face map; 0 where a mesh knows no faces
    points  (n, 3) of the model
    loops   into points, counter-clockwise seen from the side of the viewer, holes clockwise
    rims    into points: the parts of its border at which a face goes on that lay in the plane before
    """

    part: str
    number: int
    points: Floats
    loops: list[Ints]
    rims: list[Ints]

    @property
    def borders(self) -> list[Floats]:
        """Each loop as points (k, 3) of the model."""
        return [self.points[loop] for loop in self.loops]


def nearness(bounds: Floats, brep: bool = True) -> float:
    """How close to the plane a face lies on it, model units.

    bounds (2, 3): of the model; brep: OpenCASCADE cuts it, which takes what is closer than 1e-7 mm for the same
    """
    low, high = bounds
    return NEAR * float(np.linalg.norm(high - low)) + (NEAR if brep else 0.0)


def cut_faces(
    parts: Iterable[PartMesh], origin: Floats, normal: Floats, near: float, whole: Whole = lambda _: None
) -> Iterator[CutFace]:
    """The faces on a plane that look to where its normal points.

    origin, normal (3,): of the plane, the normal of length 1; near: model units; whole: of the name of a part, that
    part before it was cut, where it had faces on the plane then, which are no cut faces
    """
    for part in parts:
        cut, level = _on_plane(part, origin, normal, near, whole)
        yield from _faces(part, cut, part.triangles[level], normal)


def level_faces(
    parts: Iterable[PartMesh], origin: Floats, normal: Floats, near: float, whole: Whole
) -> Iterator[CutFace]:
    """The faces on a plane that look to where its normal points and lay there before the model was cut.

    They have no rims. Arguments as of `cut_faces`.
    """
    for part in parts:
        yield from _faces(part, _on_plane(part, origin, normal, near, whole)[1], part.triangles[:0], normal)


def _on_plane(part: PartMesh, origin: Floats, normal: Floats, near: float, whole: Whole) -> tuple[Booleans, Booleans]:
    """Which triangles of a part are of cut faces, and which lay on the plane before."""
    on = np.abs((part.points - origin) @ normal) <= near
    cut = np.asarray(on[part.triangles].all(axis=1), np.bool_)
    level, before = np.zeros(len(cut), np.bool_), whole(part.name) if cut.any() else None
    if before is not None:
        numbers = np.flatnonzero(cut)
        level[numbers] = ~cut_ones(part, part.triangles[numbers], part.triangle_face[numbers], before, normal, near)
    if part.brep:
        # A plane leaves flat faces. Triangles of a curved one lie on it where it nearly touches that face.
        cut &= part.face_planar[part.triangle_face]
    return cut & ~level, level


def _faces(part: PartMesh, chosen: Booleans, others: Ints, normal: Floats) -> Iterator[CutFace]:
    """The faces of chosen triangles that look to where the normal points; others (m, 3): triangles beside them."""
    for face in np.flatnonzero(np.bincount(part.triangle_face[chosen], minlength=len(part.face_planar))).tolist():
        own = part.triangles[chosen & (part.triangle_face == face)]
        a, b, c = part.points[own].transpose(1, 0, 2)
        if np.cross(b - a, c - a).sum(axis=0) @ normal > 0.0:
            yield CutFace(part.name, face, part.points, _loops(own), _rims(own, others))


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


def _rims(triangles: Ints, others: Ints) -> list[Ints]:
    """Where triangles (m, 3) border on others, as lines as long as can be; closed ones end where they begin."""
    beyond = {(b, a) for t in others.tolist() for a, b in zip(t, (*t[1:], t[0]), strict=True)}
    sides = sorted(
        (a, b) for t in triangles.tolist() for a, b in zip(t, (*t[1:], t[0]), strict=True) if (a, b) in beyond
    )
    onward: dict[int, list[int]] = {}
    for a, b in sides:
        onward.setdefault(a, []).append(b)
    entered = {b for _, b in sides}
    begins = [a for a in onward if a not in entered]
    rims = []
    while onward:
        at = begins.pop(0) if begins else next(iter(onward))
        rim = [at]
        while at in onward:
            following = onward[at]
            then = following.pop()
            if not following:
                del onward[at]
            rim.append(then)
            at = then
        rims.append(np.array(rim))
    return rims
