"""The scene of all parts: repaired, stitched, with creases, intersection lines and defects."""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter

import numpy as np

from hlr._kernel import Groups, MeshFacts, MeshScene, PartTables
from hlr.common.types import Floats
from hlr.errors import SourceError
from hlr.request.accuracy import REPEATED
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import Facts, Planner
from hlr.request.options import Options
from hlr.scene.clash import Clashes, find_clashes, self_intersecting_parts
from hlr.scene.creases import Kinds, creases
from hlr.scene.cut_borders import cut_borders
from hlr.scene.duplicates import without_duplicates, without_flat_wedges
from hlr.scene.intersection_lines import intersection_lines
from hlr.scene.needles import reliable_normals
from hlr.scene.repeats import Looks, without_repeats
from hlr.scene.scene import Scene, TrueSurfaces
from hlr.scene.scene_edges import SceneEdges
from hlr.scene.scene_parts import OnCut, scene_parts
from hlr.scene.shared_diagonals import without_shared_diagonals
from hlr.scene.spindle_tori import self_intersecting_tori
from hlr.scene.stitching import stitch_borders
from hlr.scene.walks import crease_walks
from hlr.source.bounds import LARGEST_COORDINATE
from hlr.source.fewer_triangles import Fewer, with_fewer_triangles
from hlr.source.model import PartMesh, Tessellation
from hlr.source.part_meshes import PartMeshes, combine_parts
from hlr.tables.line_classes import INTERIOR, EdgeClass


def build(
    meshed: Tessellation,
    crease: float,
    deflection: float,
    planner: Planner | None = None,
    on_cut: OnCut | None = None,
    looks: Looks = dict,
) -> Scene:
    """The scene of all parts. crease: degrees, for parts without B-rep; deflection: what they were meshed with.

    planner: decides what is looked for at all; on_cut: of a section; looks: of the parts. Raises SourceError where
    nothing is left to draw.
    """
    plan = planner or Planner(drawing_effects(), Options())
    repeats, whole = without_repeats(combine_parts(meshed.parts), REPEATED * deflection, looks)
    whole, mesh, doubled = _repaired(whole, plan)
    whole, mesh = _stitched(whole, mesh, deflection, plan)
    found, tables = mesh.scene(), whole.tables
    points, brep = tables.points, tables.brep
    edges, offsets, kind = mesh.edges, mesh.offsets, found.edge_kind
    group_part, edge_part = found.group_part, found.edge_part
    groups = found.groups()
    walks, facets, drawn = found.walks(), None, None
    if tables.brep_parts < len(tables) and len(edges):
        crease_kind, facets = _creased(tables, mesh, found, groups, crease)
        if on_cut is not None:
            of_mesh = ~brep[edge_part[: len(crease_kind)]]
            crease_kind[cut_borders(mesh, points, tables.triangles, of_mesh, on_cut)] = EdgeClass.SHARP
        walks = walks.merged(crease_walks(points, edges, crease_kind, edge_part))
        kind = kind.copy()
        np.copyto(kind[: len(crease_kind)], crease_kind, where=crease_kind != INTERIOR)
        drawn = np.bincount(edge_part[crease_kind != INTERIOR], minlength=len(brep)).tolist()
    met = _searched(whole, found, groups, deflection, plan)
    true, intersections = _true_surfaces(whole, found), None
    crossed = set() if met is None else self_intersecting_parts(met, group_part)
    parts = scene_parts(whole, doubled, found, mesh.offsets, drawn, crossed, meshed.surface_parts, on_cut)
    parts = parts.with_repeats(repeats.of)
    sound = groups.unsound(found.welded if met is None else met.through | found.welded)
    all_edges = SceneEdges(points, edges, edge_part, found.edge_group, kind, sound)
    if len(found.loose):
        all_edges.add_free(found.loose, tables)
    if met is not None and len(met.edges):
        along, intersections = intersection_lines(met, found, tables, true, len(all_edges.edges), deflection)
        walks = walks.merged(along)
        all_edges.add_intersections(met, group_part)
    if len(points) == 0 or len(all_edges.edges) == 0:
        raise SourceError("nothing to draw: no part has a face or an edge")
    added = len(all_edges.edges) - len(found.edge_curved)
    return Scene(
        points=all_edges.points,
        triangles=found.triangles,
        triangle_part=found.triangle_part,
        triangle_group=found.triangle_group,
        triangle_face=tables.triangle_face,
        triangle_origin=tables.origin,
        turned=np.zeros(len(found.triangles), bool) if found.turned is None else found.turned,
        edges=np.ascontiguousarray(all_edges.edges),
        offsets=np.concatenate([offsets, np.full(added, offsets[-1], np.int32)]) if added else offsets,
        incident=mesh.incident,
        edge_part=all_edges.part,
        edge_group=np.ascontiguousarray(all_edges.group),
        edge_kind=all_edges.kind,
        edge_curved=np.concatenate([found.edge_curved, np.zeros(added, bool)]) if added else found.edge_curved,
        groups=all_edges.groups,
        walks=walks,
        has_faces=brep & (tables.face_start[1:] > tables.face_start[:-1]),
        parts=parts,
        notes=(*meshed.notes, *parts.notes(), *repeats.notes(whole.labels)),
        true_surfaces=true,
        convex=len(group_part) == 1 and not found.folded,
        facets=facets,
        intersections=intersections,
        crossed=None if met is None else met.triangle,
        through_themselves=frozenset(crossed),
    )


