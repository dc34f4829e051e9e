"""The kernel call: an image and a plan in, visible and hidden segments of mesh edges out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.image.image import Image
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


def solve(image: Image, plan: Plan, lifted: Floats, arithmetic: str = "exact") -> Segments:
    """Visibility of all edges that the plan draws; lifted (n, 3) as `Image.lifted` gives it.

    arithmetic: of the predicates, "exact"; "f64" and "f32" serve comparisons only.

    Raises KeyboardInterrupt within milliseconds of Ctrl-C.
    """
    mesh = image.mesh()
    groups = _kernel.Groups(
        image.triangle_group,
        image.edge_group,
        cull=plan.cull,
        sound=plan.sound,
        delta=np.ascontiguousarray(plan.delta),
        # The smaller of tolerance and cap counts: a cap of zero switches the tolerance off and keeps the grid.
        cap=np.ascontiguousarray(plan.cap if plan.contact else np.zeros_like(plan.cap)),
        tight=image.groups.tight,
    )
    found = _kernel.visibility(
        mesh,
        np.ascontiguousarray(lifted),
        groups,
        plan.role,
        _own_faces(image),
        crossings=plan.crossings,
        piercings=plan.piercings,
        pyramid=plan.pyramid,
        arithmetic=arithmetic,
    )
    edge, t0, t1, state = found.edge, found.t0, found.t1, found.state
    contacts = int(np.count_nonzero(state >= WITHIN))
    if contacts:
        # A line on a surface is above or below it by rounding alone: within the tolerance it is visible.
        on_surface = (state >= WITHIN) & image.groups.tight[image.edge_group[edge]]
        state = np.where(on_surface, np.uint8(VISIBLE), state)
    if image.silhouettes is not None and image.silhouettes.hidden.any():
        own = np.flatnonzero(image.silhouettes.hidden).astype(np.int32)
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


def _own_faces(image: Image) -> _kernel.OwnFaces | None:
    """The faces that edges and outlines bound, as the kernel takes them; None where there are none."""
    if image.silhouettes is None or len(image.silhouettes.own.edge) == 0:
        return None
    own = image.silhouettes.own
    face = (own.first[image.triangle_part] + image.triangle_face).astype(np.int32)
    stretches = own.edge, own.range, own.line, own.beside, own.dented
    return _kernel.OwnFaces(*stretches, own.offsets, own.face, own.off, face, own.sheet)
