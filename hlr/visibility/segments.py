"""The kernel call: scene, view and plan in, visible and hidden segments of mesh edges out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.plan.plan import Plan
from hlr.scene.scene import Scene
from hlr.source.model import Floats, Ints

VISIBLE, HIDDEN, WITHIN, DIVING = 0, 1, 2, 3


@dataclass(frozen=True, slots=True)
class Segments:
    """Pieces of mesh edges, sorted by edge and parameter.

    edge (s,), t0 (s,), t1 (s,) from the edge's first to its second vertex on the image; state (s,) VISIBLE, HIDDEN or
    WITHIN (hidden by less than the contact tolerance) or DIVING (the same, on the way to hidden); facing (t,) int8 of
    every triangle; seconds of the kernel's steps.
    """

    edge: Ints
    t0: Floats
    t1: Floats
    state: npt.NDArray[np.uint8]
    facing: npt.NDArray[np.int8]
    counters: dict[str, int]
    seconds: dict[str, float]


def solve(scene: Scene, plan: Plan, projected: Floats, threads: int, arithmetic: str = "exact") -> Segments:
    """Visibility of all edges that the plan draws; projected (n, 3) as Camera.project gives it.

    arithmetic: of the predicates, "exact"; "f64" and "f32" show what that is worth, and are for nothing else.

    Raises KeyboardInterrupt within milliseconds of Ctrl-C.
    """
    found = _kernel.visibility(
        np.ascontiguousarray(projected),
        scene.triangles,
        scene.triangle_group,
        scene.edges,
        scene.offsets,
        scene.incident,
        scene.edge_group,
        plan.role,
        plan.cull,
        plan.sound,
        np.ascontiguousarray(plan.delta),
        # Of tolerance and cap the less counts: so the grid, which leaves room for the tolerance, stays the same.
        np.ascontiguousarray(plan.cap if plan.contact else np.zeros_like(plan.cap)),
        scene.groups.tight,
        threads,
        arithmetic,
        plan.crossings,
        plan.piercings,
        plan.pyramid,
        _own_faces(scene),
    )
    state, edge = found["state"], found["edge"]
    contacts = found["counters"]["contacts"] = int(np.count_nonzero(state >= WITHIN))
    if contacts:
        # A line on a surface is never quite above or below it: less than the tolerance means nothing there.
        state[(state >= WITHIN) & scene.groups.tight[scene.edge_group[edge]]] = VISIBLE
    t0, t1 = found["t0"], found["t1"]
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
        facing=found["facing"],
        counters=found["counters"],
        seconds=found["seconds"],
    )


def _own_faces(scene: Scene) -> tuple[npt.NDArray[Any], ...] | None:
    """`own` of the kernel."""
    if scene.silhouettes is None or len(scene.silhouettes.own.edge) == 0:
        return None
    own = scene.silhouettes.own
    face = (own.first[scene.triangle_part] + scene.triangle_face).astype(np.int32)
    stretches = own.edge, own.range, own.line, own.beside, own.dented
    return *stretches, own.offsets, own.face, own.off, face, own.sheet
