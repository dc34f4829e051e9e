"""How large a view is on paper, and what its tolerances are then."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hlr.common.numbers import typed
from hlr.common.types import Floats
from hlr.drawing.notes import Note
from hlr.drawing.scale import ratio
from hlr.errors import SourceError
from hlr.image.camera import ASPECT, NEAR, Camera
from hlr.image.paper import at_scale, on_paper, settled
from hlr.image.strays import stray_note
from hlr.request.accuracy import CURVE_BULGE, MOST_MAGNIFIED, Tolerances, choose, derive
from hlr.request.options import Options
from hlr.source.model import Source
from hlr.tables.readers import is_brep
from hlr.tables.sheets import Paper, papers

SMALLEST_PAPER, LARGEST_PAPER = 5.0, 3000.0
"""Millimetres: beyond these a drawing is probably not what was meant, and a note says so."""

CORNERS = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)])
"""(8, 3) which end of a box each of its corners has along each axis."""
AXES = np.arange(3)


@dataclass(frozen=True, slots=True)
class Placement:
    """A view's scale (paper : millimetres of the model), per_model (paper millimetres per model unit), tolerances.

    aspect: width to height of the frame; magnified: how much larger than at the target the nearest point is drawn.
    paper: the sheet, the way it lies; None: the page is as large as the drawing.
    settled: the request alone tells the scale, and no sheet has to be laid one way or the other.
    size: width and height on the image plane, model units.
    """

    scale: float
    per_model: float
    tolerances: Tolerances
    unit: float
    brep: bool
    aspect: float
    magnified: float
    notes: tuple[Note, ...] = ()
    paper: Paper | None = None
    settled: bool = False
    size: tuple[float, float] = (0.0, 0.0)

    @property
    def diagonal(self) -> float:
        """Of the drawing, millimetres on paper."""
        return math.hypot(*self.size) * self.per_model

    def fitted(self, camera: Camera, options: Options, points: Floats, curved: bool) -> Placement:
        """The placement with the size taken from the mesh: points (n, 3) in model coordinates.

        Curves bulge over their chords and are fitted within a share of the accuracy: `curved` leaves room for both.
        """
        if self.settled:
            return self
        return self._of_size(*_extent(camera, points, self.aspect), camera, options, curved)

    def foreseen(self, camera: Camera, options: Options, source: Source) -> Placement:
        """The placement with the size that the source tells before it is meshed: closer than that of its box.

        So nothing is meshed for a scale that is then found to be too small. Sources need not tell it (`Source`); in
        perspective the box is taken.
        """
        tell = getattr(source, "reach", None)
        if self.settled or camera.eye is not None or tell is None:
            return self
        width, height = (upper - lower for lower, upper in tell(camera.right, camera.up).tolist())
        if max(width, height) <= 0.0:
            return self
        return self._of_size(width, height, camera, options, curved=True)

    def at_scale(self, scale: float, options: Options) -> Placement:
        """The placement at another scale (paper : model), on the sheet that the options ask for."""
        if scale == self.scale:
            return self
        sized = _sized(*self.size, at_scale(options, scale), self.unit, self.brep, self.aspect, self.magnified)
        return replace(sized, notes=self.notes, settled=self.settled)

    def _of_size(self, width: float, height: float, camera: Camera, options: Options, curved: bool) -> Placement:
        """The placement of a drawing of this width and height, in model units."""
        if curved and options.fit is not None and not camera.framed:
            bulge = max(
                self.tolerances.deflection * self.magnified, CURVE_BULGE * self.tolerances.accuracy / self.per_model
            )
            width, height = width + 2.0 * bulge, height + 2.0 * bulge
        sized = _sized(width, height, options, self.unit, self.brep, self.aspect, self.magnified)
        return replace(sized, notes=self.notes)


def of_one_scale(placements: Sequence[Placement], options: Options) -> list[Placement]:
    """The placements of all views, at one scale where the options ask for that: the smallest."""
    if not options.same_scale or not placements:
        return list(placements)
    least = min([placement.scale for placement in placements])
    return [placement.at_scale(least, options) for placement in placements]


def place(camera: Camera, options: Options, source: Source, bounds: Floats) -> Placement:
    """Scale and tolerances from the bounding box (2, 3).

    Raises OptionError for an accuracy that cannot be kept, SourceError for a model without size.
    """
    check_size(source, bounds)
    corners = bounds[CORNERS, AXES]
    aspect = _aspect(options)
    width, height = _extent(camera, corners, aspect)
    brep = is_brep(source.kind)
    magnified = _magnified(camera, corners)
    placed = _sized(width, height, options, source.frame.unit, brep, aspect, magnified)
    placed = placed.foreseen(camera, options, source)
    stray = stray_note(source, camera)
    return placed if stray is None else replace(placed, notes=(*placed.notes, stray))


def check_size(source: Source, bounds: Floats) -> None:
    """Raise SourceError where a bounding box (2, 3) is not finite, or all of it is one point."""
    low, high = bounds.tolist()
    if not all(map(math.isfinite, (*low, *high))):
        raise SourceError(f"{source.name} has no finite size: repair the model")
    if max([b - a for a, b in zip(low, high, strict=True)]) <= 0.0:
        raise SourceError(f"{source.name} has no size: all of it lies in one point")


def _extent(camera: Camera, points: Floats, aspect: float) -> tuple[float, float]:
    """Width and height on the image plane, model units; what lies behind the eye is left out."""
    if camera.eye is None or camera.distance is None or camera.fov is None:
        corners = np.ascontiguousarray(points, np.float64)
        (left, right), (bottom, top) = camera.scaled(1.0).reach(corners).tolist()
        return right - left, top - bottom
    half = camera.distance * math.tan(math.radians(camera.fov) * 0.5)
    frame = np.array([half * aspect, half])
    before = points[camera.ahead(points) > NEAR * camera.distance]
    if len(before) < len(points):
        return 2.0 * float(frame[0]), 2.0 * half
    flat = camera.project(before)[:, :2]
    if camera.framed:
        flat = np.clip(flat, -frame, frame)
    size = flat.max(axis=0) - flat.min(axis=0)
    return float(size[0]), float(size[1])


def _magnified(camera: Camera, points: Floats) -> float:
    """How much larger than in the image plane the nearest of the points (n, 3) is drawn."""
    if camera.eye is None or camera.distance is None:
        return 1.0
    nearest = max(float(camera.ahead(points).min()), camera.distance / MOST_MAGNIFIED)
    return max(1.0, camera.distance / nearest)


def _sized(
    width: float, height: float, options: Options, unit: float, brep: bool, aspect: float, magnified: float
) -> Placement:
    """Scale and tolerances of a view. width, height: on the image plane, model units."""
    placed = on_paper((width * unit, height * unit), options)
    scale = placed.scale
    per_model = scale * unit
    diagonal = math.hypot(width, height) * per_model
    accuracy = choose(options.accuracy, diagonal)
    tolerances = derive(accuracy, per_model * magnified, diagonal, brep=brep)
    notes = () if options.scale is None else size_notes(diagonal, scale)
    sheet, known = placed.paper, settled(options)
    return Placement(scale, per_model, tolerances, unit, brep, aspect, magnified, notes, sheet, known, (width, height))


def size_notes(diagonal: float, scale: float) -> tuple[Note, ...]:
    """What is said of a drawing (diagonal: millimetres) that its given scale makes very small or very large."""
    if 0.0 < diagonal < SMALLEST_PAPER:
        size = f"only {typed(diagonal, 2, 15)} mm"
    elif diagonal > LARGEST_PAPER:
        size = f"{typed(diagonal / 1000.0, 3)} m"
    else:
        return ()
    text = f"the drawing is {size} large at {ratio(scale)}: without a scale it gets one that fits a page"
    return (Note("paper-size", text),)


def _aspect(options: Options) -> float:
    """Width to height of the frame of a camera: that of the size to fit into, where this is one."""
    if options.fit is None:
        return ASPECT
    rooms = [paper.room for paper in papers(options.fit)] if isinstance(options.fit, str) else [options.fit]
    return rooms[0][0] / rooms[0][1] if len(rooms) == 1 else ASPECT
