"""Parts of a B-rep cut by a plane in the kernel: OpenCASCADE is not needed, and takes ten to fifty times as long."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats
from hlr.errors import SourceError
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.parts import Part
from hlr.source.cad.prototypes import Prototypes
from hlr.source.cad.source_builder import with_appearance
from hlr.source.model import Appearance

SAME = 12
"""Decimals of directions, and of heights over the size of a model: planes that agree in them are the same."""


class NotHereError(Exception):
    """A part that the kernel cannot cut. The message says why."""


@dataclass(frozen=True, slots=True)
class Left:
    """What a plane leaves of a source.

    source  None where nothing is left
    cut     names of the parts that it has cut
    bare    names of those that cannot be cut, because their faces are triangles without surfaces: they stay whole
    """

    source: BrepSource | None
    cut: frozenset[str]
    bare: frozenset[str]


@dataclass(frozen=True, slots=True)
class PartPlane:
    """A plane in the frame of a prototype. normal (3,) of length 1; level: along it; near: what counts as on it."""

    normal: Floats
    level: float
    near: float

    def before(self, transform: Floats) -> PartPlane:
        """The same plane before a placement (4, 4), which may scale."""
        turned = transform[:3, :3].T @ self.normal
        scale = float(np.linalg.norm(turned))
        return PartPlane(turned / scale, float(self.level - transform[:3, 3] @ self.normal) / scale, self.near / scale)


class CutPrototypes(Prototypes):
    """Prototypes that a plane has cut. The kernel alone has them: OpenCASCADE meshes none of their faces."""

    in_opencascade = False

    def __init__(self, model: _kernel.BrepModel) -> None:
        self.model = model

    @property
    def dump(self) -> bytes:  # type: ignore[override]
        """They have none. Raises SourceError."""
        raise SourceError("parts that a section has cut are not shapes of OpenCASCADE.")


def cut_in_kernel(source: BrepSource, plane: PartPlane, whole: Collection[str], crossed: Collection[str]) -> Left:
    """A source without what lies beyond a plane; parts of names that are not given lie there.

    whole, crossed: names of the parts that stay as they are, and of those that the plane may cut

    Raises:
        NotHereError: the kernel cannot cut a part.
    """
    size = float(np.linalg.norm(np.subtract(*source.bounds())))
    stay, keys = set(whole), set(crossed)
    kept: dict[int, int] = {}
    cuts: dict[tuple[float, ...], int] = {}
    planes: list[tuple[int, list[float], float, float]] = []
    of_part: dict[str, int] = {}
    for part in source.parts:
        if part.name in stay:
            of_part[part.name] = kept.setdefault(part.prototype, len(kept))
        elif part.name in keys:
            own = plane.before(part.transform)
            key = part.prototype, *np.round([*own.normal, own.level / size], SAME).tolist()
            of_part[part.name] = cuts.setdefault(key, len(cuts))
            if of_part[part.name] == len(planes):
                planes.append((part.prototype, own.normal.tolist(), own.level, own.near))
    try:
        model, found = _kernel.cut_parts(source.prototypes.model, planes, list(kept))
    except NotImplementedError as error:
        raise NotHereError(str(error)) from None
    looks = source.appearances()
    parts: list[Part] = []
    names: set[str] = {part.name for part in source.parts}
    for part in source.parts:
        if part.name in stay:
            parts.append(_as(part, part.name, of_part[part.name], looks[part.name]))
        elif part.name in keys:
            is_cut, _, pieces = found[of_part[part.name]]
            for number, (prototype, faces) in enumerate(pieces, 1):
                name = part.name if len(pieces) == 1 else _unique(f"{part.name}:{number}", names)
                parts.append(_as(part, name, prototype, _look(looks[part.name], faces) if is_cut else looks[part.name]))
    cut, bare = (frozenset(name for name in keys & of_part.keys() if found[of_part[name]][which]) for which in (0, 1))
    if not parts:
        return Left(None, cut, bare)
    left = BrepSource(source.name, source.kind, parts, CutPrototypes(model), source.notes)
    left.choice, left.reading = source.choice, source.reading
    return Left(left, cut, bare)


def _as(part: Part, name: str, prototype: int, look: Appearance) -> Part:
    """A piece of a part, in its place."""
    return with_appearance(replace(part, name=name, product=part.name, prototype=prototype), look)


def _look(look: Appearance, faces: list[int]) -> Appearance:
    """The colours of a piece. faces: which face of the part each of its own was; -1: none."""
    return Appearance(look.whole, {k: look.faces[of] for k, of in enumerate(faces) if of in look.faces})


def _unique(name: str, known: set[str]) -> str:
    number, found = 1, name
    while found in known:
        number += 1
        found = f"{name}:{number}"
    known.add(found)
    return found
