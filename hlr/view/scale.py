"""How large a view is on paper, and what its tolerances are then."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hlr.errors import SourceError
from hlr.plan.options import Options
from hlr.source.model import Floats, Source
from hlr.tolerance import Tolerances, choose, derive
from hlr.view.camera import Camera
from hlr.view.clip import ASPECT

SMALLEST_PAPER, LARGEST_PAPER = 5.0, 3000.0
"""Millimetres: beyond these a drawing is probably not what was meant, and a note says so."""


@dataclass(frozen=True, slots=True)
class Placed:
    """A view's scale (paper : millimetres of the model), per_model (paper millimetres per model unit), tolerances."""

    scale: float
    per_model: float
    tolerances: Tolerances
    unit: float
    brep: bool
    aspect: float
    notes: tuple[str, ...] = ()

    def fitted(self, camera: Camera, options: Options, points: Floats) -> Placed:
        """The same with the size taken from the mesh itself; (n, 3) model coordinates."""
        if options.fit is None:
            return self
        width, height = _extent(camera, points)
        return replace(_sized(width, height, options, self), notes=self.notes)


def place(camera: Camera, options: Options, source: Source, bounds: Floats) -> Placed:
    """Scale and tolerances from the bounding box (2, 3).

    Raises OptionError for an accuracy that cannot be kept, SourceError for a model without size.
    """
    corners = np.array([[bounds[i][0], bounds[j][1], bounds[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    if not np.isfinite(corners).all():
        raise SourceError(f"{source.name} has no finite size: repair the model")
    if float((bounds[1] - bounds[0]).max()) <= 0.0:
        raise SourceError(f"{source.name} has no size: all of it lies in one point")
    width, height = _extent(camera, corners)
    brep = source.kind in ("step", "iges", "brep", "script", "object")
    aspect = options.fit[0] / options.fit[1] if options.fit else ASPECT
    draft = Placed(1.0, 1.0, derive(1.0, 1.0, 0.0, brep=brep), source.frame.unit, brep, aspect)
    return _sized(width, height, options, draft)


def _extent(camera: Camera, points: Floats) -> tuple[float, float]:
    """Width and height on the image plane, model units; what lies behind the eye is left out."""
    if camera.eye is not None and camera.distance is not None and camera.fov is not None:
        before = points[camera.ahead(points) > 1e-3 * camera.distance]
        across = 2.0 * camera.distance * math.tan(math.radians(camera.fov) * 0.5)
        if len(before) < len(points) or len(before) == 0:
            return across, across
        points = before
    flat = camera.project(points)[:, :2]
    size = flat.max(axis=0) - flat.min(axis=0)
    return float(size[0]), float(size[1])


def _sized(width: float, height: float, options: Options, draft: Placed) -> Placed:
    scale = options.scale
    if options.fit is not None:
        ratios = [f / (s * draft.unit) for f, s in zip(options.fit, (width, height), strict=True) if s > 0.0]
        scale = min(ratios, default=1.0)
    per_model = scale * draft.unit
    diagonal = math.hypot(width, height) * per_model
    accuracy = choose(options.accuracy, diagonal)
    tolerances = derive(accuracy, per_model, diagonal, brep=draft.brep)
    notes: tuple[str, ...] = ()
    if options.fit is None and options.scale == 1.0 and diagonal > 0.0:
        if diagonal < SMALLEST_PAPER:
            notes = (f"the drawing is only {diagonal:.2g} mm large at 1:1: give a scale, or a size to fit it into",)
        elif diagonal > LARGEST_PAPER:
            notes = (f"the drawing is {diagonal / 1000.0:.3g} m large at 1:1: give a scale, or a size to fit it into",)
    return replace(draft, scale=scale, per_model=per_model, tolerances=tolerances, notes=notes)
