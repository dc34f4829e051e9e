"""Drawings: one pass through all stages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hlr.common.threads import at_most
from hlr.common.types import Progress
from hlr.drawing.drawing import Drawing
from hlr.drawing.notes import Noted, of_each_view
from hlr.image.paper import at_scale
from hlr.pipeline.session import Session, refuse_warnings
from hlr.request.check import checked, checked_views
from hlr.request.options import Options, Request, View


def draw_views(
    source: Any,
    views: Sequence[View],
    options: Options | None = None,
    progress: Progress | None = None,
    noted: Noted | None = None,
    one_sheet: bool = False,
) -> list[Drawing]:
    """One drawing per view, or per section of a view that several planes cut; the source is read and meshed once.

    source: whatever `hlr.source.open_source` takes. views: names or directions from the object toward the viewer.
    noted: called with the notes on the size of the views as soon as it is known, before the work begins.
    one_sheet: they come on one, where a part has the same hatch in all sections (ISO 128).
    Raises SourceError, ViewError, OptionError; with options.strict StrictError for any warning.
    """
    options = checked(options or Options())
    views = checked_views(views, options)
    if not views:
        return []
    with at_most(options.threads):
        if options.section is not None:
            from hlr.pipeline.section.draw import draw_sections
            from hlr.request.section import check_sections
            from hlr.request.shown_views import shown_views

            check_sections(options.section, views, options.whole)
            shown = shown_views(views, options.section, options.whole)
            drawings = draw_sections(source, shown, options, progress, noted, one_sheet)
        else:
            drawings = _drawn_whole(Session(source, views, options, progress), views, options, noted)
    if options.strict:
        refuse_warnings(of_each_view([each.view.name for each in drawings], [each.notes for each in drawings]))
    return drawings


def _drawn_whole(session: Session, views: Sequence[View], options: Options, noted: Noted | None) -> list[Drawing]:
    """Views of a model that no section cuts."""
    if noted is not None:
        notes = [placement.notes for placement in session.placements]
        noted(of_each_view([camera.name for camera in session.cameras], notes))
    drawings = []
    for i, (view, draft) in enumerate(zip(views, session.drafts(lines_alone=True), strict=True)):
        session.progress("visibility", i / len(views))
        asked = at_scale(options, draft.image.placement.scale) if options.same_scale else options
        drawings.append(session.drawing(draft, Request(view, asked)))
    session.progress("linework", 1.0)
    return drawings
