"""The hatches of a section: lines of a drawing, in the model as on paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line
from hlr.drawing.section import Section
from hlr.linework.cut_faces import CutFace, cut_faces, level_faces
from hlr.linework.hatch_strokes import uncovered
from hlr.linework.hatching import Pattern, hatched, patterns_on_sheet, sides_of
from hlr.linework.joints import covered, is_covered, joint_borders
from hlr.pipeline.section.jogs import without_jogs
from hlr.pipeline.section.plane import Plane, Planes
from hlr.pipeline.section.sources import CutSource
from hlr.pipeline.session import Session
from hlr.request.accuracy import ANGLE
from hlr.source.mesh.clipping import split_at
from hlr.source.model import PartMesh, Source
from hlr.source.stepped import Stepped
from hlr.tables.sheets import SHEETS, USUAL
from hlr.window.frame import Frame
from hlr.window.lines import cut_lines


@dataclass(frozen=True, slots=True, eq=False)
class Hatched:
    """A face to be hatched.

    loops (k, 2): its border on paper; level: how far it lies toward the viewer, model units
    cover: what it is hatched under, None: all of it
    """

    face: CutFace
    loops: list[Floats]
    level: float
    cover: list[Floats] | None = None

    @property
    def is_joint(self) -> bool:
        """Whether it lay in the plane before, and another part rests on it."""
        return self.cover is not None


@dataclass(frozen=True, slots=True, eq=False)
class CutDrawing:
    """A drawing of what planes leave, which is to be hatched. session: that has drawn it; faces: to be hatched."""

    drawing: Drawing
    session: Session
    planes: Planes
    cut: CutSource
    faces: Sequence[Hatched]

    def loops(self) -> dict[str, list[Floats]]:
        """The borders of all faces on paper, by the parts of the whole model."""
        found: dict[str, list[Floats]] = {}
        for each in self.faces:
            found.setdefault(self.cut.whose[each.face.part], []).extend(each.loops)
        return found


def cut_drawing(drawing: Drawing, session: Session, planes: Planes, cut: CutSource, whole: Source) -> CutDrawing:
    """A drawing with what is to be hatched in it. whole: the source before it was cut."""
    faces = _hatched_faces(session, planes, cut, _Paper(drawing), whole)
    return CutDrawing(drawing, session, planes, cut, faces)


def patterns_of(sections: Sequence[CutDrawing]) -> dict[str, Pattern]:
    """The patterns of the parts of the whole model, by name, on a sheet with these sections."""
    shorter = min(_shorter_side(each.drawing) for each in sections)
    return patterns_on_sheet([each.loops() for each in sections], shorter)


def with_hatches(section: CutDrawing, patterns: Mapping[str, Pattern]) -> Drawing:
    """The drawing with its cut faces hatched. patterns: as of `patterns_of`."""
    drawing, planes, cut, faces = section.drawing, section.planes, section.cut, section.faces
    paper = _Paper(drawing)
    hatches, rims = _lines(section, patterns, paper, _before(section.session, planes, cut, paper))
    parts = _parts_of(drawing, faces, hatches)
    if planes.steps:
        drawing = without_jogs(drawing, planes, [(cut.whose[each.face.part], each.loops) for each in faces], cut.whose)
    if drawing.window is not None:
        frame = Frame(drawing.view, drawing.scale * drawing.unit, drawing.window)
        hatches, rims = list(cut_lines(hatches, frame)[0]), list(cut_lines(rims, frame)[0])
    shown = Section(planes.first.point, planes.normal, parts, planes.corners())
    return replace(_with_lines(drawing, rims, hatches), section=shown)


def _parts_of(drawing: Drawing, faces: Sequence[Hatched], hatches: Sequence[Line]) -> tuple[int, ...]:
    """The numbers of the parts that a section shows cut: those with cut faces, and those with a joint that is seen."""
    number = _part_numbers(drawing)
    cut = {number[each.face.part] for each in faces if not each.is_joint}
    return tuple(sorted(cut | {line.part for line in hatches}))


def _with_lines(drawing: Drawing, rims: list[Line], hatches: list[Line]) -> Drawing:
    """The drawing with these lines after its own, and with their counts."""
    counters = {
        **drawing.counters,
        "lines": drawing.counters.get("lines", 0) + len(rims) + len(hatches),
        "hatch_lines": len(hatches),
    }
    lines = (*drawing.lines, *rims, *hatches) if rims or hatches else drawing.lines
    return replace(drawing, lines=lines, counters=counters)


def _hatched_faces(session: Session, planes: Planes, cut: CutSource, paper: _Paper, whole: Source) -> list[Hatched]:
    """All faces to be hatched: first those that the planes have cut, then joints."""
    beside = list(_beside(session.parts, planes))
    cut_ones = [face for plane, own in beside for face in _cut_faces(own, plane, cut, paper)]
    joints = [face for plane, own in beside for face in _joints(session, own, plane, cut, paper, whole)]
    return [*cut_ones, *joints]


def _lines(
    section: CutDrawing, patterns: Mapping[str, Pattern], paper: _Paper, before: Floats | None
) -> tuple[list[Line], list[Line]]:
    """The strokes of all hatches, and the borders of hatches at which no edge is.

    before (k, 2, 2): borders, on paper, of what lies before the planes
    """
    shortest, number = section.drawing.accuracy.used, _part_numbers(section.drawing)
    over_joints = _over_joints(section.faces, before)
    hatches: list[Line] = []
    rims: list[Line] = []
    for each in section.faces:
        part, hiding = number[each.face.part], over_joints if each.is_joint else before
        for stroke in _strokes(each, patterns[section.cut.whose[each.face.part]], hiding, shortest):
            hatches.append(Line("hatch", True, part, None, each.face.number, stroke, paper.behind(stroke, each.level)))
        for border in _borders(each, paper, shortest):
            rims += _rim(border, part, paper, hiding, each.level)
    return hatches, rims


def _part_numbers(drawing: Drawing) -> dict[str, int]:
    """The number of each part of a drawing, by its name."""
    return {part.name: k for k, part in enumerate(drawing.parts)}


def _over_joints(faces: Sequence[Hatched], before: Floats | None) -> Floats | None:
    """(k, 2, 2) the borders, on paper, of what hides joints: where parts overlap, a face that is cut does, too."""
    over = [sides_of(each.loops) for each in faces if not each.is_joint]
    over = over if before is None else [*over, before]
    return np.concatenate(over) if over else None


def _strokes(face: Hatched, pattern: Pattern, hiding: Floats | None, shortest: float) -> Floats:
    """(k, 2, 2) the strokes of a face on paper, as far as they are seen.

    hiding (k, 2, 2): borders of what hides it; None: nothing does; shortest: millimetres, of a stroke
    """
    strokes = hatched(face.loops, pattern, shortest)
    if face.cover is not None:
        strokes = covered(strokes, sides_of(face.cover))
    if hiding is not None:
        strokes = uncovered(strokes, hiding)
    if face.is_joint:
        strokes = strokes[np.hypot(*(strokes[:, 1] - strokes[:, 0]).T) >= shortest]
    return strokes


def _borders(face: Hatched, paper: _Paper, shortest: float) -> list[Floats]:
    """Borders (n, 2) of a hatch, on paper, at which no edge is. shortest: millimetres, of a border of a joint."""
    if face.cover is not None:
        return joint_borders(face.loops, face.cover, shortest)
    return [paper.on(face.face.points[rim]) for rim in face.face.rims]


def _beside(parts: Sequence[PartMesh], planes: Planes) -> Iterator[tuple[Plane, list[PartMesh]]]:
    """Each plane, and what of the parts lies beside its steps: triangles that reach beyond one are split at it."""
    if not planes.steps:
        yield planes.first, list(parts)
        return
    stepped, along = planes.stepped(), np.array(planes.along)
    split = [_split(part, stepped, planes.near) for part in parts]
    for plane, low, high in zip(planes.planes, [-np.inf, *planes.steps], [*planes.steps, np.inf], strict=True):
        yield plane, [_between(part, along, low, high) for part in split]


def _split(part: PartMesh, planes: Stepped, near: float) -> PartMesh:
    found = split_at(part.points, part.triangles, planes, near, levels=False)
    return replace(part, points=found.points, triangles=found.triangles, triangle_face=part.triangle_face[found.of])


def _between(part: PartMesh, along: Floats, low: float, high: float) -> PartMesh:
    at = (part.points @ along)[part.triangles].mean(axis=1)
    chosen = (at > low) & (at < high)
    return replace(part, triangles=part.triangles[chosen], triangle_face=part.triangle_face[chosen])


def _cut_faces(parts: Sequence[PartMesh], plane: Plane, cut: CutSource, paper: _Paper) -> list[Hatched]:
    """The faces that a plane has cut."""
    point, normal = np.array(plane.point), np.array(plane.normal)
    bodies = [part for part in parts if part.name not in cut.open]
    faces = cut_faces(bodies, point, normal, plane.near, lambda name: plane.level.get(cut.whose[name]))
    return [
        Hatched(face, [paper.on(border) for border in face.borders], plane.height)
        for face in faces
        if cut.whose[face.part] in cut.cut
    ]


def _joints(
    session: Session, parts: Sequence[PartMesh], plane: Plane, cut: CutSource, paper: _Paper, whole: Source
) -> list[Hatched]:
    """The faces that lay in a plane before and on which other parts rest, under those."""
    ahead = plane.ahead - cut.uncut
    if not ahead or not any(plane.level.keys() - cut.uncut):
        return []
    point, normal = np.array(plane.point), np.array(plane.normal)
    deflection = min(at.tolerances.deflection for at in session.placements)
    resting = {
        part.name: [paper.on(border)[::-1] for face in faces for border in face.borders]
        for part in whole.mesh(deflection, ANGLE).parts
        if part.name in ahead
        for faces in [list(cut_faces([part], point, -normal, plane.near))]
    }
    found = []
    for face in level_faces(parts, point, normal, plane.near, lambda name: plane.level.get(cut.whose[name])):
        own = cut.whose[face.part]
        cover = [loop for name, loops in resting.items() if name != own for loop in loops]
        loops = [paper.on(border) for border in face.borders]
        if own not in cut.uncut and cover and is_covered(loops, sides_of(cover)):
            found.append(Hatched(face, loops, plane.height, cover))
    return found


def _before(session: Session, planes: Planes, cut: CutSource, paper: _Paper) -> Floats | None:
    """(k, 2, 2) the borders, on paper, of what lies before the planes; None: nothing does."""
    before = {name for name, own in cut.whose.items() if own in cut.through}
    if not before:
        return None
    from hlr.pipeline.section.cover import cover_of

    sides = cover_of(session.parts, before, planes.stepped(), planes.near)
    return paper.on(sides.reshape(-1, 3)).reshape(-1, 2, 2)


def _rim(flat: Floats, part: int, paper: _Paper, before: Floats | None, level: float) -> list[Line]:
    """A border (n, 2) of a hatch at which no edge is, as far as it is seen."""
    if before is None:
        return [Line("sharp", True, part, None, None, flat, paper.behind(flat, level))]
    pieces = uncovered(np.stack([flat[:-1], flat[1:]], axis=1), before)
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
