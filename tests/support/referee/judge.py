"""Decides by rays whether drawn lines are truly visible or hidden.

A point of a visible line is wrong if rays to the viewer are blocked from the point and from all points of a ring around
it; a point of a hidden line is wrong if none of these rays is blocked. The ring, and the least depth from which a hit
counts, leave room for what cannot be decided: both meshes differ from the true model by up to their deflections.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from support.referee.exchange import Camera, DrawnLine, Exchange
from support.referee.reference import FINENESS, Floats, Reference

FRACTIONS = (0.1, 0.3, 0.5, 0.7, 0.9)
SHORTEST = 1 / 1000
"""Lines up to this are not judged; like the following in diagonals of the bounding box, for a mesh of full fineness."""
RADIUS = 1 / 3000
DEPTH = 1 / 8000
OFF = 1 / 10000
"""Farthest that a point on paper may lie from the projection of its model position."""
RING = 8
CHUNK = 100_000


@dataclass(frozen=True)
class Samples:
    """Points on lines: position, index of the line, whether it is drawn visible."""

    points: Floats
    line: npt.NDArray[np.int64]
    visible: npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Verdict:
    """`blocked` is the number of blocked rays, of nine, for each sample.

    judged      lines long enough to be sampled
    displaced   samples whose paper position is not the projection of their model position
    """

    samples: Samples
    blocked: npt.NDArray[np.int64]
    judged: int
    displaced: int

    @property
    def wrong_visible(self) -> npt.NDArray[np.bool_]:
        return self.samples.visible & (self.blocked == RING + 1)

    @property
    def wrong_hidden(self) -> npt.NDArray[np.bool_]:
        return ~self.samples.visible & (self.blocked == 0)

    @property
    def wrong(self) -> int:
        return int(self.wrong_visible.sum() + self.wrong_hidden.sum())


class RayCaster:
    """Rays by Embree against a reference mesh. Embree is single precision, so the mesh is centred and scaled to 1."""

    def __init__(self, reference: Reference) -> None:
        corners = reference.points[reference.triangles]
        self.diagonal = reference.diagonal
        self._coarseness = FINENESS / reference.fineness
        self._centre = (corners.reshape(-1, 3).min(axis=0) + corners.reshape(-1, 3).max(axis=0)) / 2
        self._corners = (corners - self._centre) / self.diagonal
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.normals = across / np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
        self.centre, self.corners = self._centre, corners.reshape(-1, 3)
        self._scene = EmbreeScene(robust=True)
        TriangleMesh(self._scene, np.ascontiguousarray(self._corners, dtype=np.float32))

    @property
    def measure(self) -> float:
        """The length, model units, of which the rules take fractions: the diagonal, or more for a coarser mesh."""
        return self.diagonal * self._coarseness

    def blocked(self, points: Floats, camera: Camera) -> npt.NDArray[np.int64]:
        """For each point the number of blocked rays among its own and those of the ring."""
        return np.asarray(self.blocked_each(points, camera).sum(axis=1), dtype=np.int64)

    def blocked_each(self, points: Floats, camera: Camera) -> npt.NDArray[np.bool_]:
        """(n, 9): the point's own ray first, then the ring."""
        parts = [self._blocked(points[i : i + CHUNK], camera) for i in range(0, len(points), CHUNK)]
        return np.concatenate(parts) if parts else np.zeros((0, RING + 1), dtype=np.bool_)

    def _blocked(self, points: Floats, camera: Camera) -> npt.NDArray[np.bool_]:
        depth = DEPTH * self._coarseness
        starts = (points - self._centre) / self.diagonal
        if camera.eye is None:
            toward = np.broadcast_to(camera.direction, starts.shape)
            reach = np.full(len(starts), np.inf)
        else:
            toward = (camera.eye - self._centre) / self.diagonal - starts
            reach = np.linalg.norm(toward, axis=1)
            toward = toward / reach[:, None]
        origins = starts[:, None, :] + np.concatenate([np.zeros((1, 3)), self._ring(camera)])[None]
        origins = (origins + (toward * depth)[:, None, :]).reshape(-1, 3)
        toward = np.repeat(toward, RING + 1, axis=0)
        limit = np.repeat(np.minimum(reach - depth, 1e30), RING + 1)
        return self._hit(origins, toward, limit).reshape(-1, RING + 1)

    def open_around(self, points: Floats, camera: Camera, step: float) -> npt.NDArray[np.int64]:
        """For each point the number of ring points without a surface at the point's depth, within `step`."""
        step /= self.diagonal
        starts = ((points - self._centre) / self.diagonal)[:, None, :] + self._ring(camera)[None]
        origins = (starts + step * camera.direction).reshape(-1, 3)
        away = np.broadcast_to(-camera.direction, origins.shape)
        met = self._hit(origins, away, np.full(len(origins), 2 * step)).reshape(-1, RING)
        return np.asarray(RING - met.sum(axis=1), dtype=np.int64)

    def first(self, starts: Floats, toward: Floats) -> tuple[Floats, npt.NDArray[np.int64]]:
        """The distance at which each ray hits (model units; inf: no hit), and the triangle (-1: no hit)."""
        far, hit = np.full(len(starts), np.inf), np.full(len(starts), -1, dtype=np.int64)
        for i in range(0, len(starts), CHUNK):
            part = slice(i, i + CHUNK)
            result = self._scene.run(
                np.ascontiguousarray((starts[part] - self._centre) / self.diagonal, dtype=np.float32),
                np.ascontiguousarray(toward[part], dtype=np.float32),
                output=True,
            )
            hit[part] = result["primID"]
            met = result["primID"] >= 0
            far[part][met] = result["tfar"][met] * self.diagonal
        return far, hit

    def _ring(self, camera: Camera) -> Floats:
        angles = np.arange(RING) * (2 * np.pi / RING)
        return (
            RADIUS * self._coarseness * (np.cos(angles)[:, None] * camera.right + np.sin(angles)[:, None] * camera.up)
        )

    def _hit(self, origins: Floats, toward: Floats, limit: Floats) -> npt.NDArray[np.bool_]:
        result = self._scene.run(
            np.ascontiguousarray(origins, dtype=np.float32), np.ascontiguousarray(toward, dtype=np.float32), output=True
        )
        return np.asarray((result["primID"] >= 0) & (result["tfar"] < limit))


