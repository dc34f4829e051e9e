"""What a drawing would need, without drawing it: source -> tessellate -> scene -> plan."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from hlr.common.types import Progress
from hlr.drawing.line import Bounds
from hlr.image.camera import resolve
from hlr.image.clip import clipped
from hlr.image.outlines import with_silhouettes
from hlr.image.placement import place
from hlr.pipeline.staging import seen_through, staged
from hlr.request.check import checked, checked_views
from hlr.request.drawing_effects import DRAWING
from hlr.request.effect import Decision, Planner
from hlr.request.options import Options, View
from hlr.source.chosen import open_chosen
from hlr.visibility.plan import decide
from hlr.window.cut import foreseen


@dataclass(frozen=True, slots=True)
class ViewPlan:
    """What was decided for one view: one `Decision` per effect, in the order of the table.

    Times and counts are those of what had to be done in order to decide.
    """

    view: str
    decisions: tuple[Decision, ...]


def plan_views(
    source: Any, views: Sequence[View], options: Options | None = None, progress: Progress | None = None
) -> list[ViewPlan]:
    """One plan per view, of the drawing that `hlr.draw_views` would make of the same arguments.

    Raises SourceError, ViewError, OptionError.

    >>> import hlr
    >>> (plan,) = hlr.plan_views("part.step", ["iso"])
    >>> reasons = {decision.name: decision.reason for decision in plan.decisions}
    >>> reasons["outlines"]
    '1 curved face may show one'
    """
    options = checked(options or Options())
    views = checked_views(views, options)
    if not views:
        return []
    tell = progress or (lambda _stage, _done: None)
    tell("source", 0.0)
    opened = open_chosen(source, options)
    bounds = opened.bounds()
    cameras = [resolve(view, options, opened.frame, bounds) for view in views]
    tell("tessellate", 0.0)
    placed = [place(c, options, opened, bounds) for c in cameras]
    scene, _, seen = staged(opened, cameras, placed, options, tell, {}, Planner(DRAWING, options))
    out = []
    looks = opened.looks() if opened.transparent() else {}
    for at in seen:
        view = seen_through(scene, looks, at, options)
        outlined = view.outlined or with_silhouettes(
            scene, view.camera, view.at.tolerances, options.threads, view.planner
        )
        seen_of = clipped(outlined, view.camera, view.at.aspect, view.planner)
        view.planner.on("window")
        if options.window is not None:
            with view.planner.deciding():
                flat = view.camera.project(seen_of.points)[:, :2] * view.at.per_model
            foreseen(flat, Bounds(*options.window), view.planner)
        decide(seen_of, view.camera, options, view.at.tolerances, view.planner)
        out.append(ViewPlan(view.camera.name, view.planner.decisions()))
    return out


__all__ = ["ViewPlan", "plan_views"]
