"""Parts that repeat another one in the same place: they are drawn as one, as n of them would take n times n as long."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.drawing.notes import Note
from hlr.source.model import Appearance
from hlr.source.part_meshes import PartLabel, PartMeshes

if TYPE_CHECKING:
    from hlr.source.cad.parts import Part

Looks = Callable[[], Mapping[str, Appearance]]
"""How the parts look, by name: asked only where one of them repeats another."""

ONE_PLACE = 1e-6
"""Of a part's size: equal parts this close are said to lie in one place. Those of a sheet's thickness are not."""

OF_THICKNESS = 0.25
"""Of a part's thickness: equal parts that are farther apart are not one. In a pile of thin ones every other one would
be left out, and what lies behind would be seen between the rest."""

MAX_NOTES = 5
"""Places with a note of their own; one more note has the number of all others."""


@dataclass(frozen=True, slots=True)
class Repeats:
    """Parts that repeat another one.

    of: by the number of each that was left out, the part that it repeats, which is there
    places: numbers of equal parts that lie in one place, whatever they look like
    """

    of: Mapping[int, int]
    places: Sequence[Sequence[int]]

    def notes(self, labels: Sequence[PartLabel | Part]) -> list[Note]:
        """One note per place, MAX_NOTES at most, and one for all others."""
        texts = [_said([labels[i].name for i in place]) for place in self.places[:MAX_NOTES]]
        more = len(self.places) - len(texts)
        if more:
            texts.append(f"Equal parts lie in one place at {more} more place{'s' if more > 1 else ''}.")
        return [Note("parts-repeated", text) for text in texts]


def without_repeats(whole: PartMeshes, near: float, looks: Looks) -> tuple[Repeats, PartMeshes]:
    """Which parts repeat an earlier one, and the parts with the meshes of all others alone.

    near: how far a point may be from its copy at most, model units; less in thin parts. The parts look the same, too.
    """
    tables = whole.tables
    parts, firsts, apart = tables.repeats(near) if len(tables) > 1 and near > 0.0 else _NONE
    if not len(parts):
        return Repeats({}, []), whole
    look, labels, of = looks(), whole.labels, {}
    places: dict[int, list[int]] = {}
    unlike: dict[int, list[int]] = {}  # in one place with a part, and of other looks than it and one another
    for part, first, distance in zip(parts.tolist(), firsts.tolist(), apart.tolist(), strict=True):
        there = distance <= ONE_PLACE * _size(tables, first)
        if not there and distance > OF_THICKNESS * _thickness(tables, first):
            continue
        stand = [first, *unlike.get(first, ())] if there else [first]
        like = [i for i in stand if _look_alike(labels[i], labels[part], look)]
        if like:
            of[part] = like[0]
        elif there:
            unlike.setdefault(first, []).append(part)
        if there:
            places.setdefault(first, [first]).append(part)
    left_out = np.zeros(len(tables), bool)
    left_out[list(of)] = True
    return Repeats(of, sorted(places.values())), PartMeshes(labels, tables.without_meshes(left_out), whole.surfaces)


_NONE = np.zeros(0, np.int32), np.zeros(0, np.int32), np.zeros(0)


def _size(tables: _kernel.PartTables, part: int) -> float:
    points = tables.points[tables.point_start[part] : tables.point_start[part + 1]]
    return float(np.ptp(points, axis=0).max())


def _thickness(tables: _kernel.PartTables, part: int) -> float:
    """That of a sheet of the part's volume and surface, model units; an open flat sheet has none."""
    own = tables.triangles[tables.triangle_start[part] : tables.triangle_start[part + 1]]
    a, b, c = np.moveaxis(tables.points[own] - tables.points[own[0, 0]], 1, 0)
    normals = np.cross(b - a, c - a)
    area = 0.5 * float(np.sqrt((normals * normals).sum(axis=1)).sum())
    volume = abs(float((a * normals).sum())) / 6.0
    return 2.0 * volume / area if area > 0.0 else 0.0


def _look_alike(one: PartLabel | Part, other: PartLabel | Part, looks: Mapping[str, Appearance]) -> bool:
    a, b = looks.get(one.name, Appearance()), looks.get(other.name, Appearance())
    if one.color != other.color or a.whole != b.whole or a.faces != b.faces:
        return False
    return _equal(a.corners, b.corners) and _equal(a.triangles, b.triangles)


def _equal(one: npt.NDArray[Any] | None, other: npt.NDArray[Any] | None) -> bool:
    if one is None or other is None:
        return one is other
    return np.array_equal(one, other)


def _said(names: Sequence[str]) -> str:
    shown = [f'"{name}"' for name in names]
    if len(shown) > 3:
        shown = [*shown[:2], f"{len(shown) - 2} more"]
    return f"{len(names)} equal parts lie in one place: {', '.join(shown[:-1])} and {shown[-1]}."
