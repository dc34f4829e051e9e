"""The hatches of a section: lines of a drawing, in the model as on paper."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line
from hlr.drawing.section import Section
from hlr.linework.cut_faces import cut_faces
from hlr.linework.hatch_strokes import uncovered
from hlr.linework.hatching import hatched, patterns_of
from hlr.pipeline.section.plane import Plane
from hlr.pipeline.section.sources import CutSource
from hlr.pipeline.session import Session
from hlr.tables.sheets import SHEETS, USUAL
from hlr.window.frame import Frame
from hlr.window.lines import cut_lines


def with_hatches(drawing: Drawing, session: Session, plane: Plane, cut: CutSource) -> Drawing:
    """A drawing of what a plane leaves, with its cut faces hatched. session: that has drawn it."""
    faces = [
        face
        for face in cut_faces(
            session.parts,
            np.array(plane.point),
            np.array(plane.normal),
            plane.near,
            lambda name: plane.level.get(cut.whose[name]),
        )
        if cut.whose[face.part] in cut.cut
    ]
    paper = _Paper(drawing)
    flat = [[paper.on(border) for border in face.borders] for face in faces]
    whole: dict[str, list[Floats]] = {}
    for face, loops in zip(faces, flat, strict=True):
        whole.setdefault(cut.whose[face.part], []).extend(loops)
    patterns = patterns_of(whole, _shorter_side(drawing))
    number = {part.name: k for k, part in enumerate(drawing.parts)}
    level = float(np.array(plane.point) @ np.array(plane.normal))
    cover = _cover(session, plane, cut, paper)
    hatches: list[Line] = []
    rims: list[Line] = []
    for face, loops in zip(faces, flat, strict=True):
        part = number[face.part]
        strokes = hatched(loops, patterns[cut.whose[face.part]], drawing.accuracy.used)
        strokes = strokes if cover is None else uncovered(strokes, cover)
        hatches += [Line("hatch", True, part, None, face.number, each, paper.behind(each, level)) for each in strokes]
        for rim in face.rims:
            rims += _rim(face.points[rim], part, paper, cover, level)
    if drawing.window is not None:
        frame = Frame(drawing.view, drawing.scale * drawing.unit, drawing.window)
        hatches, rims = list(cut_lines(hatches, frame)[0]), list(cut_lines(rims, frame)[0])
    section = Section(plane.point, plane.normal, tuple(sorted({number[face.part] for face in faces})))
    counters = {
        **drawing.counters,
        "lines": drawing.counters.get("lines", 0) + len(rims) + len(hatches),
        "hatch_lines": len(hatches),
    }
    every = (*drawing.lines, *rims, *hatches) if rims or hatches else drawing.lines
    return replace(drawing, lines=every, section=section, counters=counters)


def _cover(session: Session, plane: Plane, cut: CutSource, paper: _Paper) -> Floats | None:
    """(k, 2, 2) the borders, on paper, of what lies before the plane; None: nothing does."""
    before = {name for name, own in cut.whose.items() if own in cut.through}
    if not before:
        return None
    from hlr.pipeline.section.cover import cover_of

    sides = cover_of(session.parts, before, plane)
    return paper.on(sides.reshape(-1, 3)).reshape(-1, 2, 2)


def _rim(points: Floats, part: int, paper: _Paper, cover: Floats | None, level: float) -> list[Line]:
    """The border (n, 3) of a cut face at a face that lay in the plane before, as far as it is seen."""
    flat = paper.on(points)
    if cover is None:
        return [Line("sharp", True, part, None, None, flat, points)]
    pieces = uncovered(np.stack([flat[:-1], flat[1:]], axis=1), cover)
    return [Line("sharp", True, part, None, None, piece, paper.behind(piece, level)) for piece in pieces]


def _shorter_side(drawing: Drawing) -> float:
    """Of the paper, millimetres: what has no page is printed on A4, or on something larger."""
    area = drawing.area
    side = min(area.width, area.height)
    return side if drawing.page is not None else max(side, SHEETS[USUAL.lower()].narrow)


class _Paper:
    """Between the model and the paper of a parallel view."""

    def __init__(self, drawing: Drawing) -> None:
        self._per_model = drawing.scale * drawing.unit
        self._axes = np.array([drawing.view.right, drawing.view.up])
        self._toward = np.array(drawing.view.direction)
        self._origin = np.array(drawing.origin)

    def on(self, points: Floats) -> Floats:
        """Points (n, 3) of the model as (n, 2) mm on paper."""
        return np.asarray(points @ self._axes.T * self._per_model - self._origin)

    def behind(self, flat: Floats, level: float) -> Floats:
        """Points (n, 2) on paper as (n, 3) of the model, at a height toward the viewer."""
        return np.asarray((flat + self._origin) / self._per_model @ self._axes + level * self._toward)
