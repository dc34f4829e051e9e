"""The kernel call: an image and a plan in, visible and hidden segments of mesh edges out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.image.image import Image
from hlr.visibility.plan import Plan

VISIBLE, HIDDEN, WITHIN, DIVING = 0, 1, 2, 3


@dataclass(frozen=True, slots=True)
class Segments:
    """Pieces of mesh edges, as the kernel holds them.

    found: the pieces, sorted by edge and parameter, states numbered as above; mesh: what they were found on
    """

    found: _kernel.Visibility
    mesh: _kernel.Mesh


def solve(image: Image, plan: Plan, lifted: Floats, arithmetic: str = "exact") -> Segments:
    """Visibility of all edges that the plan draws; lifted (n, 3) as `Image.lifted` gives it.

    arithmetic: of the predicates, "exact"; "f64" and "f32" serve comparisons only.

    Raises KeyboardInterrupt within milliseconds of Ctrl-C.
    """
    mesh = image.mesh()
    found = _kernel.visibility(
        mesh,
        np.ascontiguousarray(lifted),
        plan.visibility_input,
        _own_faces(image),
        None if image.silhouettes is None else image.silhouettes.hidden,
        contact=plan.contact,
        crossings=plan.crossings,
        piercings=plan.piercings,
        pyramid=plan.pyramid,
        arithmetic=arithmetic,
    )
    return Segments(found, mesh)


def _own_faces(image: Image) -> tuple[_kernel.Stretches, Ints] | None:
    """Edges whose own faces are seen nearly edge-on, and the face of each triangle; None where there are none."""
    if image.silhouettes is None or len(image.silhouettes.own) == 0:
        return None
    first = image.silhouettes.first
    return image.silhouettes.own, (first[image.triangle_part] + image.triangle_face).astype(np.int32)
