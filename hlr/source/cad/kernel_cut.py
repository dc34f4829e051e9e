"""Parts of a B-rep cut by a plane in the kernel: OpenCASCADE is not needed, and takes several times as long."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import Any

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

BARE = "its faces are triangles without surfaces"
"""Why the kernel does not cut a part which nothing else cuts either."""


class NotHereError(Exception):
    """A model that the kernel cannot put together. The message says why."""


@dataclass(frozen=True, slots=True)
class PartPlane:
    """A plane in the frame of a part. normal (3,) of length 1; level: along it; near: what counts as on it."""

    normal: Floats
    level: float
    near: float

    def before(self, transform: Floats) -> PartPlane:
        """The same plane before a placement (4, 4), which may scale."""
        turned = transform[:3, :3].T @ self.normal
        scale = float(np.linalg.norm(turned))
        return PartPlane(turned / scale, float(self.level - transform[:3, 3] @ self.normal) / scale, self.near / scale)


class KernelCut:
    """What a plane leaves of some parts of a source. Equal parts that it cuts alike are cut once.

    failed  why parts are not cut here, by name
    cut     names of the parts that it cuts
    known   names of all those of which it says what is left
    """

    def __init__(self, source: BrepSource, plane: PartPlane | None, crossed: Collection[str]) -> None:
        """Args: crossed: names of the parts that the plane may cut; plane: None: no part is cut here."""
        self._source = source
        self._number: dict[str, int] = {}
        size = float(np.linalg.norm(np.subtract(*source.bounds())))
        keys: dict[tuple[float, ...], int] = {}
        cuts: list[tuple[int, list[float], float, float]] = []
        for part in source.parts:
            if plane is not None and part.name in crossed:
                own = plane.before(part.transform)
                key = part.prototype, *np.round([*own.normal, own.level / size], SAME).tolist()
                self._number[part.name] = keys.setdefault(key, len(keys))
                if len(keys) > len(cuts):
                    cuts.append((part.prototype, own.normal.tolist(), own.level, own.near))
        self._parts = _kernel.CutParts(source.prototypes.model, cuts)
        found = {name: self._parts.found[number] for name, number in self._number.items()}
        self.failed = {name: why for name, (why, _, _) in found.items() if why is not None}
        self.known = frozenset(found.keys() - self.failed.keys())
        self.cut = frozenset(name for name, (_, is_cut, _) in found.items() if is_cut)

    def joined(self, whole: Collection[str], others: BrepSource | None) -> BrepSource | None:
        """A source of what is left, and of other parts; None where that is nothing.

        whole: names of the parts that stay as they are; others: pieces of more of them, by their products

        Raises:
            NotHereError: a part has no frame of its own.
        """
        models = [self._source.prototypes] if others is None else [self._source.prototypes, others.prototypes]
        kept: dict[tuple[int, int], int] = {}
        placed: list[tuple[Part, tuple[int, int] | int]] = []
        looks, names = self._source.appearances(), set(self._source.names())
        first: list[int] = [0]
        for _, _, pieces in self._parts.found:
            first.append(first[-1] + len(pieces))
        for part in self._source.parts:
            stays = part.name in whole or part.name in self.known - self.cut
            if stays:
                placed.append((replace(part, product=part.name), (0, part.prototype)))
            elif part.name in self.cut:
                number = self._number[part.name]
                pieces = self._parts.found[number][2]
                for k, faces in enumerate(pieces):
                    name = part.name if len(pieces) == 1 else _unique(f"{part.name}:{k + 1}", names)
                    piece = with_appearance(replace(part, name=name, product=part.name), _look(looks[part.name], faces))
                    placed.append((piece, first[number] + k))
            elif others is not None:
                own = [other for other in others.parts if other.product == part.name]
                placed += [(other, (1, other.prototype)) for other in own]
        if not placed:
            return None
        for _, at in placed:
            if isinstance(at, tuple):
                kept.setdefault(at, len(kept))
        try:
            model = self._parts.with_parts([(models[of].model, number) for of, number in kept])
        except NotImplementedError as error:
            raise NotHereError(str(error)) from None
        shapes = [lambda of=of, number=number: models[of].shapes_from_dump[number] for of, number in kept]
        parts = [replace(part, prototype=kept[at] if isinstance(at, tuple) else len(kept) + at) for part, at in placed]
        found = BrepSource(
            self._source.name, self._source.kind, parts, CutPrototypes(model, shapes), self._source.notes
        )
        found.choice, found.reading = self._source.choice, self._source.reading
        return found


class CutPrototypes(Prototypes):
    """Prototypes of which the kernel has cut some, those behind the others."""

    def __init__(self, model: _kernel.BrepModel, shapes: Sequence[Callable[[], Any]]) -> None:
        """Args: shapes: find the shapes of OpenCASCADE of those that are not cut."""
        self.model, self._whole = model, shapes

    @property
    def dump(self) -> bytes:  # type: ignore[override]
        """They have none. Raises SourceError."""
        raise SourceError("parts that a section has cut are not shapes of OpenCASCADE.")

    def failed_faces(self, chosen: Sequence[int], failed: Collection[int]) -> dict[int, Any]:
        """As of `Prototypes`; None for faces that only the kernel has."""
        from hlr.source.cad.rescue import face_in_part

        # Each part has its own faces, one part after the other.
        ends = np.cumsum(self.counts[:, 0])
        found: dict[int, Any] = {}
        for face in failed:
            part = int(np.searchsorted(ends, face, side="right"))
            begin = int(ends[part - 1]) if part else 0
            found[face] = face_in_part(self._whole[part](), face - begin) if part < len(self._whole) else None
        return found


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
