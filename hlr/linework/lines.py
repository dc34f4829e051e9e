"""Segments become lines: chained, merged, without coincident copies, each tied to its part, edge and face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from hlr import _kernel
from hlr.drawing.line import Line
from hlr.drawing.lines import Lines
from hlr.image.image import Image
from hlr.linework.curves import EdgeCurveLookup, guides
from hlr.request.accuracy import CLOSED, CURVE_CHORD
from hlr.tables.line_classes import ranks
from hlr.visibility.plan import Plan
from hlr.visibility.segments import Segments


@dataclass(frozen=True, slots=True)
class Linework:
    """origin: lower left corner of all lines, mm on paper; curves_sought: for how many lines a curve was looked up."""

    lines: Sequence[Line]
    origin: tuple[float, float]
    curves_sought: int


def draw_lines(
    image: Image,
    edge_curves: EdgeCurveLookup,
    plan: Plan,
    segments: Segments,
    hidden: bool,
) -> Linework:
    """All lines, sorted by part, kind, edge and face.

    hidden: hidden lines are drawn as well
    """
    per_model, tolerances = image.placement.per_model, image.placement.tolerances
    chains = _chains(image, plan, segments)
    t = tolerances
    cut = _kernel.Cut(
        image.camera.scaled(per_model),
        segments.mesh,
        segments.found,
        chains,
        ranks(),
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
        image.true_points(),
    )
    if len(cut) == 0:
        return Linework((), (0.0, 0.0), 0)
    along = guides(image, plan, chains, cut, edge_curves)
    lines, origin = cut.finished(None if along is None else along.for_kernel())
    return Linework(Lines(lines), origin, 0 if along is None else along.sought)


def _chains(image: Image, plan: Plan, segments: Segments) -> _kernel.Chains:
    """Walks whose class is drawn, then contours of the mesh among the segments' edges."""
    return _kernel.Chains(
        image.walks,
        plan.visibility_input,
        segments.mesh,
        image.triangle_part,
        image.triangle_face,
        image.has_faces,
        segments.found,
    )
