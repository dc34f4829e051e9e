"""The camera: from model coordinates to the image plane and depth.

One convention everywhere: x right, y up, z (depth) away from the viewer. Only additions, multiplications, divisions and
square roots, element by element: they round alike on every machine, which BLAS and trigonometry do not.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.errors import ViewError
from hlr.request.directions import EYE, apart, axes, directed, normalized, pictorial
from hlr.request.options import Options, Perspective, Vector, View
from hlr.source.model import Frame

Floats = npt.NDArray[np.float64]

NEAR = 1e-3
"""Distance of the near plane from the eye, as a share of the eye's distance from its target."""
WIDEST = 120.0
"""Degrees: the widest field of view that is chosen where none is given."""
ASPECT = 4.0 / 3.0
"""Width to height of the frame that a field of view spans."""
MARGIN = 1.05
"""How much wider than the model's bounding sphere a field of view is chosen."""


def dot(points: Floats, v: Vector) -> Floats:
    """(n, 3) . (3,), element by element."""
    return np.asarray(points[:, 0] * v[0] + points[:, 1] * v[1] + points[:, 2] * v[2])


@dataclass(frozen=True, slots=True)
class Camera:
    """All vectors in model coordinates; direction points from the object toward the viewer.

    Perspective where eye is not None; `distance` is that of the image plane, through the target.
    pictorial: in perspective, or oblique to the axes of the world.
    """

    name: str
    direction: Vector
    right: Vector
    up: Vector
    eye: Vector | None = None
    target: Vector | None = None
    fov: float | None = None
    distance: float | None = None
    framed: bool = False
    pictorial: bool = False

    def project(self, points: Floats, divide: bool = False) -> Floats:
        """(n, 3) model coordinates -> (n, 3) x right, y up, depth; perspective: z maps to -distance^2 / z.

        divide: divide by the distance from the eye in a parallel view as well, where that distance is 1 everywhere.
        """
        image = self.scaled(1.0).image(np.ascontiguousarray(points, np.float64))
        return image / np.ones((len(points), 1)) if divide and self.eye is None else image

    def scaled(self, per_model: float) -> _kernel.Camera:
        """The camera as the kernel takes it. per_model: millimetres on paper per model unit."""
        eye = None if self.eye is None or self.distance is None else (self.eye, self.distance)
        return _kernel.Camera(self.direction, self.right, self.up, eye, per_model)

    def ahead(self, points: Floats) -> Floats:
        """(n,) distance from the eye's plane, positive in front of the eye; in parallel views minus the depth."""
        if self.eye is None:
            return -dot(points, self.direction)
        return -dot(points - np.asarray(self.eye), self.direction)

    def toward(self, points: Floats) -> Floats:
        """(n, 3) unit vectors from points toward the viewer."""
        if self.eye is None:
            return np.broadcast_to(np.asarray(self.direction), points.shape)
        away = np.asarray(self.eye) - points
        return np.asarray(away / np.maximum(np.linalg.norm(away, axis=1), np.finfo(float).tiny)[:, None])


def resolve(view: View, options: Options, frame: Frame, bounds: Floats) -> Camera:
    """The camera for a named view or a direction; `bounds` (2, 3) in model coordinates.

    Raises ViewError for an unknown name, a zero direction, or up parallel to the direction.
    """
    perspective = options.perspective
    eye = target = None
    if perspective is not None and perspective.eye is not None:
        # A given eye replaces the direction of the view: the view's name and up vector do not apply.
        name, named_up = EYE, None
        eye, target, direction = _eye(perspective, (0.0, 0.0, 1.0), frame, bounds)
    else:
        name, direction, named_up = directed(view)
        if perspective is not None:
            eye, target, direction = _eye(perspective, direction, frame, bounds)
    right, up = axes(direction, named_up if options.up is None else options.up)
    camera = Camera(
        name,
        _to_model(frame, direction),
        _to_model(frame, right),
        _to_model(frame, up),
        eye=eye,
        target=target,
        pictorial=eye is not None or pictorial(direction),
    )
    return camera if eye is None else _framed(camera, perspective, bounds)


def _to_model(frame: Frame, v: Vector) -> Vector:
    """World (z up) to model axes: multiplied by the transpose of `frame.up`, which is a rotation."""
    (a, b, c), (d, e, f), (g, h, i) = frame.up
    x, y, z = v
    return (a * x + d * y + g * z + 0.0, b * x + e * y + h * z + 0.0, c * x + f * y + i * z + 0.0)


def _eye(perspective: Perspective, direction: Vector, frame: Frame, bounds: Floats) -> tuple[Vector, Vector, Vector]:
    """Eye and target in model coordinates, and the direction between them in world axes."""
    centre = [float(c) for c in (bounds[0] + bounds[1]) * 0.5]
    radius = 0.5 * math.sqrt(sum(float(c) * float(c) for c in bounds[1] - bounds[0])) or 1.0
    to_world = Frame(up=tuple(zip(*frame.up, strict=True)))
    target = _given(perspective.target, frame) or (centre[0], centre[1], centre[2])
    eye = _given(perspective.eye, frame)
    if eye is None:
        half = math.radians((perspective.fov or 45.0) * 0.5)
        away = MARGIN * radius / math.sin(half)
        d = _to_model(frame, direction)
        eye = (target[0] + away * d[0], target[1] + away * d[1], target[2] + away * d[2])
        apart(eye, target, radius)
        return eye, target, direction
    apart(eye, target, radius)
    toward = normalized([e - t for e, t in zip(eye, target, strict=True)], "the way from target to eye")
    return eye, target, _to_model(to_world, toward)


def _given(point: Vector | None, frame: Frame) -> Vector | None:
    """A point the caller gave in world millimetres, in model coordinates."""
    if point is None:
        return None
    if not all(math.isfinite(c) for c in point):
        raise ViewError("eye and target need three finite numbers each")
    return _to_model(frame, (point[0] / frame.unit, point[1] / frame.unit, point[2] / frame.unit))


def _framed(camera: Camera, perspective: Perspective | None, bounds: Floats) -> Camera:
    """The camera with its image plane through the target and its field of view settled."""
    assert camera.eye is not None and camera.target is not None and perspective is not None
    distance = math.sqrt(sum((e - t) * (e - t) for e, t in zip(camera.eye, camera.target, strict=True)))
    fov = perspective.fov
    if fov is None:
        corners = np.array([[bounds[i][0], bounds[j][1], bounds[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
        ahead = camera.ahead(corners)
        if float(ahead.min()) <= 0.0:
            fov = WIDEST
        else:
            away = corners - np.asarray(camera.eye)
            reach = max(float(np.max(np.abs(dot(away, v)) / ahead)) for v in (camera.right, camera.up))
            fov = min(WIDEST, 2.0 * math.degrees(math.atan(MARGIN * reach)))
    return replace(camera, fov=fov, distance=distance, framed=perspective.eye is not None)
