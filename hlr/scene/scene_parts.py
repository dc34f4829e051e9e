"""The parts of a scene, and their defects in words."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from hlr._kernel import MeshScene, PartReports
from hlr.common.types import Color, Floats, Ints
from hlr.drawing.notes import Note
from hlr.source.part_meshes import PartLabel, PartMeshes

if TYPE_CHECKING:
    from hlr.source.cad.parts import Part

OnCut = Callable[[Floats], npt.NDArray[np.bool_]]
"""Which points (n, 3) lie on the plane of a section."""

FLAT = 1e-7
"""What lies off a plane by no more than this share of its size lies in it."""

MAX_NOTES = 5
"""Defective parts with a note of their own; one more note has the number of all others."""


@dataclass(frozen=True, slots=True)
class ScenePart:
    """A part's identity and what was found out about it.

    open_edges: of faces outside all solids, which may be open as surface models are: edges with one face only
    """

    name: str
    color: Color | None
    transform: Floats
    faces: int
    edges: int
    triangles: int
    closed: bool
    oriented: bool
    defects: tuple[str, ...]
    open_edges: int = 0


class SceneParts:
    """The parts of a scene; the record of one is made when it is asked for.

    labels    name, colour and placement of each part
    repeated  parts without meshes, each with the one that it repeats
    """

    def __init__(
        self,
        labels: Sequence[PartLabel | Part],
        reports: PartReports,
        drawn: list[int] | None,
        defects: Mapping[int, tuple[tuple[str, ...], int]],
        repeated: Mapping[int, int] | None = None,
    ) -> None:
        """reports: what the kernel counted; drawn: edges of parts without B-rep, None where there are none;
        defects: by the number of the part, with its open edges; repeated: as in `with_repeats`.
        """
        self.labels, self.repeated = labels, repeated or {}
        self._reports, self._drawn, self._defects = reports, drawn, defects

    def with_repeats(self, repeated: Mapping[int, int]) -> SceneParts:
        """The same, where the meshes of these parts were left out: each is like the part that it repeats."""
        defects = {i: self._defects[first] for i, first in repeated.items() if first in self._defects}
        every = dict(sorted({**self._defects, **defects}.items()))
        return SceneParts(self.labels, self._reports, self._drawn, every, repeated)

    def __len__(self) -> int:
        return len(self.labels)

    def __iter__(self) -> Iterator[ScenePart]:
        return map(self.__getitem__, range(len(self)))

    def __getitem__(self, i: int) -> ScenePart:
        label = self.labels[i]
        counted = self.repeated.get(i, i)
        brep, faces, (border, _, turned, _, unclosed, _, triangles, edges) = self._reports.of(counted)
        own = 0 if self._drawn is None else self._drawn[counted]
        defects, open_edges = self._defects.get(i, ((), 0))
        return ScenePart(
            name=label.name,
            color=label.color,
            transform=label.transform,
            faces=faces if brep else 0,
            edges=edges if brep else own,
            triangles=triangles,
            closed=triangles > 0 and not border and not unclosed,
            oriented=turned == 0,
            defects=defects,
            open_edges=open_edges,
        )

    def notes(self) -> list[Note]:
        """One note per defective part, MAX_NOTES at most, and one for all others; then the same for open surfaces."""
        parts = [self[i] for i in self._defects]
        bad = [p for p in parts if not _is_open_surface(p)]
        out = [Note("defects", f'Part "{p.name}" is drawn as it is: {"; ".join(p.defects)}.') for p in bad[:MAX_NOTES]]
        if len(bad) > MAX_NOTES:
            more = len(bad) - MAX_NOTES
            text = f"{more} more part{' has' if more == 1 else 's have'} defects: see hlr info."
            out.append(Note("more-defects", text))
        return out + _surface_notes([p for p in parts if _is_open_surface(p)])


def scene_parts(
    whole: PartMeshes,
    doubled: list[int],
    found: MeshScene,
    offsets: Ints,
    drawn: list[int] | None,
    crossed: Collection[int],
    surface_parts: Callable[[], Collection[str]],
    on_cut: OnCut | None = None,
) -> SceneParts:
    """All parts with their defects.

    doubled: triangles already left out as duplicates; offsets: of the triangles at each mesh edge; drawn: edges of
    parts without B-rep, None where there are none; crossed: numbers of parts whose surfaces pass through one another;
    surface_parts: the names of parts that are faces outside all solids; on_cut: None where no plane has cut them.
    """
    reports = found.reports()
    wrong = {*reports.suspects(), *crossed, *[i for i, count in enumerate(doubled) if count]}
    counted = {i: reports.of(i) for i in sorted(wrong)}
    of_faces: Collection[str] = ()
    bordering = [0] * len(reports)
    if any([counts[0] or counts[5] for _, _, counts in counted.values()]):
        of_faces = surface_parts()
    if whole.tables.brep_parts and any([counts[0] for _, _, counts in counted.values()]):
        bordering = _border_edges(found, offsets, len(reports))
    defects_of = {}
    touching = _touching_at_cut(whole, found, offsets, on_cut)
    for i, (brep, _, (border, crowded, turned, flat, _, outside_in, _, _)) in counted.items():
        of_surfaces, open_edges = whole.labels[i].name in of_faces, 0
        defects = []
        if doubled[i]:
            defects.append(_count(doubled[i], "duplicated triangle"))
        if flat and not brep:  # in a B-rep they are due to the tessellation, not to the model
            defects.append(_count(flat, "triangle") + " without area")
        if border and not (of_surfaces and _is_flat(whole, i)):
            shown = bordering[i] or border
            open_edges = shown if of_surfaces else 0
            defects.append("open: " + _count(shown, "border edge"))
        if crowded > touching[i]:
            defects.append(_count(crowded - touching[i], "non-manifold edge"))
        if turned:
            defects.append(_count(turned, "edge") + " between faces of opposite orientation")
        # How loose faces are turned says nothing: there is no inside yet.
        if outside_in and not (brep and of_surfaces):
            pieces = _count(outside_in, "closed piece") + " turned inside out"
            defects.append("the solid is turned inside out" if brep else pieces)
        if i in crossed:
            defects.append("the surface passes through itself")
        if defects:
            defects_of[i] = tuple(defects), open_edges
    return SceneParts(whole.labels, reports, drawn, defects_of)


def _is_open_surface(part: ScenePart) -> bool:
    """It is open, as it may be, and nothing else is wrong with it."""
    return part.open_edges > 0 and len(part.defects) == 1


def _surface_notes(open_parts: list[ScenePart]) -> list[Note]:
    texts = [
        f'Part "{p.name}" holds faces and no solid: it is open, at {_count(p.open_edges, "edge")}.'
        for p in open_parts[:MAX_NOTES]
    ]
    if len(open_parts) > MAX_NOTES:
        more = len(open_parts) - MAX_NOTES
        are = "more part of faces and no solid is" if more == 1 else "more parts of faces and no solid are"
        texts.append(f"{more} {are} open: see hlr info.")
    return [Note("open-surfaces", text) for text in texts]


def _border_edges(found: MeshScene, offsets: Ints, parts: int) -> list[int]:
    """How many edges of each part's B-rep bound one face only."""
    walks = found.walks()
    walk = np.repeat(np.arange(len(walks)), np.diff(walks.offsets))
    sides = np.append(np.diff(offsets), np.zeros(len(found.loose), np.int32))
    ends = walk[sides[walks.edges] == 1]
    edges = np.unique(walks.part[ends].astype(np.int64) << 32 | walks.index[ends])
    shown: list[int] = np.bincount(edges >> 32, minlength=parts).tolist()
    return shown


