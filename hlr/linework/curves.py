"""The curves along which lines run: those of B-rep edges, outlines, intersection lines, circles of meshes.

The visibility pass works on mesh edges and decides where each line ends. The kernel then replaces each polyline by the
interval of its curve between these ends: on paper an arc, a chain of Bezier curves or a straight line
(`kernel/linework/src/fit`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.image.image import Image
from hlr.linework.circles import circles
from hlr.source.curve_records import concatenate_curves, pack_curves
from hlr.source.model import Curves, EdgeCurves
from hlr.visibility.plan import Plan

EdgeCurveLookup = Callable[[Ints, Ints], EdgeCurves] | None
"""The curves of edges, given their parts and indices; None where the source has none."""

NO_CURVES = pack_curves([])
HERE = np.eye(3, 4)[None]
"""(1, 3, 4) the identity: the place of curves that are in model coordinates already."""


@dataclass(frozen=True, slots=True)
class Guides:
    """Curves of c chains. curves: n records; places (p, 3, 4): matrices into the model.

    curve (c,): each chain's record, -1 for none; place (c,): its matrix; bulge (c,): the most that the curve rises
    above the chords that it was found on, millimetres on paper; sought: for how many lines a curve was looked up
    """

    curves: Curves
    places: Floats
    curve: Ints
    place: Ints
    bulge: Floats
    sought: int

    def for_kernel(self) -> tuple[_kernel.Curves, Floats, Ints, Ints, Floats]:
        """As the kernel takes them."""
        c = self.curves
        records = _kernel.Curves(c.kind, np.ascontiguousarray(c.range), c.offsets, c.values)
        return records, self.places, self.curve, self.place, self.bulge


def guides(
    image: Image, plan: Plan, chains: _kernel.Chains, cut: _kernel.Cut, edge_curves: EdgeCurveLookup
) -> Guides | None:
    """The curves of chains; None where no line can have one. Only the curves of lines that were cut are looked up."""
    round_ = circles(image, plan, chains)
    edges_are_straight = chains.all_straight or edge_curves is None
    no_other_curves = image.silhouettes is None and image.intersections is None and round_ is None
    if edges_are_straight and no_other_curves and not plan.every_curve:
        return None
    edge, part, straight = chains.edge, chains.part, chains.straight
    # number (c,): the outline or circle of each chain; both are in model coordinates already.
    number, own, bulge = np.full(len(edge), -1, np.int32), NO_CURVES, np.zeros(0)
    silhouettes = image.silhouettes
    if silhouettes is not None:
        number = silhouettes.number[chains.first]
        source = np.append(silhouettes.source, np.int32(-1))[number]
        edge = np.where(source >= 0, source, edge).astype(np.int32)
        own, bulge = silhouettes.curves, np.zeros(len(silhouettes.curves.kind))
    met = image.intersections
    if met is not None:
        of_edge = np.full(len(image.edges), -1, np.int32)
        of_edge[image.walks.edges] = np.repeat(image.walks.curve, np.diff(image.walks.offsets))
        which = of_edge[chains.first]
        number = np.where(which >= 0, which + len(own.kind), number).astype(np.int32)
        own = concatenate_curves(own, met.curves)
        bulge = np.concatenate([bulge, met.rise * image.placement.per_model])
    if plan.every_curve and edge_curves is not None:
        edge_curves(part[straight], edge[straight])
    # Two planes meet in the straight line between the vertices: there is no curve to look up.
    edge[straight] = -1
    if round_ is not None:
        number = np.where(round_.number >= 0, round_.number + len(own.kind), number).astype(np.int32)
        own, bulge = concatenate_curves(own, round_.curves), np.concatenate([bulge, round_.bulge])
    if not len(own.kind) and (edge_curves is None or edge.max(initial=-1) < 0):
        return None
    lines = cut.chain
    sought = int(((edge >= 0) | (number >= 0))[lines].sum())

    curve, place = np.full(len(edge), -1, np.int32), np.zeros(len(edge), np.int32)
    curves, places = NO_CURVES, HERE
    drawn = np.zeros(len(edge), bool)
    drawn[lines] = True
    tied = np.flatnonzero(drawn & (edge >= 0))
    if len(tied) and edge_curves is not None:
        found = edge_curves(part[tied], edge[tied])
        curve[tied], place[tied] = found.which, found.place
        curves, places = found.curves, np.concatenate([found.places, HERE])
    rises = np.zeros(len(edge))
    if len(own.kind):
        loose = np.flatnonzero((edge < 0) & (number >= 0))
        curve[loose], place[loose] = number[loose] + len(curves.kind), len(places) - 1
        rises[loose] = bulge[number[loose]]
        curves = concatenate_curves(curves, own)
    return Guides(curves, places, curve, place, rises, sought)
