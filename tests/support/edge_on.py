"""Faces seen nearly edge-on: which parts of their edges and outlines are visible, and where a drawing lacks lines.

A point of an edge or of a true outline counts as visible if nothing is in front of it after it was moved in the image,
square to its line, by between a fifth of the accuracy and the whole accuracy, to either side. So a face that only leads
away from the line along the line of sight does not hide it. Every visible point must have visible ink within one and a
half accuracies. Conversely, a point of a visible line is wrong if it and a whole ring around it, wider than the
accuracy, are hidden.

The surfaces are sampled by OpenCASCADE's own evaluation on a grid of their parameters, far finer than any drawing. So
faces must be bounded by lines of constant parameter.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from scipy.spatial import cKDTree

import hlr
from hlr.lab.sampling import polyline
from support import sheets
from support.ink import flat

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]

STEPS = (0.2, 0.4, 0.7, 1.0)
"""In accuracies: how far a point is moved off its line."""
NEAR = 1.5
"""In accuracies: ink is there within this; half of it is for what the promise leaves to grazing lines."""
RING = 2.0
"""In accuracies: radius of the ring of which all is hidden where a visible line is wrong."""
GRID = 400
"""Cells of a face's grid along each parameter."""
ALONG = 400
"""Samples of each edge."""


@dataclass(frozen=True)
class Curve:
    """Points (n, 3) of an edge or an outline with unit tangents (n, 3), in order where it is an edge."""

    name: str
    points: Floats
    tangents: Floats
    ordered: bool


@dataclass
class Faults:
    """gaps: curve, length on paper in mm, middle on paper; wrong: points on paper of visible lines that are hidden."""

    gaps: list[tuple[str, float, Floats]] = field(default_factory=list)
    wrong: list[tuple[str, Floats]] = field(default_factory=list)
    seen: int = 0
    judged: int = 0

    @property
    def worst(self) -> float:
        return max((length for _, length, _ in self.gaps), default=0.0)

    @property
    def total(self) -> float:
        return float(sum(length for _, length, _ in self.gaps))


class Truth:
    """A finely sampled shape, which can judge drawings of any view."""

    def __init__(self, shape: Any, grid: int = GRID) -> None:
        self.faces = sheets.faces(shape, grid)
        self.edges = [Curve(f"edge {i}", p, t, True) for i, (p, t) in enumerate(sheets.edges(shape, ALONG), 1)]
        points = np.concatenate([f.points.reshape(-1, 3) for f in self.faces])
        first = np.cumsum([0] + [f.points.shape[0] * f.points.shape[1] for f in self.faces])
        triangles = np.concatenate([f.triangles() + n for f, n in zip(self.faces, first[:-1], strict=True)])
        self.low, self.high = points.min(axis=0), points.max(axis=0)
        self.size = float(np.linalg.norm(self.high - self.low))
        self.centre = (self.low + self.high) / 2
        corners = (points[triangles] - self.centre) / self.size
        self.scene = EmbreeScene(robust=True)
        TriangleMesh(self.scene, np.ascontiguousarray(corners, dtype=np.float32))

    def blocked(self, starts: Floats, direction: Floats) -> npt.NDArray[np.bool_]:
        """(n,) whether anything lies between points (n, 3) and a viewer infinitely far away."""
        origins = np.ascontiguousarray((starts - self.centre) / self.size, dtype=np.float32)
        ways = np.ascontiguousarray(np.broadcast_to(direction, origins.shape), dtype=np.float32)
        return np.asarray(self.scene.run(origins, ways) >= 0)

    def outlines(self, direction: Floats) -> Iterator[Curve]:
        """The curves on which the faces' normals are at a right angle to the view, borders excepted."""
        for i, face in enumerate(self.faces, 1):
            points, tangents = face.outline(direction)
            if len(points):
                yield Curve(f"outline of face {i}", points, tangents, False)

    def judge(self, drawn: hlr.Drawing) -> Faults:
        """Find what one drawing lacks, and what is wrong in it."""
        view = drawn.view
        assert view.projection == "orthographic"
        right, up, toward = (np.array(v) for v in (view.right, view.up, view.direction))
        per_model = drawn.scale * drawn.unit
        used = drawn.accuracy.used
        step = used / per_model
        frame = np.stack([right, up], axis=1)
        origin = np.array(drawn.origin)
        paper = lambda p: p @ frame * per_model - origin  # noqa: E731
        found = Faults()
        ink = [polyline(flat(line), 0.5 * used) for line in drawn.lines if line.visible]
        tree = cKDTree(np.concatenate(ink)) if ink else None
        for curve in [*self.edges, *self.outlines(toward)]:
            if is_point(curve, toward, step):
                continue
            seen = visible(self, curve, toward, step)
            image = paper(curve.points)
            far = np.full(len(image), np.inf) if tree is None else tree.query(image)[0]
            bare = seen & (far > NEAR * used)
            found.seen += int(seen.sum())
            found.gaps.extend((curve.name, *gap) for gap in gaps(image, bare, curve.ordered))
        for line in drawn.lines:
            if not line.visible:
                continue
            points = polyline(line.points3, 4 * step)
            angles = np.arange(8) * np.pi / 4
            ring = RING * step * (np.cos(angles)[:, None] * right + np.sin(angles)[:, None] * up)
            starts = points[:, None] + np.concatenate([np.zeros((1, 3)), ring])[None] + 2 * step * toward
            wrong = self.blocked(starts.reshape(-1, 3), toward).reshape(len(points), -1).all(axis=1)
            found.judged += len(points)
            where = line.edge if line.edge is not None else line.face
            found.wrong.extend((f"{line.kind} {where}", p) for p in paper(points[wrong]))
        return found


def is_point(curve: Curve, toward: Floats, step: float) -> bool:
    """Whether a curve is seen end-on, its image smaller than two steps: it need not be drawn."""
    flat = curve.points - np.outer(curve.points @ toward, toward)
    return bool(np.linalg.norm(flat.max(axis=0) - flat.min(axis=0)) < 2 * step)


def visible(truth: Truth, curve: Curve, toward: Floats, step: float) -> npt.NDArray[np.bool_]:
    aside = np.cross(curve.tangents, toward)
    size = np.linalg.norm(aside, axis=1)
    aside = aside / np.maximum(size, 1e-12)[:, None]
    free = np.zeros(len(aside), bool)
    for sign in (1.0, -1.0):
        clear = size > 0.02
        for k in STEPS:
            clear &= ~truth.blocked(curve.points + sign * k * step * aside, toward)
        free |= clear
    return free


def gaps(image: Floats, bare: npt.NDArray[np.bool_], ordered: bool) -> Iterator[tuple[float, Floats]]:
    """Runs of points without ink: length in mm and middle, on paper."""
    at = np.flatnonzero(bare)
    if not len(at):
        return
    if ordered:
        runs = np.split(at, np.flatnonzero(np.diff(at) > 1) + 1)
    else:
        near = cKDTree(image[at])
        reach = 3 * float(np.median(cKDTree(image).query(image, k=2)[0][:, 1])) + 1e-9
        from scipy.sparse import coo_matrix
        from scipy.sparse.csgraph import connected_components

        pairs = near.query_pairs(reach, output_type="ndarray")
        graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), (len(at), len(at)))
        _, label = connected_components(graph, directed=False)
        runs = [at[label == k] for k in range(label.max() + 1)]
    for run in runs:
        points = image[run]
        if ordered:
            length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
        else:
            length = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
        if length > 0.0:
            yield length, points[len(points) // 2]
