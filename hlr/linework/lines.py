"""From segments to the drawing's lines: chained, merged, of coincident ones one, tied to part, edge and face."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.drawing import Line
from hlr.linework.circles import circles
from hlr.linework.contours import lifted, with_contours
from hlr.linework.exact import NO_CURVES, EdgeCurveLookup, Loose, on_curves, polylines
from hlr.linework.outlines import LineChains, outlines
from hlr.plan.plan import Plan
from hlr.scene.scene import Scene
from hlr.source.geometry import together
from hlr.source.model import EdgeClass, Floats, Ints
from hlr.tolerance import Tolerances
from hlr.view.camera import Camera
from hlr.visibility.segments import Segments

KIND_RANK = {
    EdgeClass.SHARP: 0,
    EdgeClass.BOUNDARY: 1,
    EdgeClass.INTERSECTION: 2,
    EdgeClass.OUTLINE: 3,
    EdgeClass.SMOOTH: 16,
    EdgeClass.SEAM: 32,
}
"""Of coincident lines the lower sixteen is drawn (a tangent edge or a seam never lies on top of an outline), of equal
ones the nearer: what one would see. Only at the same depth does the kind decide."""


BORDER = {EdgeClass.SHARP: 1, EdgeClass.BOUNDARY: 1, EdgeClass.OUTLINE: 2}
"""Where a surface may end in the image, lines on which others disappear: 1 for edges, 2 for outlines, else 0."""


def draw_lines(
    scene: Scene,
    edge_curves: EdgeCurveLookup,
    plan: Plan,
    segments: Segments,
    camera: Camera,
    projected: Floats,
    per_model: float,
    tolerances: Tolerances,
    hidden: bool,
    threads: int,
) -> tuple[tuple[Line, ...], tuple[float, float], int]:
    """All lines, sorted by part, kind, edge and face; the origin: the lower left corner of them all; and of how many a
    curve was looked for.

    projected (n, 3) as Camera.project gives it; per_model millimetres on paper per model unit.
    """
    chains = _all_chains(scene, plan, segments)
    rank = np.array([KIND_RANK[EdgeClass(k)] for k in range(6)], np.uint8)[chains.kind]
    if scene.silhouettes is not None:
        # Where a shaft's outline lies on that of its bore, the shaft's is drawn.
        rank += scene.silhouettes.hidden[chains.edges[chains.offsets[:-1]]]
    # The contours of meshes are smoothed; those of a B-rep's tessellation have no accuracy left for it.
    bare = np.array([p.faces == 0 for p in scene.parts], bool)[chains.part]
    found = _kernel.linework(
        np.ascontiguousarray(projected[:, :2] * per_model),
        scene.points,
        camera.eye is not None,
        camera.eye or (0.0, 0.0, 0.0),
        (-camera.direction[0], -camera.direction[1], -camera.direction[2]),
        scene.edges,
        segments.edge,
        segments.t0,
        segments.t1,
        segments.state,
        chains.offsets,
        chains.edges,
        chains.reversed,
        rank,
        chains.noisy,
        bare,
        tolerances.accuracy,
        tolerances.short,
        tolerances.flip,
        tolerances.stub,
        tolerances.width,
        tolerances.under,
        tolerances.thin_paper,
        tolerances.thin_model,
        threads,
    )
    if not hidden:
        found = _in_sight(found)
    keep = np.flatnonzero(found["visible"] | hidden)
    if len(keep) == 0:
        return (), (0.0, 0.0), 0
    chain = found["chain"]
    space = lifted(found, (chains.noisy & bare)[chain], camera, per_model)
    border = np.array([BORDER.get(EdgeClass(k), 0) for k in range(6)], np.uint8)[chains.kind]
    # The outline of a mesh is an edge of it.
    border[bare & (border == BORDER[EdgeClass.OUTLINE])] = BORDER[EdgeClass.BOUNDARY]
    edge, loose = _guides(scene, plan, chains, edge_curves, camera, per_model, tolerances)
    sought = (
        int(((edge >= 0) | (loose.number >= 0))[chain].sum())
        if edge_curves is not None or len(loose.curves.kind)
        else 0
    )
    if edge_curves is None and len(loose.curves.kind) == 0 and len(found["curve"]) == 0:
        drawn = polylines(found["offsets"], found["flat"], space)
    else:
        drawn = on_curves(
            found["offsets"],
            found["flat"],
            space,
            chains.part[chain],
            edge[chain],
            replace(loose, number=loose.number[chain]),
            chain,
            found["visible"],
            border[chain],
            edge_curves,
            camera,
            per_model,
            tolerances,
            threads,
        )
    drawn = with_contours(drawn, found)
    low = drawn.low(keep)
    flat, offsets, curves = drawn.flat - low, drawn.offsets, drawn.curves(low)
    space = drawn.space
    flat.flags.writeable = space.flags.writeable = False
    order = keep[np.lexsort((keep, *_identity(chains, chain[keep])))]
    names = [k.name.lower() for k in EdgeClass]
    kinds = chains.kind[chain].tolist()
    part, tie, face, other = (a[chain].tolist() for a in (chains.part, chains.edge, chains.face, chains.other))
    visible, start = found["visible"].tolist(), offsets.tolist()
    lines = tuple(
        Line(
            names[kinds[i]],
            visible[i],
            part[i],
            tie[i] if tie[i] >= 0 else None,
            face[i] if face[i] >= 0 else None,
            flat[start[i] : start[i + 1]],
            space[start[i] : start[i + 1]],
            other[i] if other[i] >= 0 else None,
            curves.get(i),
        )
        for i in order.tolist()
    )
    return lines, (float(low[0]), float(low[1])), sought


def _in_sight(found: dict[str, Any]) -> dict[str, Any]:
    """The kernel's lines without those of chains of which nothing is visible.

    Hidden lines beside visible ones of the same chain stay: both end where they meet, and that place is sought as one.
    """
    seen = np.zeros(int(found["chain"].max(initial=-1)) + 1, bool)
    seen[found["chain"][found["visible"]]] = True
    keep = seen[found["chain"]]
    if keep.all():
        return found
    out = dict(found)
    for offsets, members in (("offsets", ("flat", "space")), ("curve_offsets", ("curve",))):
        count = np.diff(found[offsets])
        kept = np.repeat(keep, count)
        out[offsets] = np.concatenate([[0], np.cumsum(count[keep])]).astype(np.int32)
        out |= {name: np.ascontiguousarray(found[name][kept]) for name in members}
    return out | {
        name: np.ascontiguousarray(found[name][keep]) for name in ("chain", "visible", "length", "curve_bounds")
    }


def _guides(
    scene: Scene,
    plan: Plan,
    chains: LineChains,
    edge_curves: EdgeCurveLookup,
    camera: Camera,
    per_model: float,
    tolerances: Tolerances,
) -> tuple[Ints, Loose]:
    """Per chain the edge of the model along which it runs, -1 for none, and the curves of outlines and circles."""
    edge, number = chains.edge, np.full(len(chains.edge), -1, np.int32)
    curves = NO_CURVES
    silhouettes = scene.silhouettes
    if silhouettes is not None:
        number = silhouettes.number[chains.edges[chains.offsets[:-1]]]
        source = np.append(silhouettes.source, np.int32(-1))[number]
        edge = np.where(source >= 0, source, edge).astype(np.int32)
        curves = silhouettes.curves
    if plan.every_curve and edge_curves is not None:
        edge_curves(chains.part[chains.straight], chains.edge[chains.straight])
    if len(edge):
        # Where two planes meet, the line between the vertices is all there is to know.
        edge = np.where(chains.straight, -1, edge).astype(np.int32)
    bulge = np.zeros(len(curves.kind))
    round_ = circles(scene, plan, chains, camera, per_model, tolerances)
    if round_ is not None:
        number = np.where(round_.number >= 0, round_.number + len(curves.kind), number).astype(np.int32)
        curves, bulge = together(curves, round_.curves), np.concatenate([bulge, round_.bulge])
    return edge, Loose(curves, number, bulge)


def _identity(chains: LineChains, chain: Ints) -> tuple[npt.NDArray[Any], ...]:
    """Sort keys, least significant first."""
    return chains.other[chain], chains.face[chain], chains.edge[chain], chains.kind[chain], chains.part[chain]


def _all_chains(scene: Scene, plan: Plan, segments: Segments) -> LineChains:
    """Source edges, then outlines."""
    source = scene.chains
    outline = outlines(scene, plan, segments)
    # Chains of a kind that was not asked for may still hold contours: those are drawn as outlines instead.
    asked = np.flatnonzero(plan.drawn_kind[source.kind])
    count = np.diff(source.offsets)[asked]
    offsets = np.zeros(len(asked) + 1, np.int32)
    np.cumsum(count, out=offsets[1:])
    member = np.arange(offsets[-1]) + np.repeat(source.offsets[asked] - offsets[:-1], count)
    return LineChains(
        offsets=np.concatenate([offsets, outline.offsets[1:] + offsets[-1]]).astype(np.int32),
        edges=np.concatenate([source.edges[member], outline.edges]).astype(np.int32),
        reversed=np.concatenate([source.reversed[member], outline.reversed]),
        kind=np.concatenate([source.kind[asked], outline.kind]),
        part=np.concatenate([source.part[asked], outline.part]),
        edge=np.concatenate([source.index[asked], outline.edge]),
        face=np.concatenate([source.face[asked], outline.face]),
        other=np.concatenate([source.other[asked], outline.other]),
        noisy=np.concatenate([np.zeros(len(asked), bool), outline.noisy]),
        straight=np.concatenate([plan.straight[asked], outline.straight]),
    )
