"""The plane of a section: where it lies in a source, and whether it cuts anything there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hlr.common.numbers import typed
from hlr.common.types import Floats
from hlr.errors import OptionError
from hlr.image.camera import Camera, resolve
from hlr.linework.cut_faces import nearness
from hlr.linework.level_faces import with_level_faces
from hlr.request.accuracy import ANGLE, SMALL_DRAWING
from hlr.request.directions import directed
from hlr.request.options import Options, SectionPlace, Vector, View
from hlr.request.section import axis_of
from hlr.source.model import PartMesh, Source
from hlr.tables.readers import is_brep


@dataclass(frozen=True, slots=True)
class Plane:
    """A plane across a view. Model coordinates.

    point     on the plane; normal: of length 1, toward the viewer
    near      what lies so close to the plane lies on it, model units
    touching  the plane only touches the model from the front: nothing is taken away
    level     parts of the whole model that have faces on the plane which look to the viewer, by name
    ahead     names of those that have faces on it which look away from the viewer
    """

    point: Vector
    normal: Vector
    near: float
    touching: bool
    level: Mapping[str, PartMesh]
    ahead: frozenset[str] = frozenset()

    def heights(self, points: Floats) -> Floats:
        """(n,) how far points (n, 3) lie before the plane, model units."""
        return np.asarray((points - np.array(self.point)) @ np.array(self.normal))


def plane_of(place: SectionPlace, view: View, source: Source, options: Options) -> Plane:
    """The plane at a place; place, view, options: checked.

    Raises OptionError where it leaves the model whole, or nothing of it.
    """
    bounds, unit = source.bounds(), source.frame.unit
    camera = resolve(view, options, source.frame, bounds)
    normal, up = np.array(camera.direction), np.array(source.frame.up)
    size = float(np.linalg.norm(bounds[1] - bounds[0]))
    meshed = source.mesh(size / SMALL_DRAWING, ANGLE).parts
    low, high = _extent(source, meshed, size / SMALL_DRAWING, camera)
    given = None if place is True else np.array(_point(place, view)) / unit @ up
    at = 0.5 * (low + high) if given is None else float(given @ normal)
    near = nearness(bounds, is_brep(source.kind))
    name = directed(view)[0]
    if not low - near <= at <= high + near or at <= low + near:
        what = "misses the model" if at > high or at < low - near else "leaves nothing of the model"
        raise OptionError(f"section {name} {_told(at, low, high, unit, view, source.name, what)}")
    middle = 0.5 * (bounds[0] + bounds[1])
    on = given if isinstance(place, tuple) else middle + (at - float(middle @ normal)) * normal
    x, y, z = (np.asarray(on) + 0.0).tolist()
    level, ahead = (with_level_faces(meshed, np.array([x, y, z]), sense * normal, near) for sense in (1.0, -1.0))
    return Plane((x, y, z), camera.direction, near, bool(at >= high - near), level, frozenset(ahead))


def _extent(source: Source, meshed: Sequence[PartMesh], chord: float, camera: Camera) -> tuple[float, float]:
    """From where to where the model extends toward the viewer, model units.

    meshed: its parts, with this chord error. The mesh tells it within that; the geometry exactly, unless splines count
    by their control points.
    """
    heights = np.concatenate([part.points for part in meshed]) @ np.array(camera.direction)
    rough = np.array([heights.min(), heights.max()])
    ask: Any = getattr(source, "reach", None)
    if ask is None:
        return float(rough[0]), float(rough[1])
    exact = np.array(ask(camera.direction, camera.right)[0])
    low, high = np.where(np.abs(exact - rough) <= 2.0 * chord, exact, rough).tolist()
    return low, high


def _point(place: SectionPlace, view: View) -> Vector:
    """A point on the plane, millimetres in the world."""
    if isinstance(place, tuple):
        return place
    axis = axis_of(directed(view)[1])
    x, y, z = (float(place) if k == axis else 0.0 for k in range(3))
    return x, y, z


def _told(at: float, low: float, high: float, unit: float, view: View, name: str, what: str) -> str:
    """Why a plane cannot be: where it is, and where the model is, along the view's axis or toward the viewer."""
    direction = directed(view)[1]
    axis = axis_of(direction)
    sense = 1.0 if axis is None else direction[axis]
    a, b = sorted((sense * low * unit + 0.0, sense * high * unit + 0.0))
    if axis is None:
        where = f"lies {typed(at * unit)} mm from the origin toward the viewer, and"
        return f"{where} {what}: {name} reaches from {typed(a)} to {typed(b)} mm there, so give a point between"
    where = f"at {'xyz'[axis]} = {typed(sense * at * unit)}"
    return f"{where} {what}: {name} reaches from {typed(a)} to {typed(b)} mm there, so give a number between"
