"""Visibility of drawn lines, judged by rays against a finer tessellation.

From each sample of a drawn line nine rays go toward the viewer: one from the sample, eight from a ring around it with
the accuracy as its radius. The sample is wrong only if all nine agree: it is drawn visible and all are blocked, or
drawn hidden and none is. If they disagree, a shift of less than the accuracy decides, and either answer is right. Rays
start nearer to the viewer than the sample by the contact tolerance: a surface that covers a line by less than that may
hide it or not.

::

         o o o        seen from the viewer: what covers five of nine rays
        o  x  o ####  leaves the sample undecided
         o o o #####

Rays beside a line may run into the very face on which it lies, where that rises toward the viewer. Where nine rays are
blocked, some by that face and the others by another part, the line is where the two touch, as the edge of a groove
beside the outline of a ball in it: a shift of the ball by less than the accuracy decides. Such a sample is undecided.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.drawing.chords import Index
from hlr.drawing.drawing import Drawing
from hlr.drawing.reached import Labels
from hlr.image.camera import NEAR
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.written import Written, in_model
from hlr.request.accuracy import ANGLE, MEASURED_CONTACT, MEASURED_SAMPLE, MESH_CONTACT, under

RING = 8
RISE = 20.0
"""Radii of the ring: what rises no more toward the viewer may be the face on which a line lies, up to 87 degrees."""

DISAGREE, BLOCKED, FREE = 0, 1, 2
"""The verdict of nine rays: they disagree, all are blocked, or none is."""


@dataclass(frozen=True, slots=True)
class Caster:
    """All triangles of a model, the part (t,) of each, and the nine rays' radius and starting depth for one drawing."""

    points: Floats
    triangles: Ints
    part: Ints
    paper: Paper
    radius: float
    depth: float
    nearest: float
    right: Floats
    up: Floats

    @classmethod
    def of(cls, opened: Any, drawing: Drawing, paper: Paper, deflection: float) -> Caster:
        """Mesh the model anew with `deflection` (model units) and make a Caster of that mesh."""
        parts = opened.mesh(deflection, ANGLE).parts
        first = np.cumsum([0, *(len(p.points) for p in parts[:-1])])
        view, points = drawing.view, np.concatenate([p.points for p in parts])
        depth = drawing.accuracy.contact
        if not all(p.brep for p in parts):
            # A mesh does not say with which deflection it was made, so its contact tolerance follows from its size.
            depth = max(depth, MESH_CONTACT * float(np.linalg.norm(np.ptp(points, axis=0))))
        return cls(
            points=points,
            triangles=np.concatenate([p.triangles + np.int32(f) for p, f in zip(parts, first, strict=True)]),
            part=np.repeat(np.arange(len(parts), dtype=np.int32), [len(p.triangles) for p in parts]),
            paper=paper,
            radius=drawing.accuracy.used,
            depth=depth,
            nearest=NEAR * (view.distance or 0.0),
            right=np.array(view.right),
            up=np.array(view.up),
        )

    def verdict(self, points: Floats) -> npt.NDArray[np.int8]:
        """(n,) verdict of the nine rays on points (n, 3) of the model: DISAGREE, BLOCKED or FREE."""
        count = self._of_ring(points, self.depth).sum(axis=1)
        return np.where(count == RING + 1, BLOCKED, np.where(count == 0, FREE, DISAGREE)).astype(np.int8)

    def blocked_surely(self, points: Floats, part: Ints) -> npt.NDArray[np.bool_]:
        """(n,) whether all nine rays from points (n, 3) are blocked, and not by the face of a line and another part.

        part (n,): of the line at each point, whose face may rise toward the viewer right beside it
        """
        surely = np.zeros(len(points), bool)
        rise = np.maximum(self.depth, RISE * self.radius / self.paper.magnified(points))
        for own in np.unique(part).tolist():
            here = np.flatnonzero(part == own)
            by_own, by_others = self._of(self.part == own), self._of(self.part != own)
            near = by_own._of_ring(points[here], self.depth)
            far = by_own._of_ring(points[here], rise[here]) | by_others._of_ring(points[here], self.depth)
            surely[here] = near.all(axis=1) | far.all(axis=1)
        return surely

    def _of(self, chosen: npt.NDArray[np.bool_]) -> Caster:
        """The same for some of the triangles."""
        return replace(self, triangles=self.triangles[chosen], part=self.part[chosen])

    def _of_ring(self, points: Floats, depth: float | Floats) -> npt.NDArray[np.bool_]:
        """(n, 9) which of the nine rays from points (n, 3), moved toward the viewer by `depth`, meet anything."""
        angle = np.arange(RING) * (2.0 * np.pi / RING)
        ring = np.concatenate(
            [np.zeros((1, 3)), np.outer(np.cos(angle), self.right) + np.outer(np.sin(angle), self.up)]
        )
        radius = self.radius / self.paper.magnified(points)
        starts = points[:, None, :] + ring[None] * radius[:, None, None]
        return self._blocked(points, starts, depth)

    def touched(self, points: Floats) -> npt.NDArray[np.bool_]:
        """(n,) whether anything covers points (n, 3), even by less than the contact tolerance."""
        return self._blocked(points, points[:, None, :], MEASURED_CONTACT * self.depth)[:, 0]

    def _blocked(self, points: Floats, starts: Floats, depth: float | Floats) -> npt.NDArray[np.bool_]:
        """(n, k) whether rays from starts (n, k, 3), moved toward the viewer by `depth`, one or (n,), meet anything."""
        if not len(self.triangles):
            return np.zeros(starts.shape[:2], bool)
        sight = self.paper.sight(points)
        unit = sight / np.linalg.norm(sight, axis=1)[:, None]
        starts = starts + (unit * np.reshape(depth, (-1, 1)))[:, None, :]
        if self.paper.eye is None:
            reach = np.ptp(self.points, axis=0).sum() * 2.0
            ways = np.broadcast_to(unit[:, None, :] * reach, starts.shape)
        else:
            # Rays end at the near plane: nothing between it and the eye is drawn.
            ways = self.paper.eye - starts
            ahead = np.abs(ways @ self.paper.toward)
            ways = ways * np.clip(1.0 - self.nearest / np.maximum(ahead, 1e-300), 0.0, 1.0)[:, :, None]
        hit = _kernel.blocked(
            self.points,
            np.ascontiguousarray(self.triangles),
            np.ascontiguousarray(starts.reshape(-1, 3)),
            np.ascontiguousarray(ways.reshape(-1, 3)),
        )
        return np.asarray(hit.reshape(starts.shape[:2]))


