"""The windows on paper that cut a drawing: a frame with four sides, and a circle.

Both know the point of the model that belongs to a point on paper.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from hlr.drawing.drawing import DrawnView
from hlr.drawing.line import Bounds
from hlr.window.tracks import Track

Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]

SLACK = 1e-6
"""Millimetres: what lies beyond the border by less than this lies on it. A line along a side is drawn, whatever the
last digit of its coordinates."""


class Window(Protocol):
    """What lines are cut at."""

    def apart(self, boxes: Floats) -> tuple[Bools, Bools]:
        """Of boxes (n, 4), low and high corner: which lie wholly inside, and which wholly outside."""

    def crossings(self, track: Track) -> list[Floats]:
        """Parameters where a line crosses the border; those where it only touches may be among them."""

    def holds(self, places: Floats) -> Bools:
        """Which of the places (n, 2) lie inside."""

    def onto(self, place: Floats) -> Floats:
        """A place (2,) that is a crossing, but for its last digits, on the border itself."""

    def within(self, places: Floats) -> Floats:
        """Places (n, 2) that lie inside, but for their last digits, wholly inside."""

    def to_model(self, u: Floats, v: Floats, share: float, off: Floats) -> Floats:
        """As of `Seen`."""


@dataclass(frozen=True, slots=True)
class Seen:
    """How the model is seen on paper. per_model: millimetres on paper per model unit."""

    view: DrawnView
    per_model: float

    def to_model(self, u: Floats, v: Floats, share: float, off: Floats) -> Floats:
        """The point of the model that is seen at `share` of the way from u to v on paper, and `off` from there.

        u, v (3,) model coordinates; off (2,) millimetres on paper. In perspective the middle on paper is not the middle
        in space: nearer lengths look longer.
        """
        view, along = self.view, share
        if view.eye is not None:
            ahead = [self._ahead(each) for each in (u, v)]
            along = share * ahead[0] / (share * ahead[0] + (1.0 - share) * ahead[1])
        point = u + (v - u) * along
        if off.any():
            per = self.per_model
            if view.distance is not None:
                per *= view.distance / self._ahead(point)
            point = point + (off[0] * np.array(view.right) + off[1] * np.array(view.up)) / per
        return np.asarray(point)

    def _ahead(self, point: Floats) -> float:
        """Distance in front of the eye, along the view, model units."""
        return -float((point - np.array(self.view.eye)) @ np.array(self.view.direction))


@dataclass(frozen=True, slots=True)
class Frame(Seen):
    """A window with four sides: millimetres on paper, in the drawing's coordinates."""

    window: Bounds

    def apart(self, boxes: Floats) -> tuple[Bools, Bools]:
        """As of `Window`."""
        low, high = self._corners()
        inside = np.all((boxes[:, :2] >= low - SLACK) & (boxes[:, 2:] <= high + SLACK), axis=1)
        return inside, np.any((boxes[:, 2:] < low - SLACK) | (boxes[:, :2] > high + SLACK), axis=1)

    def crossings(self, track: Track) -> list[Floats]:
        """As of `Window`."""
        return [track.crossings(*side) for side in self._sides()]

    def holds(self, places: Floats) -> Bools:
        """As of `Window`."""
        low, high = self._corners()
        return np.asarray(np.all((places >= low - SLACK) & (places <= high + SLACK), axis=1))

    def onto(self, place: Floats) -> Floats:
        """As of `Window`."""
        for axis, value in self._sides():
            if abs(place[axis] - value) <= 1e-9 * (1.0 + abs(value)):
                place[axis] = value
        return place

    def within(self, places: Floats) -> Floats:
        """As of `Window`."""
        return np.clip(places, *self._corners())

    def _corners(self) -> tuple[Floats, Floats]:
        """(2,) the lower left corner and the upper right one."""
        return np.array(self.window[:2]), np.array(self.window[2:])

    def _sides(self) -> tuple[tuple[int, float], ...]:
        """(axis, value): left, right, bottom, top."""
        w = self.window
        return (0, w.x0), (0, w.x1), (1, w.y0), (1, w.y1)


@dataclass(frozen=True, slots=True)
class Circle(Seen):
    """A round window. middle: x and y; radius: millimetres on paper."""

    middle: tuple[float, float]
    radius: float

    def apart(self, boxes: Floats) -> tuple[Bools, Bools]:
        """As of `Window`."""
        low, high = boxes[:, :2] - self.middle, boxes[:, 2:] - self.middle
        farthest = np.hypot(*np.maximum(np.abs(low), np.abs(high)).T)
        nearest = np.hypot(*np.maximum(np.maximum(low, -high), 0.0).T)
        return farthest <= self.radius + SLACK, nearest > self.radius + SLACK

    def crossings(self, track: Track) -> list[Floats]:
        """As of `Window`."""
        return [track.round_crossings(np.array(self.middle), self.radius)]

    def holds(self, places: Floats) -> Bools:
        """As of `Window`."""
        return np.asarray(np.hypot(*(places - self.middle).T) <= self.radius + SLACK)

    def onto(self, place: Floats) -> Floats:
        """As of `Window`."""
        way = place - self.middle
        return np.asarray(self.middle + way * (self.radius / max(float(np.hypot(*way)), 1e-300)))

    def within(self, places: Floats) -> Floats:
        """As of `Window`."""
        way = places - self.middle
        far = np.maximum(np.hypot(*way.T), 1e-300)[:, None]
        return np.where(far > self.radius, self.middle + way * (self.radius / far), places)
