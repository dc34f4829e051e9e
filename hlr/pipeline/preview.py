"""Shaded pictures: a session up to its scene, then the shaded faces, and the drawing's own lines on top."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from time import perf_counter
from typing import Any, Unpack

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.clock import lap
from hlr.common.colors import parse_color
from hlr.common.keywords import expect_record, shown
from hlr.common.threads import at_most
from hlr.common.types import Floats, Progress
from hlr.drawing.drawing import Drawing, DrawnPart
from hlr.drawing.notes import Note, of_each_view
from hlr.drawing.pens import usual_pens
from hlr.drawing.picture import Picture
from hlr.errors import SourceError
from hlr.image.camera import Camera
from hlr.image.image import image_of
from hlr.image.outlines import outlined
from hlr.image.placement import Placement, place
from hlr.image.transparency import without_glass
from hlr.pipeline.finish import drawn_view
from hlr.pipeline.session import Draft, Session, by_view, refuse_warnings
from hlr.request.check import checked_views
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import Facts, Planner
from hlr.request.options import Options, View
from hlr.request.picture_effects import (
    PIXELS_PER_MM,
    PREVIEW,
    PreviewOptions,
    PreviewWishes,
    checked_preview,
    decide_effects,
    line_options,
)
from hlr.request.styles import STYLES
from hlr.scene.scene import Scene
from hlr.shading.dark import LIGHT, dark_places
from hlr.shading.lens import depth_step, frame_scale, lens
from hlr.shading.lines import cues, ink_on, pieces, pieces_by_depth
from hlr.shading.picture import Pixels, before_the_eye, empty_picture, first_faces, maps, shaded_picture
from hlr.shading.scene import shaded_scene
from hlr.source.model import Source
from hlr.source.selection import also_called

MARGIN = 0.04
"""Empty margin around the model, as a share of the picture's smaller side."""

INK = (0, 0, 0, 255)

BEHIND = (0, 0, 0, 100)
"""Ink of lines behind glass."""


@shown(PreviewOptions)
def preview_views(
    source: Any,
    views: Sequence[View],
    options: PreviewOptions | None = None,
    progress: Progress | None = None,
    **wishes: Unpack[PreviewWishes],
) -> list[Picture]:
    """One picture per view; the source is read and meshed once.

    Raises SourceError, ViewError, OptionError; with options.strict StrictError for any warning.

    >>> import hlr
    >>> hlr.preview_views("part.step", ["front", "top"], hlr.PreviewOptions(size=(320, 240)))
    [<Picture part.step, front, 320x240 pixels>, <Picture part.step, top, 320x240 pixels>]
    """
    options = checked_preview(expect_record(PreviewOptions, options, "preview_views", wishes))
    views = checked_views(views, options)
    background = parse_color(options.background)
    if not views:
        return []
    placing = partial(_placed, options)
    with at_most(options.threads):
        session = Session(source, views, line_options(options, _sheet(options)), progress, placing)
        pictures = []
        for i, draft in enumerate(session.drafts()):
            session.progress("visibility", i / len(views))
            pictures.append(_picture(session, draft, options, background))
    if options.strict:
        refuse_warnings(of_each_view([each.view.name for each in pictures], [each.notes for each in pictures]))
    return pictures