def _touching_at_cut(whole: PartMeshes, found: MeshScene, offsets: Ints, on_cut: OnCut | None) -> list[int]:
    """At how many edges each part touches itself where it is cut: faces of the cut lie on both sides of them.

    A plane that is tangent to a bore leaves such a body of a sound one.
    """
    if on_cut is None:
        return [0] * len(whole.labels)
    points, four = whole.tables.points, np.flatnonzero(np.diff(offsets) == 4)
    four = four[on_cut(points[found.mesh.edges[four].ravel()]).reshape(-1, 2).all(axis=1)]
    around = found.triangles[found.mesh.incident[offsets[four][:, None] + np.arange(4)]]
    made = on_cut(points[around.ravel()]).reshape(-1, 4, 3).all(axis=2).sum(axis=1) >= 2
    counts: list[int] = np.bincount(found.edge_part[four[made]], minlength=len(whole.labels)).tolist()
    return counts


def _is_flat(whole: PartMeshes, part: int) -> bool:
    """All faces of a part lie in one plane: a sketch."""
    tables = whole.tables
    if not tables.face_planar[slice(*tables.face_start[part : part + 2].tolist())].all():
        return False
    points = tables.points[slice(*tables.point_start[part : part + 2].tolist())]
    return _in_one_plane(points)


def _in_one_plane(points: Floats) -> bool:
    """All points (n, 3) lie in one plane, or in one line: the plane of three of them that lie far apart."""
    points = points - points[0]
    along = _longest(points)
    normal = _longest(np.cross(along, points))  # of the triangle with this side that is highest
    size, area = np.linalg.norm(along), np.linalg.norm(normal)
    return bool(area <= FLAT * size**2 or abs(points @ normal).max() <= FLAT * size * area)


def _longest(vectors: Floats) -> Floats:
    longest: Floats = vectors[np.linalg.norm(vectors, axis=1).argmax()]
    return longest


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
