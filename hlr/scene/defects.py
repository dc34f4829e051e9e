"""Defects of parts, in words."""

from __future__ import annotations

from collections.abc import Callable, Collection

import numpy as np

from hlr._kernel import MeshScene
from hlr.common.types import Floats, Ints
from hlr.drawing.notes import Note
from hlr.scene.scene import ScenePart
from hlr.source.part_meshes import PartMeshes

FLAT = 1e-7
"""What lies off a plane by no more than this share of its size lies in it."""

MAX_NOTES = 5
"""Defective parts with a note of their own; one more note has the number of all others."""


def part_reports(
    whole: PartMeshes,
    doubled: list[int],
    found: MeshScene,
    offsets: Ints,
    drawn: list[int] | None,
    crossed: Collection[int],
    surface_parts: Callable[[], Collection[str]],
) -> tuple[ScenePart, ...]:
    """One report per part: identity, counts and defects.

    doubled: triangles already left out as duplicates; offsets: of the triangles at each mesh edge; drawn: edges of
    parts without B-rep, None where there are none; crossed: numbers of parts whose surfaces pass through one another;
    surface_parts: the names of parts that are faces outside all solids.
    """
    reports = found.reports
    none = [0] * len(reports)
    own, bordering = drawn or none, none
    named: Collection[str] = ()
    if any([counts[0] for _, _, counts in reports]):
        named = surface_parts()
        if whole.tables.brep_parts:
            bordering = _border_edges(found, offsets, len(reports))
    out = []
    for i, (label, (brep, faces, counts)) in enumerate(zip(whole.labels, reports, strict=True)):
        border, crowded, turned, flat, unclosed, outside_in, triangles, edges = counts
        of_surfaces, open_edges = label.name in named, 0
        defects = []
        if doubled[i]:
            defects.append(_count(doubled[i], "duplicated triangle"))
        if flat and not brep:  # in a B-rep they are due to the tessellation, not to the model
            defects.append(_count(flat, "triangle") + " without area")
        if border and not (of_surfaces and _is_flat(whole, i)):
            shown = bordering[i] or border
            open_edges = shown if of_surfaces else 0
            defects.append("open: " + _count(shown, "border edge"))
        if crowded:
            defects.append(_count(crowded, "non-manifold edge"))
        if turned:
            defects.append(_count(turned, "edge") + " between faces of opposite orientation")
        if outside_in:
            pieces = _count(outside_in, "closed piece") + " turned inside out"
            defects.append("the solid is turned inside out" if brep else pieces)
        if i in crossed:
            defects.append("the surface passes through itself")
        out.append(
            ScenePart(
                name=label.name,
                color=label.color,
                transform=label.transform,
                faces=faces if brep else 0,
                edges=edges if brep else own[i],
                triangles=triangles,
                closed=triangles > 0 and not border and not unclosed,
                oriented=turned == 0,
                defects=tuple(defects),
                open_edges=open_edges,
            )
        )
    return tuple(out)


def defect_notes(parts: tuple[ScenePart, ...]) -> list[Note]:
    """One note per defective part, MAX_NOTES at most, and one for all others; then the same for open surfaces."""
    bad = [p for p in parts if p.defects and not _is_open_surface(p)]
    out = [Note("defects", f'Part "{p.name}" is drawn as it is: {"; ".join(p.defects)}.') for p in bad[:MAX_NOTES]]
    if len(bad) > MAX_NOTES:
        more = len(bad) - MAX_NOTES
        text = f"{more} more part{' has' if more == 1 else 's have'} defects: see hlr info."
        out.append(Note("more-defects", text))
    return out + _surface_notes([p for p in parts if _is_open_surface(p)])


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