def labels(drawing: Drawing, drawn: Written, caster: Caster, samples: int) -> Labels:
    """The share of line samples that rays contradict, and the longest stretch of them in mm on paper."""
    accuracy = drawing.accuracy.used
    segments, _ = drawn.steps()
    length = float(np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1]).sum())
    if length == 0.0:
        return Labels(None, why="the drawing has no lines")
    step = max(accuracy, length / samples)
    points, line = drawn.middles(step)
    wrong = contradicted(drawing, drawn, points, line, caster)
    if not wrong.any():
        return Labels(0.0, 0.0, length)
    # The length of each stretch, from samples that now lie close together along its whole line.
    bad = np.unique(line[wrong])
    near = Written(drawn.points[np.isin(drawn.line, bad)], drawn.line[np.isin(drawn.line, bad)])
    dense = max(MEASURED_SAMPLE * accuracy, step / 64.0)
    points, line = near.middles(dense)
    close = _within(points, line, *_picked(drawn, step, wrong), 4.0 * step)
    points, line = points[close], line[close]
    again = contradicted(drawing, drawn, points, line, caster)
    where, longest = longest_run(points, line, again, dense)
    name = None
    if where is not None:
        of = drawing.lines[int(line[where])]
        x, y = points[where]
        name = f"{drawing.parts[of.part].name}, {of.kind} {'visible' if of.visible else 'hidden'} at {x:.2f},{y:.2f}"
    return Labels(float(wrong.mean()), longest, length, where=name)


