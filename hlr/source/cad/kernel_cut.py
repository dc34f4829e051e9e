"""Parts of a B-rep cut by a plane in the kernel: OpenCASCADE is not needed, and takes several times as long."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from itertools import accumulate
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.errors import SourceError
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.parts import Part
from hlr.source.cad.prototypes import Prototypes
from hlr.source.cad.source_builder import with_appearance
from hlr.source.model import Appearance
from hlr.source.stepped import Stepped

SAME = 12
"""Decimals of directions, and of heights over the size of a model: planes that agree in them are the same."""

BARE = "its faces are triangles without surfaces"
"""Why the kernel does not cut a part which nothing else cuts either."""


class NotHereError(Exception):
    """A model that the kernel cannot put together. The message says why."""


class KernelCut:
    """What a plane leaves of some parts of a source. Equal parts that it cuts alike are cut once.

    failed  why parts are not cut here, by name
    cut     names of the parts that it cuts
    known   names of all those of which it says what is left
    """

    def __init__(self, source: BrepSource, plane: Stepped, near: float, crossed: Collection[str]) -> None:
        """Args: plane: that does not step; near: model units; crossed: names of the parts that are cut here."""
        self._source, self._looks, self._names = source, source.appearances(), set(source.names())
        self._number: dict[str, int] = {}
        size = float(np.linalg.norm(np.subtract(*source.bounds())))
        keys: dict[tuple[float, ...], int] = {}
        cuts: list[tuple[int, list[float], float, float]] = []
        for part in source.parts:
            if part.name in crossed:
                own, turn = plane.before(part.transform), part.transform[:3, :3]
                level = float(own.levels[0])
                key = part.prototype, *np.round([*own.normal, level / size], SAME).tolist()
                self._number[part.name] = keys.setdefault(key, len(keys))
                if len(keys) > len(cuts):
                    scale = float(np.linalg.norm(turn.T @ plane.normal))
                    cuts.append((part.prototype, own.normal.tolist(), level, near / scale))
        self._parts = _kernel.CutParts(source.prototypes.model, cuts)
        # The number of the first piece of each cut.
        self._first = [0, *accumulate(len(pieces) for _, _, pieces in self._parts.found)]
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
        source, stay = self._source, {*whole, *(self.known - self.cut)}
        added = [] if others is None else others.parts
        # Prototypes that are not cut, each by whose it is and its number there.
        used = [(0, part.prototype) for part in source.parts if part.name in stay]
        used += [(1, part.prototype) for part in added]
        kept = {key: number for number, key in enumerate(dict.fromkeys(used))}
        parts: list[Part] = []
        for part in source.parts:
            if part.name in stay:
                parts.append(replace(part, product=part.name, prototype=kept[0, part.prototype]))
            elif part.name in self.cut:
                parts += self._pieces(part, len(kept))
            parts += [replace(o, prototype=kept[1, o.prototype]) for o in added if o.product == part.name]
        if not parts:
            return None
        owners = [source.prototypes, *([] if others is None else [others.prototypes])]
        try:
            model = self._parts.with_parts([(owners[of].model, number) for of, number in kept])
        except NotImplementedError as error:
            raise NotHereError(str(error)) from None
        shapes = [lambda of=of, number=number: owners[of].shapes_from_dump[number] for of, number in kept]
        found = BrepSource(source.name, source.kind, parts, CutPrototypes(model, shapes), source.notes)
        found.choice, found.reading = source.choice, source.reading
        return found

    def _pieces(self, part: Part, before: int) -> list[Part]:
        """What is left of a part that is cut. before: prototypes before those of pieces."""
        number, look = self._number[part.name], self._looks[part.name]
        first, own = before + self._first[number], self._parts.found[number][2]
        names = [part.name] if len(own) == 1 else [self._unique(f"{part.name}:{k}") for k in range(1, len(own) + 1)]
        return [
            with_appearance(replace(part, name=name, product=part.name, prototype=first + k), _look(look, faces))
            for k, (name, faces) in enumerate(zip(names, own, strict=True))
        ]

    def _unique(self, name: str) -> str:
        number, found = 1, name
        while found in self._names:
            number += 1
            found = f"{name}:{number}"
        self._names.add(found)
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
