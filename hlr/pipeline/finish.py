"""The finished drawing: its lines, accuracy, notes, counters and times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter

from hlr.common.clock import Clock, lap
from hlr.common.numbers import typed
from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.fill import Fill
from hlr.drawing.line import Bounds, Line
from hlr.drawing.lines import bounds_of, held
from hlr.drawing.notes import Note
from hlr.drawing.page import Page, centred
from hlr.drawing.scale import ratio
from hlr.image.camera import Camera
from hlr.image.image import Image
from hlr.image.paper import misfit
from hlr.image.placement import Placement
from hlr.linework.legible import legible
from hlr.linework.lines import Linework
from hlr.pipeline.style_notes import unused_rules
from hlr.request.effect import Decisions, Planner
from hlr.request.options import Options, Request
from hlr.request.style_file import style_of
from hlr.scene.scene import Scene
from hlr.source.model import Source
from hlr.source.selection import also_called
from hlr.tables.line_classes import by_number, counted
from hlr.visibility.plan import Plan
from hlr.visibility.segments import Segments
from hlr.window.cut import cut_at_window
from hlr.window.frame import Frame


@dataclass(frozen=True, slots=True)
class Solved:
    """The results of one view: its image, what was decided, the segments, and the lines made of them."""

    image: Image
    plan: Plan
    segments: Segments
    linework: Linework


def finished(
    source: Source,
    scene: Scene,
    solved: Solved,
    planner: Planner,
    options: Options,
    clock: Clock,
    request: Request | None = None,
    remarks: Sequence[Note] = (),
) -> Drawing:
    """The drawing of one view of a scene.

    request: what was asked for; remarks: further notes.
    """
    image, plan, segments = solved.image, solved.plan, solved.segments
    camera, placement = image.camera, image.placement
    lines, origin = solved.linework.lines, solved.linework.origin
    started = perf_counter()
    window = None if options.window is None else Bounds(*map(float, options.window))
    sheet = _sheet(placement, window, lines)
    accuracy = placement.tolerances.accuracy
    style = style_of(options.style)
    shown = legible(lines, placement.scale, accuracy, style, sheet, planner)
    lines = shown.lines
    fill = _fill(source, scene, solved, planner) if plan.fill else None
    stated = drawn_view(camera)
    frame = None if window is None else Frame(stated, placement.per_model, window)
    lines, fill, empty = cut_at_window(lines, fill, frame, planner)
    empty = empty or _empty(lines, fill, image)
    page, misfit = (None, ()) if window is not None else page_of(placement, lines)
    counters = {**_counters(solved, lines, fill), "left_out": shown.left_out}
    _tell_times(planner, plan, segments)
    # With some parts chosen, a rule may be for the others.
    names = also_called(source)
    parts = tuple([DrawnPart(p.name, p.color, p.transform, names.get(p.name, ())) for p in image.parts.labels])
    unused = () if options.only or options.hide else unused_rules(style, parts)
    notes = (*source.notes, *scene.notes, *placement.notes, *misfit, *shown.notes, *empty, *unused, *remarks)
    cuts = sum([sum(planner.cost(name).values()) for name in ("near clipping", "side clipping")])
    rescued = planner.cost("rescue of faces")
    drawing = Drawing(
        source=source.name,
        view=stated,
        scale=placement.scale,
        origin=origin,
        accuracy=Accuracy(
            asked=options.accuracy,
            used=accuracy,
            deflection=placement.tolerances.deflection,
            contact=placement.tolerances.contact,
        ),
        unit=source.frame.unit,
        up_axis=source.frame.up,
        parts=parts,
        lines=lines,
        notes=tuple(dict.fromkeys(notes)),
        counters={**counters, **rescued, "clipping_planes": cuts},
        timings=clock,
        fill=fill,
        request=request,
        plan=Decisions(planner, counters),
        window=window,
        page=page,
        style=style,
        group=shown.group,
        reading=getattr(source, "reading", ""),
    )
    lap(clock, "linework", started)
    clock["total"] = sum(clock.values())
    return drawing


STEPS = {
    "back-face culling": ("tables",),
    "crossing search": ("seeds", "crossings", "counting"),
    "depth pyramid": ("pyramid",),
    "piercing search": ("piercings",),
}
"""The steps of the kernel whose times add up to that of an effect."""


def _tell_times(planner: Planner, plan: Plan, segments: Segments) -> None:
    """Tell the table of effects what the kernel's steps took, and which of them it ran after all."""
    if not plan.crossings and segments.found.counters["seeds"]:
        for name in ("crossing search", "piercing search"):
            planner.revised(name, True, "one convex body, but rounded its faces overlap in the image")
    seconds = segments.found.seconds
    for name, steps in STEPS.items():
        planner.spent(name, sum([seconds[s] for s in steps]))


