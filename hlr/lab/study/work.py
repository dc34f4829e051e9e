"""The work of a measuring process: it does one job, measures its cost, and keeps its lines."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from hlr.drawing.chords import bezier_pieces
from hlr.drawing.drawing import Drawing, DrawnView
from hlr.drawing.line import Line
from hlr.drawing.saving import render
from hlr.errors import OptionError
from hlr.image.camera import Camera
from hlr.image.image import image_of
from hlr.image.outlines import outlined
from hlr.lab.polylines import Polylines, drawing_of, load, polylines_of
from hlr.lab.study.job import EXACT, HLR, POLY, ZBUFFER, Cost, Job, Point
from hlr.lab.study.watch import Watch
from hlr.pipeline.draw import draw_views
from hlr.pipeline.finish import drawn_view
from hlr.pipeline.session import Session
from hlr.request.accuracy import MEASURED_CHORD
from hlr.request.options import Options
from hlr.source.model import Source
from hlr.source.selection import open_selected


def done(job: Job) -> dict[str, Any]:
    """Do a job; the answer, ready for JSON, is a contestant's `Point`, or the record of the job's kind of work.

    Raises HlrError if the job cannot be done.
    """
    if job.work == "look":
        return _look(job)
    if job.work == "truth":
        return _truth(job)
    if job.work == "judge":
        return _judge(job)
    if job.work == "arithmetic":
        return _arithmetic(job)
    if job.work == "reached":
        return _reached(job)
    return _repeated(job, {HLR: _hlr, POLY: _occt, EXACT: _occt, ZBUFFER: _zbuffer}[job.work]).as_dict()


def _repeated(job: Job, draw: Callable[[Job], Point]) -> Point:
    """Medians over the job's runs; fewer runs if they would not finish within the limit.

    The first run also loads libraries; the median includes it like the others.
    """
    points = [draw(job)]
    while len(points) < job.runs and time.process_time() * (1.0 + 1.0 / len(points)) < REPEAT * job.limit:
        points.append(draw(replace(job, folder="")))
    out = points[0]
    out.runs = len(points)
    out.stages = {
        name: Cost(
            median(p.stages[name].wall for p in points),
            median(p.stages[name].cpu for p in points),
            max(p.stages[name].memory for p in points),
        )
        for name in out.stages
    }
    return out


REPEAT = 0.5
"""Share of the limit: no further run begins if all runs together would take longer."""


def _options(job: Job, smooth: bool = False, **others: Any) -> Options:
    return Options(
        hidden=True,
        smooth=smooth,
        scale=job.scale if job.scale or job.fit else 1.0,
        fit=None if job.scale else job.fit,
        only=tuple(job.only),
        hide=tuple(job.hide),
        var=job.var,
        parameters=job.parameters,
        annotations=job.annotations,
        hidden_objects=job.hidden_objects,
        details=True,
        **others,
    )


def _session(job: Job, options: Options, watch: Watch | None = None) -> Session:
    return Session(job.source, [job.view], options, watch)


def _look(job: Job) -> dict[str, Any]:
    """The scale at which all contestants draw, and the size of the drawing."""
    drawing = draw_views(job.source, [job.view], _options(job))[0]
    x0, y0, x1, y1 = drawing.bounds
    return {
        "name": drawing.source,
        "scale": drawing.scale,
        "width": x1 - x0,
        "height": y1 - y0,
        "parts": len(drawing.parts),
        "lines": len(drawing.lines),
        "triangles": int(drawing.counters.get("triangles", 0)),
        "accuracy": drawing.accuracy.used,
        "notes": [str(note) for note in drawing.notes],
    }


def _drawn(job: Job, watch: Watch, **others: Any) -> Drawing:
    return draw_views(job.source, [job.view], _options(job, accuracy=job.setting, **others), progress=watch)[0]


def _hlr(job: Job) -> Point:
    watch = Watch()
    drawing = _drawn(job, watch)
    watch("write")
    size = len(render(drawing, "svg"))
    watch.stop()
    _keep(job, polylines_of(drawing, MEASURED_CHORD * job.setting))
    stages = dict(watch.stages)
    # Progress messages do not separate planning, visibility and linework; the drawing's own timings do.
    whole = stages.pop("visibility")
    clock = sum(drawing.timings[s] for s in ("plan", "visibility", "linework")) or 1.0
    for name in ("plan", "visibility", "linework"):
        wall = drawing.timings[name]
        stages[name] = replace(whole, wall=wall, cpu=whole.cpu * wall / clock)
    counts = {name: int(drawing.counters.get(name, 0)) for name in ("triangles", "failed_checks", "contradictions")}
    pieces = sum(_pieces(line) for line in drawing.lines)
    return Point(
        HLR,
        job.setting,
        accuracy=job.setting,
        stages=stages,
        counts={"lines": len(drawing.lines), "segments": pieces, "bytes": size, **counts},
    )


def _pieces(line: Line) -> int:
    """The number of straight pieces, arcs and Bezier curves of a line."""
    return len(line.points) - 1 if line.curve is None else bezier_pieces(line.curve)


def _truth(job: Job) -> dict[str, Any]:
    """The true lines for the judge: those of the finest drawing, and lines that a program may draw or leave out."""
    drawing = _drawn(job, Watch(), smooth=True, seam=True)
    _keep(job, polylines_of(drawing, MEASURED_CHORD * job.setting))
    return {"accuracy": job.setting, "lines": len(drawing.lines)}


def _occt(job: Job) -> Point:
    from hlr.lab.study import occt

    watch = Watch()
    watch("source")
    accuracy = job.setting if job.work == POLY else None
    session = _session(job, _options(job, accuracy=accuracy))
    opened, camera, at = session.source, session.cameras[0], session.placements[0]
    if not hasattr(opened, "shape"):
        raise OptionError("OpenCASCADE hides lines of B-reps only, and this is a mesh")
    shape = opened.shape()
    watch.stop()
    if job.work == EXACT:
        lines = occt.exact(shape, camera, at.per_model, watch)
    else:
        lines = occt.poly(shape, camera, at.per_model, at.tolerances.deflection, at.tolerances.angle, watch)
    return _rival(job, lines, opened, camera, accuracy, watch)


def _zbuffer(job: Job) -> Point:
    from hlr.lab.study.zbuffer import hidden_lines

    watch = Watch()
    first = _session(job, _options(job), watch)
    camera, per_model = first.cameras[0], first.placements[0].per_model
    low, high = _flat_box(first.source, camera)
    pixel = float((high - low).max()) * per_model / job.setting
    session = Session(first.source, [job.view], _options(job, accuracy=pixel), watch)
    draft = session.drafts()[0]
    watch("plan")
    image = image_of(session.scene, camera, draft.image.placement)
    plan = session.plan(draft, image)
    lines = hidden_lines(image, plan.visibility_input.role, int(job.setting), watch)
    watch.stop()
    return _rival(job, lines, session.source, camera, pixel, watch)


def _flat_box(opened: Source, camera: Camera) -> tuple[Any, Any]:
    b = opened.bounds()
    corners = np.array([[b[i][0], b[j][1], b[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    flat = camera.project(corners)[:, :2]
    return flat.min(axis=0), flat.max(axis=0)


def _rival(job: Job, lines: Polylines, opened: Source, camera: Camera, accuracy: float | None, watch: Watch) -> Point:
    """The figures of a contestant whose result is polylines."""
    view: DrawnView = drawn_view(camera)
    watch("write")
    bare = drawing_of(lines, opened.name, view, job.scale or 1.0, accuracy or WRITTEN)
    size = len(render(bare, "svg"))
    watch.stop()
    _keep(job, lines)
    counts = {"lines": len(lines.visible)}
    if accuracy is not None:  # without one they are curves, of which only chords are known here
        counts |= {"segments": len(lines.points) - len(lines.visible), "bytes": size}
    return Point(job.work, job.setting, accuracy=accuracy, stages=dict(watch.stages), counts=counts)


WRITTEN = 0.001
"""Accuracy in millimetres for writing lines of programs that have no accuracy setting."""


def _arithmetic(job: Job) -> dict[str, Any]:
    from hlr.lab.study.arithmetic import compared

    options = _options(job, accuracy=job.setting)
    session = _session(job, options)
    draft = session.drafts()[0]
    image = outlined(draft.image, draft.planner)
    plan = session.plan(draft, image)
    found = compared(image, plan, image.lifted(), image.placement.per_model, job.setting)
    return {"kinds": [asdict(one) for one in found]}


def _judge(job: Job) -> dict[str, Any]:
    from hlr.lab.study.judge import LineJudge

    folder = Path(job.folder)
    judge = LineJudge(load(folder / "truth.npz"))
    return {"errors": judge.judge(load(folder / f"{job.name}.npz"))}


def _reached(job: Job) -> dict[str, Any]:
    """Measure our own drawing against OpenCASCADE's curves and surfaces and by rays (`hlr.lab.measure`)."""
    from hlr.lab.measure.classes import ModelJudge

    opened = open_selected(job.source, job)
    drawing = draw_views(opened, [job.view], _options(job, accuracy=job.setting))[0]
    return {"reached": ModelJudge(opened).judge(drawing).as_dict()}


def _keep(job: Job, lines: Polylines) -> None:
    if job.folder:
        lines.save(Path(job.folder) / f"{job.name}.npz")
