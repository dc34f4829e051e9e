"""From segments to the drawing's lines: chained, merged, of coincident ones one, tied to part, edge and face."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats
from hlr.drawing.line import Line
from hlr.drawing.lines import Lines
from hlr.image.camera import Camera
from hlr.linework.curves import EdgeCurveLookup, guides
from hlr.request.accuracy import CLOSED, CURVE_CHORD, Tolerances
from hlr.scene.scene import Scene
from hlr.tables.line_classes import EdgeClass
from hlr.visibility.plan import Plan
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

_RANKS = np.array([KIND_RANK[kind] for kind in EdgeClass], np.uint8)


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
) -> tuple[Sequence[Line], tuple[float, float], int]:
    """All lines, sorted by part, kind, edge and face; the origin: the lower left corner of them all; and of how many a
    curve was looked for.

    projected (n, 3) as Camera.project gives it; per_model millimetres on paper per model unit.
    """
    chains = _chains(scene, plan, segments)
    rank = _RANKS[chains.kind]
    if scene.silhouettes is not None:
        # Where a shaft's outline lies on that of its bore, the shaft's is drawn.
        rank += scene.silhouettes.hidden[chains.first]
    t = tolerances
    cut = _kernel.Cut(
        camera.scaled(per_model),
        projected,
        segments.mesh,
        (segments.edge, segments.t0, segments.t1, segments.state),
        chains,
        rank,
        # The contours of meshes are smoothed; those of a B-rep's tessellation have no accuracy left for it.
        np.array([p.faces == 0 for p in scene.parts], bool)[chains.part],
        _kernel.LineTolerances(
            accuracy=t.accuracy,
            short=t.short,
            flip=t.flip,
            stub=t.stub,
            width=t.width,
            under=t.under,
            thin_paper=t.thin_paper,
            thin_model=t.thin_model,
            chord=CURVE_CHORD,
            closed=CLOSED * t.accuracy / per_model,
            contact=t.contact,
        ),
        hidden,
        threads,
    )
    if len(cut) == 0:
        return (), (0.0, 0.0), 0
    along = guides(scene, plan, chains, cut.chain, edge_curves, camera, per_model, tolerances)
    curves = along.curves
    lines, origin = cut.finished(
        _kernel.Curves(curves.kind, np.ascontiguousarray(curves.range), curves.offsets, curves.values)
        if along.known
        else None,
        along.places,
        along.curve,
        along.place,
        along.bulge,
        threads,
    )
    return Lines(lines), origin, along.sought


def _chains(scene: Scene, plan: Plan, segments: Segments) -> _kernel.Chains:
    """Source edges, then contours of the mesh among the segments' edges."""
    chains = scene.chains
    walks = _kernel.Walks(
        chains.offsets,
        chains.edges,
        chains.reversed,
        chains.kind,
        chains.part,
        chains.index,
        chains.face,
        chains.other,
        plan.straight,
    )
    return _kernel.Chains(
        walks,
        plan.drawn_kind.tolist(),
        segments.mesh,
        segments.groups,
        scene.triangle_part,
        scene.triangle_face,
        np.array([p.faces > 0 for p in scene.parts], bool),
        segments.facing,
        plan.role,
        segments.edge,
    )
