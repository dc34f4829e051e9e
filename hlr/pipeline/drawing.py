"""The stages in order: source -> tessellate -> scene -> plan -> visibility -> linework -> drawing."""

from __future__ import annotations

from collections.abc import Sequence
from time import perf_counter
from typing import Any

from hlr.common.clock import Clock, lap
from hlr.common.types import Progress
from hlr.drawing.drawing import Drawing
from hlr.drawing.notes import Note
from hlr.errors import StrictError
from hlr.image.camera import resolve
from hlr.image.clip import clipped
from hlr.image.outlines import with_silhouettes
from hlr.image.placement import place
from hlr.image.transparency import hiding
from hlr.linework.curves import EdgeCurveLookup
from hlr.linework.lines import draw_lines
from hlr.pipeline.finish import finished
from hlr.pipeline.staging import Staged, seen_through, staged
from hlr.request.check import checked, checked_views
from hlr.request.drawing_effects import DRAWING
from hlr.request.effect import Planner
from hlr.request.options import Options, Request, View
from hlr.scene.scene import Scene
from hlr.source.chosen import open_chosen
from hlr.source.model import Source
from hlr.visibility.plan import decide
from hlr.visibility.segments import solve


def draw_views(
    source: Any, views: Sequence[View], options: Options | None = None, progress: Progress | None = None
) -> list[Drawing]:
    """One drawing per view; the source is read and meshed once.

    source: whatever `hlr.source.open_source` takes. views: names or directions from the object toward the viewer.
    Raises SourceError, ViewError, OptionError; with options.strict StrictError for any warning.
    """
    options = checked(options or Options())
    views = checked_views(views, options)
    if not views:
        return []
    tell = progress or (lambda _stage, _done: None)
    clock: Clock = {}
    started = perf_counter()

    tell("source", 0.0)
    opened = open_chosen(source, options)
    bounds = opened.bounds()
    cameras = [resolve(view, options, opened.frame, bounds) for view in views]
    started = lap(clock, "source", started)

    tell("tessellate", 0.0)
    placed = [place(c, options, opened, bounds) for c in cameras]
    scene, curves, seen = staged(opened, cameras, placed, options, tell, clock, Planner(DRAWING, options))

    out = []
    looks = opened.looks() if opened.transparent() else {}
    remarks = [] if options.see_through else hiding(scene, looks)
    for i, (view, at) in enumerate(zip(views, seen, strict=True)):
        tell("visibility", i / len(cameras))
        through = seen_through(scene, looks, at, options)
        out.append(drawing_of(opened, scene, curves, through, options, dict(clock), Request(view, options), remarks))
    tell("linework", 1.0)
    for drawing in out:
        if options.strict:
            refuse_warnings(drawing.notes)
    return out


def drawing_of(
    opened: Source,
    scene: Scene,
    curves: EdgeCurveLookup,
    view: Staged,
    options: Options,
    clock: Clock,
    request: Request | None = None,
    remarks: Sequence[Note] = (),
) -> Drawing:
    """The lines of one view; request: what was asked for; remarks: what else is to be said."""
    camera, at, planner, threads = view.camera, view.at, view.planner, options.threads
    started = perf_counter()
    outlined = view.outlined or with_silhouettes(scene, camera, at.tolerances, threads, planner)
    seen = clipped(outlined, camera, at.aspect, planner)
    plan = decide(seen, camera, options, at.tolerances, planner)
    projected = camera.project(seen.points, plan.divide)
    started = lap(clock, "plan", started)
    lift = None if seen.silhouettes is None else seen.silhouettes.lift
    lifted = projected if lift is None else camera.project(seen.points + lift, plan.divide)
    segments = solve(seen, plan, lifted, threads)
    started = lap(clock, "visibility", started)
    lines = draw_lines(
        seen, curves, plan, segments, camera, projected, at.per_model, at.tolerances, options.hidden, threads
    )
    started = lap(clock, "linework", started)
    return finished(opened, scene, seen, view, options, plan, segments, lines, clock, request, remarks)


def refuse_warnings(notes: Sequence[Note]) -> None:
    """Raise StrictError for the first warning among the notes."""
    for note in notes:
        if note.is_warning:
            raise StrictError(note.text)


__all__ = ["draw_views", "drawing_of", "refuse_warnings"]
