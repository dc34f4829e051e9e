"""From meshed parts to the scene: one set of arrays, checked part by part."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.errors import SourceError
from hlr.plan.effect import Facts, Planner
from hlr.plan.options import Options
from hlr.plan.table import DRAWING
from hlr.scene.clash import clashes, crossed_parts, distrusted, intersection_walks, may_fold_into_itself, no_clashes
from hlr.scene.creases import creases
from hlr.scene.defects import notes, reports
from hlr.scene.groups import checked, grouped, welded, with_wires
from hlr.scene.needles import supported
from hlr.scene.outward import inside_out, surfaces_turned, turned_outward
from hlr.scene.repair import places_repeated, without_duplicates
from hlr.scene.scene import INTERIOR, Scene, TrueSurfaces
from hlr.scene.stitch import bare_borders, stitched
from hlr.scene.topology import (
    MeshFacts,
    between_planes,
    crease_walks,
    folded_back,
    joined,
    mesh_facts,
    source_walks,
)
from hlr.source.extent import LARGEST
from hlr.source.model import EdgeClass, Floats, Ints, Meshed, OnSurfaces, PartMesh

MOST_TRIANGLES = 2**31 // 3 - 1
"""Indices are 32 bits wide; three sides a triangle."""


def build(meshed: Meshed, crease: float, deflection: float, planner: Planner | None = None) -> Scene:
    """The scene of all parts. crease: degrees, for parts without B-rep; deflection: what they were meshed with.

    planner: decides what is looked for at all. Raises SourceError where nothing is left to draw.
    """
    plan = planner or Planner(DRAWING, Options())
    parts = meshed.parts
    points, triangles, part_of = _put_together(parts)
    mesh = mesh_facts(points, triangles)
    parts, doubled = _repaired(parts, mesh, plan)
    if any(one is not other for one, other in zip(parts, meshed.parts, strict=True)):
        points, triangles, part_of = _put_together(parts)
        mesh = mesh_facts(points, triangles)
    parts, seams = _stitched(parts, mesh, part_of, deflection, plan)
    if seams:
        points, triangles, part_of = _put_together(parts)
        mesh = mesh_facts(points, triangles)
    firsts = _firsts([len(p.points) for p in parts])
    face = np.concatenate([np.zeros(0, np.int32), *[p.triangle_face for p in parts]])
    edges, offsets, incident, balance = mesh.edges, mesh.offsets, mesh.incident, mesh.balance

    brep = np.array([p.brep for p in parts], bool)
    curved = _curved(parts, part_of, face)
    first = mesh.first()
    edge_part = part_of[first] if len(parts) > 1 else np.zeros(len(edges), np.int32)
    walks, loose = source_walks(parts, firsts, edges, len(points))
    kind = np.full(len(edges) + len(loose), INTERIOR, np.uint8)
    facets = None
    if len(edges) and not brep[edge_part].all():
        sure = supported(mesh, points, triangles, part_of, np.array([p.precision for p in parts]))
        facets = sure.normals
        kind[: len(edges)] = creases(sure, edge_part, ~brep, crease, points)
        walks = joined(walks, crease_walks(points, edges, kind[: len(edges)], edge_part))
    # Backwards, so that of several source edges along one mesh edge the first gives its class.
    kind[walks.edges[::-1]] = np.repeat(walks.kind, np.diff(walks.offsets))[::-1]
    walks = between_planes(walks, mesh, kind, curved)

    whole = brep & (np.bincount(edge_part[balance != 0], minlength=len(parts)) == 0)
    group_of, group_part = grouped(whole, triangles, part_of, len(points))
    groups = checked(points, triangles, group_of, group_part, mesh, brep, curved)
    inward = inside_out(groups, group_part)
    turned = inward[group_of] if inward.any() else np.zeros(len(triangles), bool)
    if inward.any():
        if len(parts) == 1:
            triangles = triangles.copy()  # they are the part's own
        facets = None if facets is None else np.where(turned[:, None], -facets, facets)
        groups = turned_outward(groups, inward, triangles, mesh, turned)
    suspect = may_fold_into_itself(points, triangles, mesh, group_of, groups)
    with plan.deciding():
        meeting = _kernel.boxes_meet(groups.low, groups.high)
    begin = perf_counter()
    if plan.on("intersection search", Facts(meeting=int(meeting.sum()), folded=int(suspect.sum()))):
        met = clashes(points, triangles, mesh, group_of, groups, suspect, curved, deflection)
    else:
        met = no_clashes(len(groups.closed))
    plan.spent("intersection search", perf_counter() - begin, clash_tests=met.tests)
    found = reports(
        parts, doubled, mesh, kind, part_of, edge_part, groups, group_part, inward, crossed_parts(met, group_part)
    )
    groups = distrusted(groups, met.through | welded(offsets, incident, group_of, groups))

    edge_group = group_of[first]
    if len(loose):
        # Wires of no face: edges without triangles, in a group of their own part.
        vertex_part = np.repeat(np.arange(len(parts), dtype=np.int32), [len(p.points) for p in parts])
        owner = vertex_part[loose[:, 0]]
        groups, own_group = with_wires(groups, points, loose, owner, tight=False)
        edges, edge_part = np.concatenate([edges, loose]), np.concatenate([edge_part, owner])
        edge_group = np.concatenate([edge_group, own_group])
    if len(met.edges):
        lines = met.edges + np.int32(len(points))
        points = np.concatenate([points, met.points])
        walks = joined(walks, intersection_walks(met, group_part, len(edges)))
        pair = met.group[:, 0].astype(np.int64) << 32 | met.group[:, 1]
        groups, own_group = with_wires(groups, points, lines, pair, tight=True)
        edges, edge_part = (
            np.concatenate([edges, lines]),
            np.concatenate([edge_part, group_part[met.group].min(axis=1)]),
        )
        edge_group = np.concatenate([edge_group, own_group])
        kind = np.concatenate([kind, np.full(len(lines), EdgeClass.INTERSECTION, np.uint8)])
    curved |= _run_into(curved, kind, mesh, part_of, face, parts)
    edge_curved = np.zeros(len(edges), bool)
    faced = len(offsets) - 1
    if faced:
        edge_curved[:faced] = True if curved.all() else np.logical_or.reduceat(curved[incident], offsets[:-1])
    edge_curved[:faced] &= ~folded_back(mesh)
    offsets = np.concatenate([offsets, np.full(len(edges) - faced, offsets[-1], np.int32)])
    on = _true_surfaces(parts)
    if on is not None and turned.any():
        on = surfaces_turned(on, turned, part_of, face)
    if len(points) == 0 or len(edges) == 0:
        raise SourceError("nothing to draw: no part has a face or an edge")
    return Scene(
        points=points,
        triangles=triangles,
        triangle_part=part_of,
        triangle_group=group_of,
        triangle_face=face,
        triangle_origin=np.concatenate([np.zeros(0, np.int32), *[_origin(p) for p in parts]]),
        turned=turned,
        edges=np.ascontiguousarray(edges),
        offsets=offsets,
        incident=incident,
        edge_part=edge_part,
        edge_group=np.ascontiguousarray(edge_group),
        edge_kind=kind,
        edge_curved=edge_curved,
        groups=groups,
        chains=walks,
        parts=found,
        notes=(*meshed.notes, *notes(found)),
        true_surfaces=on,
        convex=len(suspect) == 1 and not suspect.any(),
        facets=facets,
    )


def _repaired(parts: list[PartMesh], mesh: MeshFacts, plan: Planner) -> tuple[list[PartMesh], list[int]]:
    """The parts without what is there twice, and how many triangles that left out of each."""
    with plan.deciding():
        repeated = mesh.repeated or places_repeated(parts)
    begin = perf_counter()
    found = [(part, 0) for part in parts]
    if plan.on("repair", Facts(repeated=repeated)):
        found = [without_duplicates(part) for part in parts]
    doubled = [count for _, count in found]
    plan.spent("repair", perf_counter() - begin, doubled_triangles=sum(doubled))
    return [part for part, _ in found], doubled


def _put_together(parts: list[PartMesh]) -> tuple[Floats, Ints, Ints]:
    """Points (n, 3) and triangles (t, 3) of all parts, and the part (t,) of each triangle."""
    if sum(len(p.triangles) for p in parts) > MOST_TRIANGLES:
        raise SourceError("the model has more than 700 million triangles: give a coarser accuracy")
    firsts = _firsts([len(p.points) for p in parts])
    points = _joined([np.zeros((0, 3)), *[p.points for p in parts]])
    if not (points.max(initial=0.0) < LARGEST and points.min(initial=0.0) > -LARGEST):  # also where one is NaN
        raise SourceError(
            f"the tessellation has coordinates that are not finite or beyond {LARGEST:g}: repair the model"
        )
    numbered = [p.triangles + firsts[i] if firsts[i] else p.triangles for i, p in enumerate(parts)]
    triangles = _joined([np.zeros((0, 3), np.int32), *numbered])
    return points, triangles, np.repeat(np.arange(len(parts), dtype=np.int32), [len(p.triangles) for p in parts])


def _joined(tables: list[npt.NDArray[Any]]) -> npt.NDArray[Any]:
    """The tables one after another; of two, of which the first is empty, the other itself."""
    return np.ascontiguousarray(tables[1]) if len(tables) == 2 else np.concatenate(tables)


def _stitched(
    parts: list[PartMesh], mesh: MeshFacts, part_of: Ints, deflection: float, plan: Planner
) -> tuple[list[PartMesh], int]:
    """The parts with borders that run along one another joined, and how many pieces of borders that joined."""
    with plan.deciding():
        borders = bare_borders(parts, mesh, part_of)
    begin, seams = perf_counter(), 0
    if plan.on("stitching of borders", Facts(borders=int(borders.sum()))):
        parts, seams = stitched(parts, borders, deflection)
    plan.spent("stitching of borders", perf_counter() - begin, seams=seams)
    return parts, seams


def _origin(part: PartMesh) -> Ints:
    return np.arange(len(part.triangles), dtype=np.int32) if part.origin is None else part.origin


def _firsts(counts: list[int]) -> Ints:
    out = np.zeros(len(counts), np.int32)
    np.cumsum(counts[:-1], out=out[1:])
    return out


def _true_surfaces(parts: list[PartMesh]) -> TrueSurfaces | None:
    """The parameters of all parts' triangles; None where no part has a B-rep."""
    on = [p.on_surfaces for p in parts]
    known = [o for o in on if o is not None]
    if not known:
        return None
    first_uv = _firsts([len(o.uv) if o is not None else 0 for o in on])
    counts = [len(p.face_planar) for p in parts]

    def joined(of: Callable[[OnSurfaces], Any], fill: float, shape: tuple[int, ...], dtype: Any) -> Any:
        rows = [of(o) if o is not None else np.full((n, *shape), fill, dtype) for o, n in zip(on, counts, strict=True)]
        return np.concatenate(rows)

    corner = [
        o.corner + first if o is not None else np.full((len(p.triangles), 3), -1, np.int32)
        for o, p, first in zip(on, parts, first_uv, strict=True)
    ]
    transform = np.repeat(np.array([p.transform[:3] for p in parts]), counts, axis=0)
    place = joined(lambda o: o.place, 0.0, (3, 4), np.float64)
    return TrueSurfaces(
        corner=np.concatenate(corner).astype(np.int32, order="C"),
        uv=np.concatenate([o.uv for o in known]),
        first=_firsts(counts),
        number=joined(lambda o: o.number, -1, (), np.int32),
        place=_composed(transform, place),
        inward=joined(lambda o: o.reversed, False, (), bool),
        curved=~np.concatenate([p.face_planar for p in parts]) & joined(lambda o: o.number >= 0, False, (), bool),
        planar=np.concatenate([p.face_planar for p in parts]),
        surfaces=known[0].surfaces,
    )


