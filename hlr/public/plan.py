"""`hlr.plan_views`: what a drawing would need, without drawing it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Unpack

from hlr.common.keywords import expect_record, shown
from hlr.common.threads import at_most
from hlr.common.types import Progress
from hlr.drawing.line import Bounds
from hlr.pipeline.session import Draft, Session
from hlr.request.check import checked, checked_views
from hlr.request.effect import Decision
from hlr.request.options import Options, View, Wishes
from hlr.window.cut import decide_cut


@dataclass(frozen=True, slots=True)
class ViewPlan:
    """What was decided for one view. Times and counts are those of what had to be done in order to decide.

    view       name of the view; of one without a name its direction
    decisions  one per effect, in the order of the table
    """

    view: str
    decisions: tuple[Decision, ...]


@shown(Options)
def plan_views(
    source: Any,
    views: Sequence[View],
    options: Options | None = None,
    progress: Progress | None = None,
    **wishes: Unpack[Wishes],
) -> list[ViewPlan]:
    """One plan per view, or section of a view, of the drawing that `hlr.draw_views` would make of the same arguments.

    For a section the model is cut: the plan is that of what its plane leaves, and says how many parts it cuts.

    Raises SourceError, ViewError, OptionError.

    >>> import hlr
    >>> (plan,) = hlr.plan_views("part.step", ["iso"])
    >>> reasons = {decision.name: decision.reason for decision in plan.decisions}
    >>> reasons["outlines"]
    '1 curved face may show one'
    """
    options = checked(expect_record(Options, options, "plan_views", wishes))
    views = checked_views(views, options)
    if not views:
        return []
    found: dict[int, ViewPlan] = {}
    with at_most(options.threads):
        for names, session, drafts in _groups(source, views, options, progress):
            for (number, name), draft in zip(names.items(), drafts, strict=True):
                image = session.shown(draft)
                draft.planner.on("window")
                if options.window is not None:
                    with draft.planner.deciding():
                        flat = image.projected()[:, :2] * image.placement.per_model
                    decide_cut(flat, Bounds(*options.window), draft.planner)
                session.plan(draft, image)
                found[number] = ViewPlan(name, draft.planner.decisions())
    return [found[number] for number in range(len(found))]


def _groups(
    source: Any, views: Sequence[View], options: Options, progress: Progress | None
) -> Iterator[tuple[dict[int, str], Session, list[Draft]]]:
    """What is drawn of the source and of what sections leave of it: numbers and names of views, and their drafts."""
    if options.section is None:
        session = Session(source, views, options, progress)
        names = {number: camera.name for number, camera in enumerate(session.cameras)}
        yield names, session, session.drafts(lines_alone=True)
        return
    from hlr.pipeline.section.draw import groups_of
    from hlr.request.section import check_sections
    from hlr.request.shown_views import shown_views
    from hlr.source.selection import open_selected

    check_sections(options.section, views, options.whole)
    shown = shown_views(views, options.section, options.whole)
    for group in groups_of(open_selected(source, options), shown, options, progress):
        yield {number: shown[number].name for number in group.numbers}, group.session, group.drafts()


__all__ = ["ViewPlan", "plan_views"]