def _picture(session: Session, draft: Draft, options: PreviewOptions, background: tuple[int, ...]) -> Picture:
    """The picture of one view: faces, maps, lines."""
    source, scene, unit = session.source, session.scene, session.source.frame.unit
    camera, placement = draft.image.camera, draft.image.placement
    clock = dict(session.clock)
    started = perf_counter()
    shaded = shaded_scene(scene, source.appearances(), before_the_eye(scene, camera))
    if not len(shaded.points):
        raise SourceError(
            f"{source.name} holds edges but no faces: a preview needs faces (hlr draw draws edges alone)."
        )
    planner = Planner(PREVIEW, options)
    eye = lens(camera, shaded.points, placement.per_model * PIXELS_PER_MM, options.size)
    facts = _facts(scene, camera, eye, unit)
    effects = decide_effects(options, shaded.opacity, facts, planner)
    started = lap(clock, "prepare", started)
    pixels = empty_picture(options.size, background)
    if effects.faces:
        pixels = shaded_picture(shaded, camera, eye, effects, background)
    depth, ids = maps(scene, shaded, eye, options, unit)
    started = lap(clock, "picture", started)
    if effects.lines:
        dark = dark_places(pixels) if effects.faces else None
        lines = line_options(options, None, placement.scale)
        image = image_of(scene, camera, placement)
        if effects.behind:
            planner_behind = Planner(drawing_effects(), lines)
            behind = without_glass(outlined(image, planner_behind), shaded.glass)
            drawing = session.drawing(Draft(behind, by_view(lines, camera, planner_behind), planner_behind))
            _ink(pixels, drawing, eye, [BEHIND], dark)
        planner_lines = Planner(drawing_effects(), lines)
        drawing = session.drawing(Draft(image, by_view(lines, camera, planner_lines), planner_lines))
        over_faces = [INK] if effects.faces else [ink_on(background)]
        _ink(pixels, drawing, eye, cues(background) if effects.cued else over_faces, dark)
        lap(clock, "edges", started)
    clock["total"] = sum(clock.values())
    strays = (note for note in placement.notes if note.code == "stray-parts")
    notes = tuple(dict.fromkeys((*source.notes, *scene.notes, *strays)))
    if facts.depth > facts.pixel and effects.faces:
        notes = (*notes, _coarse(facts))
    names = also_called(source)
    return Picture(
        source=source.name,
        view=drawn_view(camera),
        scale=eye.scale / unit,
        pixels=pixels,
        parts=tuple(DrawnPart(p.name, p.color, p.transform, names.get(p.name, ())) for p in scene.parts.labels),
        first_face=first_faces(scene),
        depth=depth,
        ids=ids,
        notes=notes,
        timings=clock,
        plan=planner.decisions(),
    )


def _ink(
    pixels: Pixels,
    drawing: Drawing,
    eye: _kernel.Lens,
    inks: Sequence[tuple[int, int, int, int]],
    dark: npt.NDArray[np.bool_] | None,
) -> None:
    """Draw the lines over a picture, in place: in one ink, or in one ink per depth level, the farthest level first.

    dark (h, w): where the one ink is light instead; None: nowhere.
    """
    pens = usual_pens(STYLES["iso"])
    widths = [pens.pen(line.kind, True).width for line in drawing.lines]
    lighter = pixels.copy() if dark is not None else None
    for wide in sorted(set(widths)):
        lines = [line for line, own in zip(drawing.lines, widths, strict=True) if own == wide]
        levels = [pieces(lines, drawing.origin, PIXELS_PER_MM, eye.centre)]
        if len(inks) > 1:
            levels = pieces_by_depth(lines, drawing.origin, PIXELS_PER_MM, eye, len(inks))
        for ink, strokes in zip(inks, levels, strict=True):
            _kernel.stroke_picture(pixels, strokes, wide * PIXELS_PER_MM, ink)
            if lighter is not None:
                _kernel.stroke_picture(lighter, strokes, wide * PIXELS_PER_MM, (*LIGHT, ink[3]))
    if dark is not None and lighter is not None:
        pixels[dark] = lighter[dark]


def _coarse(facts: Facts) -> Note:
    text = (
        f"Depths within {facts.depth:.2g} mm of one another are not told apart in the picture, for the model is very "
        "deep: leave out what lies far behind."
    )
    return Note("depth-coarse", text)


def _facts(scene: Scene, camera: Camera, eye: _kernel.Lens, unit: float) -> Facts:
    surfaces = scene.true_surfaces
    return Facts(
        curved=0 if surfaces is None else len(surfaces.planar) - surfaces.planar_faces,
        faces=surfaces is not None,
        perspective=camera.eye is not None,
        depth=depth_step(eye) * unit,
        pixel=unit / eye.scale,
    )


def _sheet(options: PreviewOptions) -> tuple[float, float]:
    """The millimetres of paper within which the model is to fit."""
    pixels_wide, pixels_high = options.size
    margin = 2.0 * MARGIN * min(options.size)
    return (max(pixels_wide - margin, 0.5) / PIXELS_PER_MM, max(pixels_high - margin, 0.5) / PIXELS_PER_MM)


def _placed(options: PreviewOptions, camera: Camera, lines: Options, source: Source, bounds: Floats) -> Placement:
    """How large the model is in the picture: as large as fits, or as the given eye sees it."""
    framed = frame_scale(camera, options.size[1])
    if framed is None:
        return place(camera, lines, source, bounds)
    scale = framed / PIXELS_PER_MM / source.frame.unit
    placement = place(camera, line_options(options, None, scale), source, bounds)
    return replace(placement, aspect=options.size[0] / options.size[1], notes=())