def _fill(source: Source, scene: Scene, solved: Solved, planner: Planner) -> Fill:
    """The visible faces in their colours."""
    from hlr.shading.fill import filled

    begun = perf_counter()
    image, placement, origin = solved.image, solved.image.placement, solved.linework.origin
    accuracy = placement.tolerances.accuracy
    fill = filled(scene, source.appearances(), image.camera, image.points, placement.per_model, origin, accuracy)
    planner.spent("fill", perf_counter() - begun)
    planner.revised("fill", True, f"asked for; what is seen is looked up every {fill.spacing:.2g} mm")
    return fill


def _counters(solved: Solved, lines: Sequence[Line], fill: Fill | None) -> dict[str, int]:
    image, plan, segments = solved.image, solved.plan, solved.segments
    kept = held(lines)
    visible, kinds = kept.counts(len(by_number()))
    faces = 0 if fill is None else len(fill.faces) - 1
    return {
        **segments.found.counters,
        "lines": len(lines),
        "outlines": 0 if image.silhouettes is None else len(image.silhouettes.curves.kind),
        "divided_points": len(image.points) if plan.divide else 0,
        "hidden_lines": len(lines) - visible,
        **{str(row.counter): kinds[row.number] for row in counted()},
        "circles": kept.circles() if plan.step > 0.0 else 0,
        "curves_sought": solved.linework.curves_sought,
        "filled_faces": faces,
        "coloured_faces": faces,
        "gradients": 0 if fill is None else len(fill.gradients),
    }


def _sheet(placement: Placement, window: Bounds | None, lines: Sequence[Line]) -> tuple[float, float]:
    """Width and height of what is drawn on, millimetres."""
    on = window or placement.paper or bounds_of(lines)
    return on.width, on.height


def page_of(placement: Placement, lines: Sequence[Line]) -> tuple[Page | None, tuple[Note, ...]]:
    """The page with the lines in its middle, and a warning where they do not fit inside its margins."""
    paper = placement.paper
    if paper is None:
        return None, ()
    drawn = bounds_of(lines)
    page = centred(paper.name, paper.width, paper.height, drawn)
    warning = misfit((drawn.width, drawn.height), placement.scale, paper)
    return page, () if warning is None else (warning,)


def _empty(lines: Sequence[Line], fill: Fill | None, image: Image) -> tuple[Note, ...]:
    """What is said of a drawing without a line. Only in perspective can a view miss the model."""
    if lines or (fill is not None and len(fill.part) > 0):
        return ()
    if image.camera.eye is not None:
        text = "no line of the model lies in this view: the eye looks past it, or at a face that fills the view."
    else:
        placement = image.placement
        text = (
            "no line is drawn: on paper all that the model has is a point, or smaller than the accuracy, "
            f"{typed(placement.tolerances.accuracy)} mm, at {ratio(placement.scale)}. Try another view, "
            "a larger scale, or fewer parts (--only)."
        )
    return (Note("nothing-in-view", text),)


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


__all__ = ["drawn_view", "finished"]