def _repaired(whole: PartMeshes, plan: Planner) -> tuple[PartMeshes, MeshFacts, list[int]]:
    """The parts without duplicates, their edges, and the number of triangles left out of each."""
    mesh = _facts(whole)
    if turned := _with_other_diagonals(whole, mesh):
        whole = combine_parts([turned.get(i, part) for i, part in enumerate(whole)])
        mesh = _facts(whole)
    doubled = [0] * len(whole)
    with plan.deciding():
        triangles, places = mesh.triangles_repeated(), whole.tables.triangles_in_one_place()
        some = [i for i, both in enumerate(zip(triangles, places, strict=True)) if True in both]
    begin = perf_counter()
    if plan.on("repair", Facts(repeated=bool(some))):
        changed = {}
        for i in some:
            before = whole[i]
            solid, thick = without_flat_wedges(before)
            part, staying = without_duplicates(solid, triangles[i], places[i])
            doubled[i] = len(solid.triangles) - len(staying)
            if len(staying) < len(before.triangles):
                changed[i] = Fewer(thick[staying], part.edge_nodes)
        if changed:
            whole = with_fewer_triangles(whole, changed)
            mesh = _facts(whole)
    plan.spent("repair", perf_counter() - begin, doubled_triangles=sum(doubled))
    return whole, mesh, doubled


def _with_other_diagonals(whole: PartMeshes, mesh: MeshFacts) -> dict[int, PartMesh]:
    """Those B-reps of which two faces shared a diagonal beside their edge, by their numbers."""
    offsets = mesh.offsets
    four = offsets[:-1][offsets[1:] - offsets[:-1] == 4]
    if not len(four):
        return {}
    part = np.searchsorted(whole.tables.triangle_start, mesh.incident[four], side="right") - 1
    found = {}
    for i in np.unique(part[whole.tables.brep[part]]).tolist():
        before = whole[i]
        after = without_shared_diagonals(before)
        if not np.array_equal(after.triangles, before.triangles):
            found[i] = after
    return found


def _stitched(whole: PartMeshes, mesh: MeshFacts, deflection: float, plan: Planner) -> tuple[PartMeshes, MeshFacts]:
    """The parts with their borders stitched, and their edges."""
    with plan.deciding():
        borders = mesh.borders_without_brep()
    begin, seams = perf_counter(), 0
    if plan.on("stitching of borders", Facts(borders=sum(borders))):
        parts, seams = stitch_borders(list(whole), borders, deflection)
        if seams:
            whole = combine_parts(parts)
            mesh = _facts(whole)
    plan.spent("stitching of borders", perf_counter() - begin, seams=seams)
    return whole, mesh


def _creased(
    tables: PartTables, mesh: MeshFacts, found: MeshScene, groups: Groups, crease: float
) -> tuple[Kinds, Floats]:
    """The classes (e,) of the edges of parts without B-rep, INTERIOR for all others; the normals (t, 3) of triangles.

    crease: degrees
    """
    points, brep = tables.points, tables.brep
    reliable = reliable_normals(mesh, points, tables.triangles, found.triangle_part, tables.precision)
    sizes = _sizes(found, groups, len(brep))
    kind = creases(mesh, tables.triangles, reliable.fold, found.edge_part, ~brep, crease, points, sizes)
    turned, normals = found.turned, reliable.normals
    return kind, normals if turned is None else np.where(turned[:, None], -normals, normals)


def _searched(whole: PartMeshes, found: MeshScene, groups: Groups, deflection: float, plan: Planner) -> Clashes | None:
    """Where the meshes cross or touch; None where no two come near one another."""
    with plan.deciding():
        meeting = groups.meeting()
    begin, met = perf_counter(), None
    if plan.on("intersection search", Facts(meeting=meeting, folded=found.folded)):
        met = find_clashes(found, groups, deflection)
        met = replace(met, through=met.through | self_intersecting_tori(whole, found))
    plan.spent("intersection search", perf_counter() - begin, clash_tests=0 if met is None else met.tests)
    return met


def _facts(whole: PartMeshes) -> MeshFacts:
    if not whole.tables.within(LARGEST_COORDINATE):
        raise SourceError(
            f"the tessellation has coordinates that are not finite or beyond {LARGEST_COORDINATE:g}: repair the model"
        )
    return whole.tables.facts()


def _sizes(found: MeshScene, groups: Groups, parts: int) -> Floats:
    """(p,) the diagonal of each part's box; 0 where it has no triangles."""
    low, high = np.full((parts, 3), np.inf), np.full((parts, 3), -np.inf)
    np.minimum.at(low, found.group_part, groups.low)
    np.maximum.at(high, found.group_part, groups.high)
    span = np.where(high >= low, high - low, 0.0)
    return np.asarray(np.sqrt((span * span).sum(axis=1)))


def _true_surfaces(whole: PartMeshes, found: MeshScene) -> TrueSurfaces | None:
    """The parameters of all parts' triangles; None where no part has a B-rep."""
    if whole.surfaces is None:
        return None
    tables = whole.tables
    return TrueSurfaces(
        corner=found.corner,
        uv=tables.uv,
        first=tables.face_start[:-1],
        number=tables.face_shape,
        place=found.face_place,
        inward=found.face_inward,
        curved=found.face_curved,
        planar=tables.face_planar,
        curved_faces=found.curved_faces,
        planar_faces=tables.planar_faces,
        surfaces=whole.surfaces,
    )
