"""The plane of a section, or its planes where it steps: where they lie in a source, and whether they cut anything."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from hlr.common.numbers import typed
from hlr.common.types import Floats
from hlr.errors import OptionError
from hlr.image.camera import Camera, resolve
from hlr.linework.cut_faces import nearness
from hlr.linework.level_faces import with_level_faces
from hlr.request.accuracy import ANGLE, SMALL_DRAWING
from hlr.request.directions import directed
from hlr.request.options import Options, SectionPlace, Vector, View
from hlr.request.section import axis_of, is_stepped
from hlr.source.model import PartMesh, Source
from hlr.source.stepped import Stepped
from hlr.tables.readers import holds_meshes, is_brep

ALONG = 1e-9
"""How much less than 1 the share of an axis may be in a direction along it."""


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

    @property
    def height(self) -> float:
        """How far it lies toward the viewer, model units."""
        return float(np.array(self.point) @ np.array(self.normal))


@dataclass(frozen=True, slots=True)
class Planes:
    """The planes of a section: one, or where it steps several, which lie side by side.

    along  a direction of length 1, model coordinates; steps: how far along it the planes end, model units
    """

    planes: tuple[Plane, ...]
    along: Vector
    steps: tuple[float, ...] = ()

    @property
    def first(self) -> Plane:
        """The first of them, or the only one."""
        return self.planes[0]

    @property
    def normal(self) -> Vector:
        """Of length 1, toward the viewer."""
        return self.first.normal

    @property
    def near(self) -> float:
        """What lies so close to a plane lies on it, model units."""
        return self.first.near

    @property
    def touching(self) -> bool:
        """Nothing is taken away."""
        return all(plane.touching for plane in self.planes)

    def stepped(self) -> Stepped:
        """What the model is cut by."""
        normal = np.array(self.normal)
        levels = np.array([np.array(plane.point) @ normal for plane in self.planes])
        return Stepped(normal, np.array(self.along), levels, np.array(self.steps, float))

    def contain(self, points: Floats) -> npt.NDArray[np.bool_]:
        """Which of points (n, 3) lie on them."""
        return self.stepped().contain(points, self.near)

    def corners(self) -> tuple[Vector, ...]:
        """Points on the edges of the planes: of each step one on the plane before it, and one on that behind it."""
        found: list[Vector] = []
        along = np.array(self.along)
        for step, two in zip(self.steps, pairwise(self.planes), strict=True):
            for plane in two:
                point = np.array(plane.point)
                found.append(_vector(point + (step - float(point @ along)) * along))
        return tuple(found)


def planes_of(place: SectionPlace, view: View, source: Source, options: Options) -> Planes:
    """The planes at a place; place, view, options: checked.

    Raises OptionError where they leave the model whole, or nothing of it.
    """
    bounds = source.bounds()
    camera = resolve(view, options, source.frame, bounds)
    size = float(np.linalg.norm(bounds[1] - bounds[0]))
    meshed = source.mesh(size / SMALL_DRAWING, ANGLE).parts
    reach = _extent(source, meshed, size / SMALL_DRAWING, camera)
    if not is_stepped(place):
        return Planes((_plane_of(place, view, source, camera, meshed, reach),), camera.right)
    unit, name = source.frame.unit, directed(view)[0]
    axis, along = _along(camera, source, name)
    across = np.concatenate([part.points for part in meshed]) @ along
    first, *pairs = place
    steps = [step / unit for step, _ in cast("list[tuple[float, float]]", pairs)]
    for step in steps:
        if not across.min() < step < across.max():
            reached = " to ".join(typed(end * unit + 0.0) for end in (across.min(), across.max()))
            where = f"steps at {'xyz'[axis]} = {typed(step * unit)}, beside the model"
            raise OptionError(f"section {name} {where}: {source.name} reaches from {reached} mm there")
    ends = [float(across.min()), *steps, float(across.max())]
    places = [cast(float, first), *(at for _, at in cast("list[tuple[float, float]]", pairs))]
    planes = []
    for at, span in zip(places, pairwise(ends), strict=True):
        plane = _plane_of(at, view, source, camera, meshed, reach)
        point = np.array(plane.point)
        planes.append(replace(plane, point=_vector(point + (0.5 * sum(span) - float(point @ along)) * along)))
    return Planes(tuple(planes), _vector(along), tuple(steps))


def _along(camera: Camera, source: Source, name: str) -> tuple[int, Floats]:
    """The axis of the world that runs across a view: 0, 1 or 2, and its direction in the model."""
    up = np.array(source.frame.up)
    across = np.abs(up @ np.array(camera.right))
    axis = int(np.argmax(across))
    if across[axis] < 1.0 - ALONG:
        raise OptionError(
            f"section {name} steps along an axis, and none runs across the view: leave out its steps, or `up`"
        )
    return axis, up[axis]


def _rounding(parts: Sequence[PartMesh]) -> Floats:
    """(3,) how far points that are written as float32, as in STL files, may be off along each axis, model units.

    Zero where a number has more digits than a float32.
    """
    points = np.concatenate([part.points for part in parts])
    if not len(points) or (points != points.astype(np.float32)).any():
        return np.zeros(3)
    return np.asarray(np.spacing(np.abs(points).max(axis=0).astype(np.float32)), float)


def _plane_of(
    place: SectionPlace,
    view: View,
    source: Source,
    camera: Camera,
    meshed: Sequence[PartMesh],
    reach: tuple[float, float],
) -> Plane:
    """One plane. reach: of the model toward the viewer, model units."""
    bounds, unit, (low, high) = source.bounds(), source.frame.unit, reach
    normal, up = np.array(camera.direction), np.array(source.frame.up)
    given = None if place is True else np.array(_point(place, view)) / unit @ up
    at = 0.5 * (low + high) if given is None else float(given @ normal)
    rounding = float(np.abs(normal) @ _rounding(meshed)) if holds_meshes(source.kind) else 0.0
    near = nearness(bounds, is_brep(source.kind)) + rounding
    name = directed(view)[0]
    if not low - near <= at <= high + near or at <= low + near:
        what = "misses the model" if at > high or at < low - near else "leaves nothing of the model"
        raise OptionError(f"section {name} {_told(at, low, high, unit, view, source.name, what)}")
    middle = 0.5 * (bounds[0] + bounds[1])
    on = given if isinstance(place, tuple) else middle + (at - float(middle @ normal)) * normal
    point = _vector(on)
    level, ahead = (with_level_faces(meshed, np.array(point), sense * normal, near) for sense in (1.0, -1.0))
    return Plane(point, camera.direction, near, bool(at >= high - near), level, frozenset(ahead))


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


def _vector(values: Any) -> Vector:
    x, y, z = (np.asarray(values) + 0.0).tolist()
    return x, y, z


def _point(place: SectionPlace, view: View) -> Vector:
    """A point on the plane, millimetres in the world."""
    if isinstance(place, tuple):
        return cast(Vector, place)
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