def contradicted(
    drawing: Drawing, drawn: Written, points: Floats, line: Index, caster: Caster
) -> npt.NDArray[np.bool_]:
    """(n,) whether nine rays agree that points (n, 2) of lines are drawn with the wrong visibility.

    A hidden line under the ink of a visible line of `drawn` cannot be seen, and is never wrong.
    """
    at = in_model(drawing, points, line)
    said = caster.verdict(at)
    visible = np.array([x.visible for x in drawing.lines], bool)[line]
    wrong = np.asarray(np.where(visible, said == BLOCKED, said == FREE))
    covered = np.flatnonzero(wrong & visible)
    part = np.array([x.part for x in drawing.lines], np.int32)[line]
    wrong[covered] = caster.blocked_surely(at[covered], part[covered])
    # A line covered by less than the contact tolerance may be drawn either way.
    doubtful = np.flatnonzero(wrong & ~visible)
    wrong[doubtful] &= ~caster.touched(at[doubtful])
    hidden = np.flatnonzero(wrong & ~visible)
    if len(hidden):
        segments, owner = drawn.steps()
        ink = segments[np.array([x.visible for x in drawing.lines], bool)[owner]]
        of, none = np.zeros(len(hidden), np.int32), np.zeros(len(ink), np.int32)
        most = under(drawing.accuracy.used)
        near = np.ascontiguousarray(points[hidden])
        off, _ = _kernel.nearest(near, of, np.ascontiguousarray(ink), none, most)
        wrong[hidden] &= ~np.isfinite(off)
    return wrong


def longest_run(points: Floats, line: Index, chosen: npt.NDArray[np.bool_], step: float) -> tuple[int | None, float]:
    """Index of the first point of the longest stretch of chosen points, and its length; `step` is their distance."""
    starts, lengths = runs(points, line, chosen, step)
    if len(starts) == 0:
        return None, 0.0
    best = int(np.argmax(lengths))
    return int(starts[best]), float(lengths[best])


def runs(points: Floats, line: Index, chosen: npt.NDArray[np.bool_], step: float) -> tuple[Index, Floats]:
    """Stretches of neighbouring chosen points on one line: index of the first point of each, and its length."""
    which = np.flatnonzero(chosen)
    if len(which) == 0:
        return np.zeros(0, np.int64), np.zeros(0)
    gap = points[which[1:]] - points[which[:-1]]
    far = np.hypot(gap[:, 0], gap[:, 1])
    new = np.append(True, (np.diff(which) > 1) | (np.diff(line[which]) != 0) | (far > 2.0 * step))
    number = np.cumsum(new) - 1
    lengths = np.bincount(number, minlength=number[-1] + 1).astype(float) * step
    along = np.bincount(number[1:], weights=np.where(new[1:], 0.0, far), minlength=number[-1] + 1)
    return which[new], np.minimum(lengths, along + step)


def _picked(drawn: Written, step: float, wrong: npt.NDArray[np.bool_]) -> tuple[Floats, Index]:
    points, line = drawn.middles(step)
    return points[wrong], line[wrong]


def _within(points: Floats, line: Index, seeds: Floats, seed_line: Index, most: float) -> npt.NDArray[np.bool_]:
    """(n,) whether there is a seed on the same line within the distance `most`."""
    dots = np.concatenate([seeds, seeds], axis=1)
    own, theirs = line.astype(np.int32), seed_line.astype(np.int32)
    far, _ = _kernel.nearest(np.ascontiguousarray(points), own, np.ascontiguousarray(dots), theirs, most)
    return np.isfinite(far)