def sample(drawing: Exchange, measure: float) -> tuple[Samples, int]:
    """Five points on each line that is long enough, at fixed fractions of its length in the image."""
    points: list[Floats] = []
    numbers: list[int] = []
    for number, line in enumerate(drawing.lines):
        along = _image_length(line, drawing.camera)
        if along[-1] <= measure * SHORTEST:
            continue
        points.append(_at(line.points3, along))
        numbers.append(number)
    line_of = np.repeat(np.asarray(numbers, dtype=np.int64), len(FRACTIONS))
    visible = np.array([line.visible for line in drawing.lines], dtype=np.bool_)
    position = np.concatenate(points) if points else np.zeros((0, 3))
    return Samples(position, line_of, visible[line_of]), len(numbers)


def _image_length(line: DrawnLine, camera: Camera) -> Floats:
    """Running length of a line in the image: its extent along the line of sight does not count."""
    steps = np.diff(line.points3, axis=0)
    sight = camera.direction if camera.eye is None else camera.eye - (line.points3[1:] + line.points3[:-1]) / 2
    sight = sight / np.linalg.norm(sight, axis=-1, keepdims=True)
    across = steps - np.sum(steps * sight, axis=-1, keepdims=True) * sight
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(across, axis=1))])


def _at(points: Floats, along: Floats) -> Floats:
    wanted = np.asarray(FRACTIONS) * along[-1]
    return np.stack([np.interp(wanted, along, points[:, axis]) for axis in range(3)], axis=1)


def _displaced(drawing: Exchange, measure: float) -> int:
    """The number of vertices whose place on paper is not the projection of their model position."""
    if not drawing.lines:
        return 0
    model = np.concatenate([line.points3 for line in drawing.lines])
    paper = np.concatenate([line.points for line in drawing.lines])
    off = np.abs(drawing.on_paper(model) - paper).max(axis=1)
    return int((off > OFF * measure * drawing.magnification(model)).sum())


def judge(drawing: Exchange, caster: RayCaster) -> Verdict:
    samples, judged = sample(drawing, caster.measure)
    blocked = caster.blocked(samples.points, drawing.camera)
    return Verdict(samples, blocked, judged, _displaced(drawing, caster.measure))


def offenders(drawing: Exchange, verdict: Verdict) -> Iterator[str]:
    """One line of text per wrongly drawn line, worst first."""
    wrong = verdict.wrong_visible | verdict.wrong_hidden
    numbers, first, counts = np.unique(verdict.samples.line[wrong], return_index=True, return_counts=True)
    positions = verdict.samples.points[wrong]
    for i in np.argsort(-counts, kind="stable"):
        line = drawing.lines[numbers[i]]
        x, y, z = positions[first[i]]
        state = "visible" if line.visible else "hidden"
        yield (
            f"{counts[i]}/{len(FRACTIONS)} {line.kind} {state}: part {line.part} {drawing.parts[line.part]!r} "
            f"edge {line.edge} face {line.face} line {numbers[i]} at ({x:.6g}, {y:.6g}, {z:.6g})"
        )
