"""The stages in order: source -> tessellate -> scene -> plan -> visibility -> linework -> drawing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from time import perf_counter
from typing import Any

import numpy as np

from hlr.drawing import Drawing, DrawnPart, DrawnView
from hlr.errors import StrictError
from hlr.linework.exact import EdgeCurveLookup
from hlr.linework.lines import draw_lines
from hlr.plan.options import Options, Request, View
from hlr.plan.plan import decide
from hlr.plan.request import checked, checked_views
from hlr.scene.build import build
from hlr.scene.scene import Scene
from hlr.source import open_source
from hlr.source.model import Progress, Source
from hlr.tolerance import Tolerances
from hlr.view.camera import Camera, resolve
from hlr.view.clip import clip, planes
from hlr.view.scale import Placed, place
from hlr.view.silhouettes import with_silhouettes
from hlr.visibility.ends import at_outlines
from hlr.visibility.segments import solve

Clock = dict[str, float]


def draw_views(
    source: Any, views: Sequence[View], options: Options | None = None, progress: Progress | None = None
) -> list[Drawing]:
    """One drawing per view; the source is read and meshed once.

    source: whatever `hlr.source.open_source` takes. views: names or directions from the object toward the viewer.
    Raises SourceError, ViewError, OptionError; with options.strict StrictError for any warning.
    """
    options = checked(options or Options())
    views = checked_views(views)
    if not views:
        return []
    tell = progress or (lambda _stage, _done: None)
    clock: Clock = {}
    started = perf_counter()

    tell("source", 0.0)
    opened = open_source(source)
    bounds = opened.bounds()
    cameras = [resolve(view, options, opened.frame, bounds) for view in views]
    started = lap(clock, "source", started)

    tell("tessellate", 0.0)
    placed = [place(c, options, opened, bounds) for c in cameras]
    scene, curves, placed = meshed_scene(opened, cameras, placed, options, tell, clock)
    started = perf_counter()

    out = []
    for i, (view, camera, at) in enumerate(zip(views, cameras, placed, strict=True)):
        tell("visibility", i / len(cameras))
        drawing = drawing_of(opened, scene, curves, camera, at, options, dict(clock))
        out.append(replace(drawing, request=Request(view, options)))
    tell("linework", 1.0)
    for drawing in out:
        if options.strict and drawing.notes:
            raise StrictError(drawing.notes[0])
    return out


def lap(clock: Clock, stage: str, started: float) -> float:
    """Add the time since `started` to a stage's; returns now."""
    now = perf_counter()
    clock[stage] = clock.get(stage, 0.0) + now - started
    return now


def meshed_scene(
    opened: Source,
    cameras: list[Camera],
    placed: list[Placed],
    options: Options,
    tell: Progress,
    clock: Clock,
) -> tuple[Scene, EdgeCurveLookup, list[Placed]]:
    """The scene, meshed finely enough for every view; with --fit the true scale is known only afterwards."""
    for _ in range(2):
        started = perf_counter()
        finest = min(at.tolerances.deflection for at in placed)
        meshed = opened.mesh(finest, placed[0].tolerances.angle, tell)
        started = lap(clock, "tessellate", started)
        tell("scene", 0.0)
        scene = build(meshed, options.crease, finest)
        lap(clock, "scene", started)
        final = [_fitted(scene, c, at, options) for c, at in zip(cameras, placed, strict=True)]
        if min(at.tolerances.deflection for at in final) > 0.8 * finest:
            break
        placed = final
    return scene, meshed.edge_curves, final


def _fitted(scene: Scene, camera: Camera, at: Placed, options: Options) -> Placed:
    """Outlines of curved faces reach beyond their mesh, by less than the accuracy: they are what has to fit."""
    if options.fit is None:
        return at
    on = scene.true_surfaces
    curved = on is not None and bool(on.curved.any() or (np.diff(scene.chains.offsets) > 1).any())
    return at.fitted(camera, options, with_silhouettes(scene, camera, at.tolerances, options.threads).points, curved)


def drawing_of(
    opened: Source,
    scene: Scene,
    curves: EdgeCurveLookup,
    camera: Camera,
    at: Placed,
    options: Options,
    clock: Clock,
) -> Drawing:
    """The lines of one view."""
    started = perf_counter()
    tolerances: Tolerances = at.tolerances
    seen, cuts = clip(with_silhouettes(scene, camera, tolerances, options.threads), planes(camera, at.aspect))
    plan = decide(seen, camera, options, tolerances)
    projected = camera.project(seen.points)
    started = lap(clock, "plan", started)
    lifted = projected if seen.silhouettes is None else camera.project(seen.points + seen.silhouettes.lift)
    segments = at_outlines(seen, camera, solve(seen, plan, lifted, options.threads))
    started = lap(clock, "visibility", started)
    lines, origin = draw_lines(
        seen, curves, plan, segments, camera, projected, at.per_model, tolerances, options.hidden, options.threads
    )
    fill = None
    if options.fill:
        from hlr.surfaces.fill import filled

        fill = filled(seen, camera, at.per_model, origin)
    lap(clock, "linework", started)
    clock["write"] = 0.0
    clock["total"] = sum(clock.values())
    return Drawing(
        source=opened.name,
        view=drawn_view(camera),
        scale=at.scale,
        origin=origin,
        accuracy={
            "asked": options.accuracy,
            "used": tolerances.accuracy,
            "deflection": tolerances.deflection,
            "contact": tolerances.contact,
        },
        unit=opened.frame.unit,
        up_axis=opened.frame.up,
        parts=tuple(DrawnPart(p.name, p.color, p.transform) for p in scene.parts),
        lines=lines,
        notes=tuple(dict.fromkeys((*opened.notes, *scene.notes, *at.notes, *_empty(lines)))),
        counters={**segments.counters, "lines": len(lines), "clipping_planes": cuts},
        timings=clock,
        fill=fill,
    )


def _empty(lines: Sequence[object]) -> tuple[str, ...]:
    return () if lines else ("nothing of the model lies in this view",)


def drawn_view(camera: Camera) -> DrawnView:
    """The camera as a result states it."""
    return DrawnView(
        name=camera.name,
        projection="orthographic" if camera.eye is None else "perspective",
        direction=camera.direction,
        right=camera.right,
        up=camera.up,
        eye=camera.eye,
        target=camera.target,
        fov=camera.fov,
        distance=camera.distance,
    )


__all__ = ["draw_views", "drawing_of", "drawn_view", "lap", "meshed_scene"]