def _composed(outer: Floats, inner: Floats) -> Floats:
    """(n, 3, 4) outer * inner; no BLAS, so every machine gets the same bits."""
    out = np.zeros_like(inner)
    for i in range(3):
        for j in range(4):
            out[:, i, j] = sum(outer[:, i, k] * inner[:, k, j] for k in range(3))
        out[:, i, 3] += outer[:, i, 3]
    return out


def _run_into(
    curved: npt.NDArray[np.bool_],
    kind: npt.NDArray[np.uint8],
    mesh: MeshFacts,
    part_of: Ints,
    face: Ints,
    parts: list[PartMesh],
) -> npt.NDArray[np.bool_]:
    """(t,) bool: the triangle lies on a planar face that a curved one runs into tangentially.

    Seen edge-on, such a plane is the curved face's outline, and rounding decides along which of its edges it folds.
    """
    smooth = np.flatnonzero(kind[: len(mesh.balance)] == EdgeClass.SMOOTH)
    if not len(smooth):
        return np.zeros(len(face), bool)
    number = _firsts([len(p.face_planar) for p in parts])[part_of] + face
    touched = np.zeros(int(number.max(initial=-1)) + 1, bool)
    for k in (0, 1):
        at = mesh.offsets[smooth] + k
        inside = at < mesh.offsets[smooth + 1]
        touched[number[mesh.incident[at[inside]]]] = True
    return np.asarray(touched[number] & ~curved)


def _curved(parts: list[PartMesh], part_of: Ints, face: Ints) -> npt.NDArray[np.bool_]:
    """(t,) bool: the triangle lies on a face that may show an outline."""
    firsts = _firsts([len(p.face_planar) for p in parts])
    planar = np.concatenate([np.zeros(0, bool), *[p.face_planar for p in parts]])
    if not planar.any():
        return np.ones(len(face), bool)
    return np.asarray(~planar[firsts[part_of] + face])
