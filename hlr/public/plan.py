"""`hlr.plan_views`: what a drawing would need, without drawing it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from hlr.common.keywords import expect_record
from hlr.common.threads import at_most
from hlr.common.types import Progress
from hlr.drawing.line import Bounds
from hlr.errors import OptionError
from hlr.pipeline.session import Session
from hlr.request.check import checked, checked_views
from hlr.request.effect import Decision
from hlr.request.options import Options, View
from hlr.window.cut import decide_cut


@dataclass(frozen=True, slots=True)
class ViewPlan:
    """What was decided for one view. Times and counts are those of what had to be done in order to decide.

    view       name of the view; of one without a name its direction
    decisions  one per effect, in the order of the table
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
    options = checked(expect_record(Options, options, "plan_views"))
    if options.section is not None:
        raise OptionError("a plan is that of a whole model: leave out section")
    views = checked_views(views, options)
    if not views:
        return []
    with at_most(options.threads):
        session = Session(source, views, options, progress)
        out = []
        for draft in session.drafts(lines_alone=True):
            image = session.shown(draft)
            draft.planner.on("window")
            if options.window is not None:
                with draft.planner.deciding():
                    flat = image.projected()[:, :2] * image.placement.per_model
                decide_cut(flat, Bounds(*options.window), draft.planner)
            session.plan(draft, image)
            out.append(ViewPlan(image.camera.name, draft.planner.decisions()))
    return out


__all__ = ["ViewPlan", "plan_views"]
