"""What a section leaves of a source."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.errors import OptionError, SourceError
from hlr.pipeline.section.plane import Planes
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.half_space import UncuttableError, bare_error
from hlr.source.cad.kernel_cut import BARE, SAME, KernelCut, NotHereError
from hlr.source.cad.parts import Leaf, Part
from hlr.source.joined import JoinedSource
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.model import Source
from hlr.source.stepped import Stepped


@dataclass(frozen=True, slots=True)
class CutSource:
    """A source that a plane has cut.

    whose    the part of the whole model that each of its parts is, or is a piece of, by name
    cut      names of those parts of the whole model that the plane cuts
    through  names of those that it goes through, and which stay whole
    uncut    names of all those that stay whole
    failed   why those stay whole, by name, that cannot be cut
    open     names of those parts of the source that are no bodies, and so have no cut faces; and whether they are cut
    meshes   names of those parts of the whole model that are meshes
    """

    source: Source
    whose: dict[str, str]
    cut: frozenset[str]
    through: frozenset[str] = frozenset()
    uncut: frozenset[str] = frozenset()
    failed: Mapping[str, UncuttableError] = field(default_factory=dict)
    open: Mapping[str, bool] = field(default_factory=dict)
    meshes: frozenset[str] = frozenset()


def cut_source(source: Source, planes: Planes, uncut: Collection[str] = ()) -> CutSource:
    """The source without what lies before a plane.

    uncut: names of parts that stay whole, unless they lie wholly before the plane

    Raises:
        SourceError: it cannot be cut: shapes none of which is sound, another kind of source.
        OptionError: nothing would be left.
    """
    if planes.touching:
        return CutSource(source, {name: name for name in source.names()}, frozenset())
    found = _cut_joined(source, planes, uncut) if isinstance(source, JoinedSource) else _cut(source, planes, uncut)
    if found is None:
        raise OptionError(f"the section leaves nothing of {source.name}: move its plane, or leave it out")
    return found


def _cut_joined(source: JoinedSource, planes: Planes, uncut: Collection[str]) -> CutSource | None:
    """CAD objects and meshes, each without what lies before the planes; None: nothing is left."""
    cad, meshes = _cut(source.cad, planes, uncut), _cut(source.meshes, planes, uncut)
    if cad is None or meshes is None:
        return cad or meshes
    assert isinstance(cad.source, BrepSource) and isinstance(meshes.source, MeshSource)
    return CutSource(
        source.with_both(cad.source, meshes.source),
        cad.whose | meshes.whose,
        cad.cut | meshes.cut,
        cad.through | meshes.through,
        cad.uncut | meshes.uncut,
        cad.failed,
        meshes.open,
        meshes.meshes,
    )


def _cut(source: Source, planes: Planes, uncut: Collection[str]) -> CutSource | None:
    """CAD objects, or meshes; None: nothing is left."""
    if not isinstance(source, BrepSource | MeshSource):
        raise SourceError(f"{source.name} cannot be cut for a section: draw a CAD model, or a mesh.")
    whole: list[str] = []
    crossed: list[str] = []
    through: set[str] = set()
    # Triangles tell how far a part reaches, its box may reach farther.
    if isinstance(source, MeshSource):
        reaches = [part.points for part in source.parts]
    else:
        reaches = [_corners(box) for box in source.boxes()]
    stepped = planes.stepped()
    for name, corners in zip(source.names(), reaches, strict=True):
        low, high = stepped.reach(corners) if len(corners) else (0.0, 0.0)
        if high <= planes.near:
            whole.append(name)
        elif low < -planes.near:
            (whole if name in uncut else crossed).append(name)
            through |= {name} & set(uncut)
    found = _cut_brep(source, planes, whole, crossed) if isinstance(source, BrepSource) else None
    if isinstance(source, MeshSource):
        found = _cut_meshes(source, planes, whole, crossed)
    if found is None:
        return None
    return replace(found, through=frozenset(through | found.failed.keys()), uncut=frozenset({*uncut, *found.failed}))


def _corners(box: Floats) -> Floats:
    """(8, 3) of a box that is given by its corners, or by the lower and the upper one."""
    if len(box) != 2:
        return box
    return np.array([[box[i][0], box[j][1], box[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])


@dataclass(slots=True)
class _Left:
    """What planes leave of a B-rep.

    leaves  shapes in their places, with the names of their parts
    cut     names of the parts that are cut
    failed  why those stay whole, by name, that OpenCASCADE cannot cut
    """

    leaves: list[Leaf] = field(default_factory=list)
    cut: set[str] = field(default_factory=set)
    failed: dict[str, UncuttableError] = field(default_factory=dict)


def _cut_brep(source: BrepSource, planes: Planes, whole: list[str], crossed: list[str]) -> CutSource | None:
    """The B-rep without what lies before the planes; None: nothing is left.

    Raises UncuttableError where parts are to be cut, and none can be.
    """
    with suppress(NotHereError):
        return _joined(source, planes, whole, crossed)
    left = _left_of(source, planes, set(whole), set(crossed))
    if left.failed and not left.cut:
        raise next(iter(left.failed.values()))
    if not left.leaves:
        return None
    built = _rebuilt(source, left)
    whose = {part.name: part.product for part in built.parts}
    return CutSource(built, whose, frozenset(left.cut), failed=left.failed)


def _joined(source: BrepSource, planes: Planes, whole: list[str], crossed: list[str]) -> CutSource | None:
    """The same: cut by the kernel, and by OpenCASCADE what the kernel does not cut.

    Raises NotHereError where the kernel cannot put the two together.
    """
    own = KernelCut(source, planes.stepped(), planes.near, () if planes.steps else crossed)
    failed = {name: bare_error(name) for name, why in own.failed.items() if why == BARE}
    rest = [name for name in crossed if name not in failed and name not in own.known]
    left = _left_of(source, planes, set(), set(rest)) if rest else _Left()
    failed |= left.failed
    cut = own.cut | left.cut
    if failed and not cut:
        raise next(error for name in source.names() if (error := failed.get(name)))
    others = _rebuilt(source, left) if left.leaves else None
    built = own.joined([*whole, *(name for name in failed if name not in left.failed)], others)
    if built is None:
        return None
    order = {name: failed[name] for name in source.names() if name in failed}
    return CutSource(built, {part.name: part.product for part in built.parts}, cut, failed=order)


def _left_of(source: BrepSource, planes: Planes, whole: set[str], crossed: set[str]) -> _Left:
    """What planes leave of a B-rep; parts of other names lie before them."""
    from hlr.source.cad.occt_import import load_occt

    load_occt()
    cutter, left = _PrototypeCutter(source, planes), _Left()
    for part in source.parts:
        if part.name not in whole and part.name not in crossed:
            continue
        shape = source.prototypes.shapes[part.prototype]
        if part.name in crossed:
            found = cutter.left_of(part)
            if isinstance(found, UncuttableError):
                left.failed[part.name] = found.of(part.name)
            else:
                shape, is_cut = found
                left.cut |= {part.name} if is_cut else set()
        if shape is not None:
            left.leaves.append(_placed(shape, part))
    return left


def _placed(shape: Any, part: Part) -> Leaf:
    """A shape of a part, or what is left of it, in the part's place."""
    from OCP.gp import gp_Trsf
    from OCP.TopLoc import TopLoc_Location

    move = gp_Trsf()
    move.SetValues(*(float(value) for value in part.transform[:3].ravel()))
    return Leaf(shape.Moved(TopLoc_Location(move), False), part.name, part.color, above=part.above)


