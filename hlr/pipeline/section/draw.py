"""Views of which some are sections: each section is drawn of what its plane leaves of the model, and hatched."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from hlr.common.clock import lap
from hlr.common.types import Progress
from hlr.drawing.drawing import Drawing
from hlr.drawing.notes import OF_BORDERS, Note, Noted, of_each_view
from hlr.errors import counted
from hlr.image.paper import at_scale
from hlr.linework.hatching import Pattern
from hlr.pipeline.section.hatches import CutDrawing, cut_drawing, patterns_of, with_hatches
from hlr.pipeline.section.plane import Planes, planes_of
from hlr.pipeline.section.sources import CutSource, cut_source
from hlr.pipeline.session import Draft, Session
from hlr.request.directions import directed
from hlr.request.effect import Facts
from hlr.request.options import Options, Request
from hlr.request.shown_views import ShownView
from hlr.source.cad.brep_source import BrepSource
from hlr.source.joined import JoinedSource
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.model import Source
from hlr.source.selection import matching, open_selected

AT_PLANE = 100.0
"""Times what lies so close to a plane lies on it: how far off it a part may end that was cut there."""


@dataclass(frozen=True, slots=True)
class _Cut:
    """A section before it is drawn. seconds: that it took to cut the model."""

    planes: Planes
    source: CutSource
    seconds: float


@dataclass(frozen=True, slots=True)
class _Section:
    """A section that is drawn but for its hatches. number: of the view; seconds: that it took to find its faces."""

    number: int
    cut: _Cut
    to_hatch: CutDrawing
    seconds: float


@dataclass(frozen=True, slots=True)
class ViewGroup:
    """Views that are drawn of one source: all those that are not cut, or a section.

    numbers: of the views; cut: None where they are not cut
    """

    numbers: list[int]
    session: Session
    cut: _Cut | None

    def drafts(self) -> list[Draft]:
        """One per view, as of `Session.drafts`; that a view is cut is one of its decisions."""
        drafts = self.session.drafts(lines_alone=True)
        if self.cut is not None:
            parts = len(self.cut.source.cut)
            for draft in drafts:
                draft.planner.on("section", Facts(cut=parts))
                draft.planner.spent("section", self.cut.seconds, cut_parts=parts)
        return drafts


_KNOWN: WeakKeyDictionary[Source, dict[Any, _Cut]] = WeakKeyDictionary()
"""Sections of a source that is there still: the passes of a drawing within a time, or of a page, cut it once."""


def draw_sections(
    source: Any,
    views: Sequence[ShownView],
    options: Options,
    progress: Progress | None = None,
    noted: Noted | None = None,
    one_sheet: bool = False,
) -> list[Drawing]:
    """One drawing per view, as `hlr.pipeline.draw.draw_views`, some of them cut.

    options: checked; one_sheet: as of that.
    Raises as that, and OptionError where a plane cuts nothing or leaves nothing.
    """
    started = perf_counter()
    opened = open_selected(source, options)
    reading = perf_counter() - started
    groups = groups_of(opened, views, options, progress)
    for group in groups:
        group.session.clock["source"] += reading
    if noted is not None:
        early: list[list[Note]] = [[] for _ in views]
        for group in groups:
            for k, placement in zip(group.numbers, group.session.placements, strict=True):
                failed = [] if group.cut is None else _failed(views[k].name, group.cut)
                early[k] = [*placement.notes, *failed]
        noted(of_each_view([view.name for view in views], early))
    found: dict[int, Drawing] = {}
    sections: list[_Section] = []
    for group in groups:
        session, cut = group.session, group.cut
        for k, draft in zip(group.numbers, group.drafts(), strict=True):
            session.progress("visibility", len(found) / len(views))
            scale = draft.image.placement.scale
            asked = _of_one(at_scale(options, scale) if options.same_scale else options, views[k])
            found[k] = session.drawing(draft, Request(views[k].view, asked))
            if cut is not None:
                started = perf_counter()
                to_hatch = cut_drawing(found[k], session, cut.planes, cut.source, opened)
                sections.append(_Section(k, cut, to_hatch, perf_counter() - started))
    for sheet in [sections] if one_sheet and sections else [[each] for each in sections]:
        patterns = patterns_of([each.to_hatch for each in sheet])
        found.update((each.number, _finished(each, patterns, views[each.number].name)) for each in sheet)
    drawings = [found[k] for k in range(len(views))]
    least = min(drawing.scale for drawing in drawings)
    if options.same_scale and any(drawing.scale > least for drawing in drawings):
        alike = replace(at_scale(options, least), same_scale=False)
        return draw_sections(opened, views, alike, progress, one_sheet=one_sheet)
    if progress is not None:
        progress("linework", 1.0)
    return drawings


def groups_of(
    opened: Source, views: Sequence[ShownView], options: Options, progress: Progress | None = None
) -> list[ViewGroup]:
    """What is drawn of a source and of what planes leave of it. Raises as `draw_sections`."""
    if progress is not None:
        progress("section", 0.0)
    cuts = [_cut_for(view, opened, options) for view in views]
    plain = [k for k, cut in enumerate(cuts) if cut is None]
    groups: list[ViewGroup] = []
    if plain:
        alone = replace(options, section=None, whole=())
        groups.append(ViewGroup(plain, Session(opened, [views[k].view for k in plain], alone, progress), None))
    for k, cut in enumerate(cuts):
        if cut is not None:
            asked, on_cut = _of_section(options), cut.planes.contain if cut.source.cut else None
            session = Session(cut.source.source, [views[k].view], asked, progress, on_cut=on_cut)
            session.clock["source"] += cut.seconds
            groups.append(ViewGroup([k], session, cut))
    return groups


def _cut_for(shown: ShownView, source: Source, options: Options) -> _Cut | None:
    view, place = shown.view, shown.place
    if place is None:
        return None
    known = _KNOWN.setdefault(source, {}) if isinstance(source, BrepSource | MeshSource | JoinedSource) else {}
    # True and 1.0 are equal.
    key = directed(view)[1], place is True, place, tuple(options.uncut)
    if key not in known:
        started = perf_counter()
        planes = planes_of(place, view, source, options)
        cut = cut_source(source, planes, matching(options.uncut, source, "uncut"))
        found = _Cut(planes, cut, perf_counter() - started)
        if cut.source is source:
            return found
        known[key] = found
    return known[key]


def _of_section(options: Options) -> Options:
    """The options of a section: without hidden lines where nothing else is asked for (ISO 128)."""
    return replace(options, hidden=bool(options.hidden))


def _of_one(options: Options, shown: ShownView) -> Options:
    """The options of a view by itself."""
    return replace(options, section=shown.place, whole=(), uncut=() if shown.place is None else options.uncut)


def _finished(section: _Section, patterns: Mapping[str, Pattern], name: str) -> Drawing:
    """The drawing with its hatches, and what is to be said about them."""
    cut, session = section.cut, section.to_hatch.session
    started, clock = perf_counter() - section.seconds, dict(section.to_hatch.drawing.timings)
    drawing = with_hatches(section.to_hatch, patterns)
    told = (_after_cut(note, name) for note in drawing.notes) if cut.source.cut else drawing.notes
    notes = *told, *_failed(name, cut), *_notes(drawing, session, cut, name)
    drawing = replace(drawing, notes=notes, view=replace(drawing.view, name=name))
    lap(clock, "linework", started)
    clock["total"] = sum(seconds for stage, seconds in clock.items() if stage != "total")
    return replace(drawing, timings=clock)


def _after_cut(note: Note, name: str) -> Note:
    """A note that counts border edges: those at the plane are among them, and the model itself has fewer."""
    return replace(note, text=f"section {name}, after the cut: {note.text}") if note.code in OF_BORDERS else note


def _failed(name: str, cut: _Cut) -> list[Note]:
    """What is said of the parts that OpenCASCADE cannot cut, one note for each reason."""
    reasons: dict[tuple[str, str], list[str]] = {}
    for part, error in cut.source.failed.items():
        reasons.setdefault((error.why, error.cure), []).append(part)
    notes = []
    for (why, cure), parts in reasons.items():
        more = f" ({counted(len(parts) - 1, 'more part')} likewise)" if len(parts) > 1 else ""
        text = f'"{parts[0]}" stays whole, because {why}{more}: {cure}, or name it in uncut.'
        notes.append(Note("section-not-cut", f"section {name}: {text}"))
    return notes


def _notes(drawing: Drawing, session: Session, cut: _Cut, name: str) -> list[Note]:
    """What is said of a section that does not show all that one expects of it."""
    assert drawing.section is not None
    hatched = {cut.source.whose[drawing.parts[k].name] for k in drawing.section.parts}
    are_open = {cut.source.whose[part] for part, is_cut in cut.source.open.items() if is_cut}
    at_plane = _at_plane(session, cut)
    # A body of a mesh that has no cut face only touches the plane.
    unhatchable = are_open | (cut.source.cut - hatched - cut.source.meshes)
    unhatched = sorted(unhatchable & at_plane)
    if cut.planes.touching:
        text = f"the plane of section {name} only touches the model: nothing is taken away."
    elif not cut.source.cut and not hatched and cut.source.through:
        text = f"all parts that the plane of section {name} goes through stay whole: nothing is hatched."
    elif not unhatched and not hatched:
        text = f"the plane of section {name} goes through no part: nothing is hatched."
    elif unhatched:
        several = f"{len(unhatched)} parts that it cuts, such as" if len(unhatched) > 1 else "it cuts"
        if unhatched[0] in hatched:
            several += " bodies of"
        text = f'section {name}: {several} "{unhatched[0]}", without a closed surface, and so without a hatch.'
    else:
        return []
    return [Note("section-not-hatched", text)]


def _at_plane(session: Session, cut: _Cut) -> set[str]:
    """Names of the parts whose faces reach a plane: edges without faces have nothing to hatch.

    Other parts are cut by the steps of the plane alone, or have bodies on both sides of it.
    """
    planes, near = cut.planes.stepped(), AT_PLANE * cut.planes.near
    return {
        cut.source.whose[part.name]
        for part in session.parts
        if len(part.triangles) and float(np.abs(planes.heights(part.points)).min()) <= near
    }
