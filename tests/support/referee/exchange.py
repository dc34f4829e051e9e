"""Reads a drawing in the JSON exchange format. Shares no code with the writer that it checks."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


class FormatError(ValueError):
    """The text is not a drawing in the exchange format."""


@dataclass(frozen=True)
class Camera:
    """The camera of the drawing, in model coordinates; `direction` points toward the viewer.

    eye, distance   perspective only: the eye, and the distance from it to the image plane
    """

    name: str
    direction: Floats
    right: Floats
    up: Floats
    eye: Floats | None = None
    distance: float = 0.0


@dataclass(frozen=True)
class DrawnLine:
    kind: str
    visible: bool
    part: int
    edge: int | None
    face: int | None
    points: Floats
    points3: Floats
    curve: Mapping[str, Any] | None = None

    def ink(self, spacing: float) -> Floats:
        """Points on paper along the line (along its curve if it has one), at most about `spacing` apart."""
        rough = self.points if self.curve is None else _along(self.curve, 4 * len(self.points) + 16)
        along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(rough, axis=0), axis=1))]
        count = max(2, int(np.ceil(along[-1] / spacing)) + 1)
        if self.curve is not None:
            return _along(self.curve, max(count, 16))
        wanted = np.unique(np.r_[np.linspace(0.0, along[-1], count), along])
        return np.stack([np.interp(wanted, along, rough[:, k]) for k in (0, 1)], axis=1)


@dataclass(frozen=True)
class Exchange:
    camera: Camera
    lines: list[DrawnLine]
    parts: list[str]
    scale: float
    origin: Floats
    unit: float
    document: Mapping[str, Any]

    @property
    def accuracy(self) -> float:
        """The accuracy that the drawing states, millimetres on paper; 0 if it states none."""
        return float(self.document.get("accuracy", {}).get("used") or 0.0)

    @property
    def factor(self) -> float:
        """Millimetres on paper per model unit; in perspective, at the image plane."""
        return self.unit * self.scale

    def magnification(self, model: Floats) -> Floats:
        """Millimetres on paper per model unit at each point (n, 3)."""
        if self.camera.eye is None:
            return np.full(len(model), self.factor)
        depth = -((model - self.camera.eye) @ self.camera.direction)
        with np.errstate(all="ignore"):
            return np.asarray(self.factor * self.camera.distance / depth)

    def on_paper(self, model: Floats) -> Floats:
        """Project points of the model (n, 3) to paper (n, 2), as the format describes it."""
        from_eye = model if self.camera.eye is None else model - self.camera.eye
        flat = np.stack([from_eye @ self.camera.right, from_eye @ self.camera.up], axis=1)
        with np.errstate(all="ignore"):
            return np.asarray(flat * self.magnification(model)[:, None] - self.origin)

    def rays(self, paper: Floats, back: float) -> tuple[Floats, Floats]:
        """Start and unit direction (n, 3) of the rays from the viewer through points on paper (n, 2).

        Parallel rays start `back` model units before the origin.
        """
        camera = self.camera
        flat = (paper + self.origin) / self.factor
        aside = flat @ np.stack([camera.right, camera.up])
        if camera.eye is None:
            return aside + back * camera.direction, np.broadcast_to(-camera.direction, aside.shape)
        toward = aside - camera.distance * camera.direction
        toward = toward / np.linalg.norm(toward, axis=1)[:, None]
        return np.broadcast_to(camera.eye, aside.shape), toward


def _vector(value: Any, what: str) -> Floats:
    vector = np.asarray(value, dtype=np.float64)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise FormatError(f"{what}: three finite numbers expected, got {value!r}")
    return vector


def _camera(view: Mapping[str, Any]) -> Camera:
    axes = {key: _vector(view[key], f"view.{key}") for key in ("direction", "right", "up")}
    for key, axis in axes.items():
        if abs(np.linalg.norm(axis) - 1.0) > 1e-6:
            raise FormatError(f"view.{key} is not a unit vector: {axis}")
    if np.abs(np.cross(axes["right"], axes["up"]) - axes["direction"]).max() > 1e-6:
        raise FormatError("view: right x up is not the direction")
    if view["projection"] == "orthographic":
        return Camera(str(view["name"]), axes["direction"], axes["right"], axes["up"])
    eye, distance = _vector(view["eye"], "view.eye"), float(view["distance"])
    return Camera(str(view["name"]), axes["direction"], axes["right"], axes["up"], eye, distance)


def _along(curve: Mapping[str, Any], count: int) -> Floats:
    """At least `count` points along a curve of the format."""
    if curve["type"] == "arc":
        t = np.linspace(*curve["angles"], count)[:, None]
        one, other = np.asarray(curve["axes"], dtype=np.float64)
        return np.asarray(np.asarray(curve["centre"]) + np.cos(t) * one + np.sin(t) * other)
    if curve["type"] != "bezier":
        raise FormatError(f"curve of type {curve['type']!r}")
    control, degree = np.asarray(curve["points"], dtype=np.float64), int(curve["degree"])
    pieces = (len(control) - 1) // degree
    t = np.linspace(0.0, 1.0, max(2, -(-count // pieces) + 1))[:, None]
    found = []
    for piece in range(pieces):
        points = [np.broadcast_to(p, (len(t), 2)) for p in control[piece * degree : (piece + 1) * degree + 1]]
        while len(points) > 1:
            points = [(1 - t) * a + t * b for a, b in pairwise(points)]
        found.append(points[0])
    return np.concatenate(found)


def _line(number: int, entry: Mapping[str, Any], parts: int) -> DrawnLine:
    points = np.asarray(entry["points"], dtype=np.float64)
    points3 = np.asarray(entry["points3"], dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 2 or points3.shape != (len(points), 3) or len(points) < 2:
        raise FormatError(f"line {number}: points {points.shape} and points3 {points3.shape} do not belong together")
    if not np.isfinite(points).all() or not np.isfinite(points3).all():
        raise FormatError(f"line {number}: a coordinate is not finite")
    if not 0 <= entry["part"] < parts:
        raise FormatError(f"line {number}: part {entry['part']} of {parts}")
    return DrawnLine(
        str(entry["class"]),
        bool(entry["visible"]),
        int(entry["part"]),
        entry["edge"],
        entry["face"],
        points,
        points3,
        entry.get("curve"),
    )


def parse(document: Mapping[str, Any] | str | bytes) -> Exchange:
    """Read a document as arrays, and check all that the judge relies on."""
    data: Mapping[str, Any] = json.loads(document) if isinstance(document, str | bytes) else document
    if data.get("format") != "hlr-drawing" or data.get("version") != 2:
        raise FormatError(f"format {data.get('format')!r} version {data.get('version')!r}: hlr-drawing 2 expected")
    try:
        parts = [str(part["name"]) for part in data["parts"]]
        return Exchange(
            camera=_camera(data["view"]),
            lines=[_line(number, entry, len(parts)) for number, entry in enumerate(data["lines"])],
            parts=parts,
            scale=float(data["scale"]),
            origin=np.asarray(data["origin"], dtype=np.float64),
            unit=float(data["model"]["unit"]),
            document=data,
        )
    except KeyError as missing:
        raise FormatError(f"missing key {missing}") from missing


def read(path: str | Path) -> Exchange:
    return parse(Path(path).read_bytes())
