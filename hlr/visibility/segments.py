"""The kernel call: scene, view and plan in, visible and hidden segments of mesh edges out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.scene.scene import Scene
from hlr.visibility.plan import Plan

VISIBLE, HIDDEN, WITHIN, DIVING = 0, 1, 2, 3


@dataclass(frozen=True, slots=True)
class Segments:
    """Pieces of mesh edges, sorted by edge and parameter.

    edge (s,), t0 (s,), t1 (s,) from the edge's first to its second vertex on the image; state (s,) VISIBLE, HIDDEN or
    WITHIN (hidden by less than the contact tolerance) or DIVING (the same, on the way to hidden); facing (t,) int8 of
    every triangle; seconds of the kernel's steps. mesh, groups: what they were found on.
    """

    edge: Ints
    t0: Floats
    t1: Floats
    state: npt.NDArray[np.uint8]
    facing: npt.NDArray[np.int8]
    counters: dict[str, int]
    seconds: dict[str, float]
    mesh: _kernel.Mesh
    groups: _kernel.Groups


def solve(scene: Scene, plan: Plan, projected: Floats, threads: int, arithmetic: str = "exact") -> Segments:
    """Visibility of all edges that the plan draws; projected (n, 3) as Camera.project gives it.

    arithmetic: of the predicates, "exact"; "f64" and "f32" show what that is worth, and are for nothing else.

    Raises KeyboardInterrupt within milliseconds of Ctrl-C.
    """
    mesh = scene.mesh()
    groups = _kernel.Groups(
        scene.triangle_group,
        scene.edge_group,
        cull=plan.cull,
        sound=plan.sound,
        delta=np.ascontiguousarray(plan.delta),
        # Of tolerance and cap the less counts: so the grid, which leaves room for the tolerance, stays the same.
        cap=np.ascontiguousarray(plan.cap if plan.contact else np.zeros_like(plan.cap)),
        tight=scene.groups.tight,
    )
    found = _kernel.visibility(
        mesh,
        np.ascontiguousarray(projected),
        groups,
        plan.role,
        _own_faces(scene),
        crossings=plan.crossings,
        piercings=plan.piercings,
        pyramid=plan.pyramid,
        arithmetic=arithmetic,
        threads=threads,
    )
    edge, t0, t1, state = found.edge, found.t0, found.t1, found.state
    contacts = int(np.count_nonzero(state >= WITHIN))
    if contacts:
        # A line on a surface is never quite above or below it: less than the tolerance means nothing there.
        on_surface = (state >= WITHIN) & scene.groups.tight[scene.edge_group[edge]]
        state = np.where(on_surface, np.uint8(VISIBLE), state)
    if scene.silhouettes is not None and scene.silhouettes.hidden.any():
        own = np.flatnonzero(scene.silhouettes.hidden).astype(np.int32)
        order = np.argsort(np.concatenate([edge, own]), kind="stable")
        edge = np.concatenate([edge, own])[order]
        t0 = np.concatenate([t0, np.zeros(len(own))])[order]
        t1 = np.concatenate([t1, np.ones(len(own))])[order]
        state = np.concatenate([state, np.full(len(own), HIDDEN, np.uint8)])[order]
    return Segments(
        edge=edge,
        t0=t0,
        t1=t1,
        state=state,
        facing=found.facing,
        counters={**found.counters, "contacts": contacts},
        seconds=found.seconds,
        mesh=mesh,
        groups=groups,
    )


def _own_faces(scene: Scene) -> _kernel.OwnFaces | None:
    """The faces that edges and outlines bound, as the kernel takes them; None where there are none to think of."""
    if scene.silhouettes is None or len(scene.silhouettes.own.edge) == 0:
        return None
    own = scene.silhouettes.own
    face = (own.first[scene.triangle_part] + scene.triangle_face).astype(np.int32)
    stretches = own.edge, own.range, own.line, own.beside, own.dented
    return _kernel.OwnFaces(*stretches, own.offsets, own.face, own.off, face, own.sheet)
