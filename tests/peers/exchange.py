"""Read a drawing in the JSON exchange format. Shares no code with the writer it helps to check."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


class FormatError(ValueError):
    """The text is not a drawing in the exchange format."""


@dataclass(frozen=True)
class Camera:
    """Where the drawing was made from, in model coordinates; `direction` points toward the viewer.

    eye, distance   perspective only: the eye, and how far before it the image plane lies
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


@dataclass(frozen=True)
class Exchange:
    camera: Camera
    lines: list[DrawnLine]
    parts: list[str]
    scale: float
    origin: Floats
    unit: float
    document: Mapping[str, Any]


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
    )


def parse(document: Mapping[str, Any] | str | bytes) -> Exchange:
    """Check what the judge relies on and hand it over as arrays."""
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
