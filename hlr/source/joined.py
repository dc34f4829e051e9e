"""CAD objects and meshes in one source: a fixture around a scan, a printed part beside a bought one.

The parts of the CAD objects come first, whatever the order of the list. Coordinates are millimetres, z up.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np

from hlr.common.types import Floats, Ints, Progress
from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.request.accuracy import CONTACT, MESH_CONTACT
from hlr.request.options import Vector
from hlr.source.bounds import bounding_box, check_bounds, diagonal
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.objects import is_object, to_leaves
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.parts import Leaf
from hlr.source.cad.source_builder import build_source
from hlr.source.collected import is_made_of, left_out_of, only
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.mesh.objects import Meshes
from hlr.source.mesh.open_objects import is_mesh, mesh_source, read_meshes
from hlr.source.model import Appearance, Choice, Frame, PartInfo, Source, Tessellation


def are_both(thing: Any) -> bool:
    """Whether `open_both` opens it: a list or a dict of CAD objects and meshes. Nothing is imported."""
    return is_made_of(thing, lambda each: is_object(each) or is_mesh(each))


def open_both(thing: Any) -> Source:
    """A list or a dict of CAD objects and meshes, or of lists and dicts of both.

    Raises:
        SourceError: there is nothing to draw, or a mesh cannot be read.
    """
    cad, meshes = only(thing, is_object), only(thing, is_mesh)
    if cad is not None:
        load_occt()
    return source_of_both(
        type(thing).__name__,
        "object",
        [] if cad is None else to_leaves(cad, "part"),
        [] if meshes is None else read_meshes(meshes),
        list(left_out_of(thing)),
    )


def source_of_both(
    name: str, kind: str, leaves: Sequence[Leaf], meshes: Sequence[Meshes], notes: Sequence[Note]
) -> BrepSource | MeshSource | JoinedSource:
    """One source of what was read of CAD objects, and of what was read of meshes; there may be none of either.

    kind: where there are CAD objects alone. Meshes without triangles are left out beside CAD objects, with a warning.

    Raises:
        SourceError: there is nothing to draw.
    """
    if not leaves:
        return mesh_source(name, meshes, notes)
    if not meshes:
        return build_source(name, kind, leaves, notes)
    cad = build_source(name, kind, leaves)
    try:
        beside = mesh_source(name, meshes, (), in_world=True, taken=cad.names())
    except SourceError as error:
        return build_source(name, kind, leaves, [*notes, Note("part-left-out", f"The meshes were left out: {error}")])
    return JoinedSource(cad, beside, notes)


class JoinedSource:
    """CAD objects, then meshes. No name stands for a part of both."""

    def __init__(
        self, cad: BrepSource, meshes: MeshSource, notes: Sequence[Note], choice: Choice | None = None
    ) -> None:
        """Args: cad, meshes: both have millimetres, z up; notes: what was left out of both.

        Raises:
            SourceError: the model is too large to calculate with.
        """
        self.cad, self.meshes, self.choice = cad, meshes, choice
        self._both, self._notes, self.reading = (cad, meshes), list(notes), ""
        check_bounds(self.name, self.bounds())

    def with_both(self, cad: BrepSource, meshes: MeshSource) -> JoinedSource:
        """The same source with other CAD objects and meshes, such as what a section leaves of them."""
        return JoinedSource(cad, meshes, self._notes, self.choice)

    @property
    def name(self) -> str:
        """Base name."""
        return self.cad.name

    @property
    def kind(self) -> str:
        """Of CAD objects and meshes."""
        return "mixed"

    @property
    def frame(self) -> Frame:
        """Millimetres, z up."""
        return self.cad.frame

    @property
    def notes(self) -> list[Note]:
        """Warnings met while reading."""
        return [*self._notes, *self.cad.notes, *self.meshes.notes]

    def bounds(self) -> Floats:
        """(2, 3) lower and upper corner in millimetres."""
        return bounding_box(np.concatenate([each.bounds() for each in self._both]))

    def reach(self, right: Vector, up: Vector) -> Floats:
        """(2, 2) how far the parts reach along two directions of length 1: lower and upper end along each."""
        ends = np.array([each.reach(right, up) for each in self._both])
        return np.stack([ends[..., 0].min(axis=0), ends[..., 1].max(axis=0)], axis=1)

    def names(self) -> list[str]:
        """Name of every part."""
        return [name for each in self._both for name in each.names()]

    def also_called(self) -> dict[str, tuple[str, ...]]:
        """As of `BrepSource`."""
        return self.cad.also_called()

    def infos(self) -> list[PartInfo]:
        """Numbers of faces, edges and solids of every part; 0 of meshes."""
        return [info for each in self._both for info in each.infos()]

    def boxes(self) -> list[Floats]:
        """(k, 3) corners of every part."""
        return [box for each in self._both for box in each.boxes()]

    def of_parts(self, names: Collection[str], choice: Choice) -> Source:
        """The same source with these parts only; one of CAD objects alone, or of meshes, where no others are left."""
        cad, meshes = ([name for name in each.names() if name in names] for each in self._both)
        if not meshes:
            return self.cad.of_parts(cad, choice)
        if not cad:
            return self.meshes.of_parts(meshes, choice)
        chosen = self.with_both(self.cad.of_parts(cad, choice), self.meshes.of_parts(meshes, choice))
        chosen.choice = choice
        return chosen

    def transparent(self) -> bool:
        """Some part may be transparent."""
        return any(each.transparent() for each in self._both)

    def appearances(self) -> dict[str, Appearance]:
        """Colours and opacities of all parts."""
        return {name: look for each in self._both for name, look in each.appearances().items()}

    def mesh(
        self, deflection: float, angle: float, progress: Progress | None = None, *, finer: Collection[str] = ()
    ) -> Tessellation:
        """The meshes as they are, and those of the CAD objects: finer where these come near a mesh, or `finer` says so.

        Raises:
            SourceError: as of `BrepSource.mesh`.
        """
        near = self._near_meshes(max(CONTACT * deflection, MESH_CONTACT * diagonal(self.bounds())))
        made = self.cad.mesh(deflection, angle, progress, finer={*finer, *near})
        triangles = self.meshes.mesh(deflection, angle)
        none: Ints = np.zeros(len(triangles.parts), np.int32)
        made.parts = [*made.parts, *triangles.parts]
        made.touching = np.concatenate([made.touching, none])
        return made

    def _near_meshes(self, reach: float) -> list[str]:
        """Names of the CAD parts whose boxes come near that of a mesh."""
        boxes = zip(self.cad.names(), self.cad.boxes(), strict=True)
        shaped = [(name, box) for name, box in boxes if len(box)]
        low, high = (np.array([side(box) for _, box in shaped]) for side in (_low, _high))
        near = np.zeros(len(shaped), bool)
        for box in self.meshes.boxes():
            near |= ((low <= _high(box) + reach) & (high >= _low(box) - reach)).all(axis=1)
        return [name for (name, _), is_near in zip(shaped, near.tolist(), strict=True) if is_near]


def _low(box: Floats) -> Floats:
    lower: Floats = box.min(axis=0)
    return lower


def _high(box: Floats) -> Floats:
    upper: Floats = box.max(axis=0)
    return upper
