"""How large a view is on paper, and what its tolerances are then."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.image.camera import ASPECT, NEAR, Camera
from hlr.image.strays import stray_note
from hlr.request.accuracy import CURVE_BULGE, MOST_MAGNIFIED, Tolerances, choose, derive
from hlr.request.options import Options
from hlr.source.model import Source
from hlr.tables.readers import is_brep

SMALLEST_PAPER, LARGEST_PAPER = 5.0, 3000.0
"""Millimetres: beyond these a drawing is probably not what was meant, and a note says so."""

CORNERS = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)])
"""(8, 3) which end of a box each of its corners has along each axis."""
AXES = np.arange(3)

_CURE = "give a scale, or a size to fit it into"


@dataclass(frozen=True, slots=True)
class Placement:
    """A view's scale (paper : millimetres of the model), per_model (paper millimetres per model unit), tolerances.

    aspect: width to height of the frame; magnified: how much larger than at the target the nearest point is drawn.
    fit: the millimetres of paper within which the view is to fit; None: its scale is given
    """

    scale: float
    per_model: float
    tolerances: Tolerances
    unit: float
    brep: bool
    aspect: float
    magnified: float
    notes: tuple[Note, ...] = ()
    fit: tuple[float, float] | None = None

    def fitted(self, camera: Camera, options: Options, points: Floats, curved: bool) -> Placement:
        """The placement with the size taken from the mesh: points (n, 3) in model coordinates.

        Curves bulge over their chords and are fitted within a share of the accuracy: `curved` leaves room for both.
        """
        if self.fit is None:
            return self
        width, height = _extent(camera, points, self.aspect)
        if curved and not camera.framed:
            bulge = max(
                self.tolerances.deflection * self.magnified, CURVE_BULGE * self.tolerances.accuracy / self.per_model
            )
            width, height = width + 2.0 * bulge, height + 2.0 * bulge
        sized = _sized(width, height, options, self.unit, self.brep, self.aspect, self.magnified)
        return replace(sized, notes=self.notes)


def place(camera: Camera, options: Options, source: Source, bounds: Floats) -> Placement:
    """Scale and tolerances from the bounding box (2, 3).

    Raises OptionError for an accuracy that cannot be kept, SourceError for a model without size.
    """
    if not np.isfinite(bounds).all():
        raise SourceError(f"{source.name} has no finite size: repair the model")
    corners = bounds[CORNERS, AXES]
    if float((bounds[1] - bounds[0]).max()) <= 0.0:
        raise SourceError(f"{source.name} has no size: all of it lies in one point")
    aspect = options.fit[0] / options.fit[1] if options.fit else ASPECT
    width, height = _extent(camera, corners, aspect)
    brep = is_brep(source.kind)
    magnified = _magnified(camera, corners)
    placed = _sized(width, height, options, source.frame.unit, brep, aspect, magnified)
    stray = stray_note(source, camera)
    return placed if stray is None else replace(placed, notes=(*placed.notes, stray))


def _extent(camera: Camera, points: Floats, aspect: float) -> tuple[float, float]:
    """Width and height on the image plane, model units; what lies behind the eye is left out."""
    if camera.eye is None or camera.distance is None or camera.fov is None:
        flat = camera.project(points)[:, :2]
        size = flat.max(axis=0) - flat.min(axis=0)
        return float(size[0]), float(size[1])
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
    scale = options.scale
    if options.fit is not None:
        ratios = [f / (s * unit) for f, s in zip(options.fit, (width, height), strict=True) if s > 0.0]
        scale = min(ratios, default=1.0)
    per_model = scale * unit
    diagonal = math.hypot(width, height) * per_model
    accuracy = choose(options.accuracy, diagonal)
    tolerances = derive(accuracy, per_model * magnified, diagonal, brep=brep)
    notes: tuple[Note, ...] = ()
    if options.fit is None and options.scale == 1.0 and diagonal > 0.0:
        if diagonal < SMALLEST_PAPER:
            notes = (Note("paper-size", f"the drawing is only {diagonal:.2g} mm large at 1:1: {_CURE}"),)
        elif diagonal > LARGEST_PAPER:
            notes = (Note("paper-size", f"the drawing is {diagonal / 1000.0:.3g} m large at 1:1: {_CURE}"),)
    return Placement(scale, per_model, tolerances, unit, brep, aspect, magnified, notes, options.fit)