def _rebuilt(source: BrepSource, left: _Left) -> BrepSource:
    """A source of what is left, which looks as before.

    Pieces of a part that was cut have one colour: their faces are not those of the part.
    """
    from hlr.source.cad.source_builder import build_source, with_appearance
    from hlr.source.model import Appearance

    made = build_source(source.name, source.kind, left.leaves, source.notes)
    looks, of = source.appearances(), {part.name: part for part in source.parts}
    parts = []
    for part in made.parts:
        look = looks[part.product]
        shown = with_appearance(part, Appearance(look.whole) if part.product in left.cut else look)
        parts.append(replace(shown, transparent=of[part.product].transparent))
    built = BrepSource(source.name, source.kind, parts, made.prototypes, made.notes)
    built.choice, built.reading = source.choice, source.reading
    return built


class _PrototypeCutter:
    """Cuts the shapes of parts, each once for all its placements that lie to the plane in the same way.

    A board carries the same part many times over, and a plane along it cuts all of them alike.
    """

    def __init__(self, source: BrepSource, planes: Planes) -> None:
        self._shapes = source.prototypes.shapes
        self._planes, self._near = planes.stepped(), planes.near
        self._size = float(np.linalg.norm(np.subtract(*source.bounds())))
        self._solids: dict[int, Any] = {}
        self._found: dict[tuple[float, ...], tuple[Any | None, bool] | UncuttableError] = {}

    def left_of(self, part: Part) -> tuple[Any | None, bool] | UncuttableError:
        """What is left of the shape of a part, without its placement; None: nothing. And whether it is cut.

        An error where OpenCASCADE cannot cut it.
        """
        from hlr.source.cad.closing import as_solid
        from hlr.source.cad.half_space import put_on_faces

        planes = self._planes.before(part.transform)
        ends = np.concatenate([planes.levels, planes.steps]) / self._size
        turned = [*planes.normal, *(planes.along if len(planes.steps) else ())]
        key = part.prototype, *np.round([*turned, *ends], SAME).tolist()
        if key not in self._found:
            whole = self._shapes[part.prototype]
            scale = float(np.linalg.norm(part.transform[:3, :3].T @ self._planes.normal))
            planes = put_on_faces(planes, whole, self._near / scale)
            if part.prototype not in self._solids:
                self._solids[part.prototype] = as_solid(whole, self._size)
            solid = self._solids[part.prototype]
            self._found[key] = self._left_of(solid, planes, part.name)
            if isinstance(self._found[key], UncuttableError) and not solid.IsSame(whole):
                # Faces that close a body may not be sound as one: they are cut open.
                self._found[key] = self._left_of(whole, planes, part.name)
        return self._found[key]

    @staticmethod
    def _left_of(shape: Any, planes: Stepped, name: str) -> tuple[Any | None, bool] | UncuttableError:
        from hlr.source.cad.half_space import cut_at, cut_away

        leaf = Leaf(shape, name)
        try:
            at = planes.levels[0] * planes.normal
            left = cut_at([leaf], planes, at) if len(planes.steps) else cut_away([leaf], at, planes.normal)
        except UncuttableError as error:
            return error
        return (left[0].shape, not left[0].shape.IsSame(shape)) if left else (None, False)


def _cut_meshes(source: MeshSource, planes: Planes, whole: list[str], crossed: list[str]) -> CutSource | None:
    from hlr.source.mesh.half_space import cut_mesh

    parts = {part.name: part for part in source.parts}
    cut = {name: cut_mesh(parts[name], planes.stepped(), planes.near) for name in crossed}
    gone = [name for name in parts if name not in whole and name not in cut]
    pieces = {name: [(piece.points, piece.triangles) for piece in cut.get(name, ())] for name in [*cut, *gone]}
    left, whose = source.with_pieces(pieces)
    if not left.names():
        return None
    parts_of = {name: part for name, (part, _) in whose.items()}
    found = {name: cut[part][k] for name, (part, k) in whose.items() if part in cut}
    are_open = {name: piece.cut for name, piece in found.items() if not piece.closed}
    return CutSource(left, parts_of, frozenset(crossed), open=are_open, meshes=frozenset(parts))
