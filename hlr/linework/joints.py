"""Joints: where parts before the plane of a section rest on faces of parts behind it, both on the plane.

A hair before the plane the one part is cut, a hair behind it the other: such faces are hatched, as far as they are
covered, though the plane goes through neither part.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hlr.common.types import Floats
from hlr.linework.hatch_strokes import inside
from hlr.linework.hatching import Pattern, hatched, sides_of

PROBES = 50.0
"""Lines across a face by which it is found whether anything covers it."""


def is_covered(loops: Sequence[Floats], cover: Floats) -> bool:
    """Whether some of a face is covered; loops (k, 2): its border; cover (m, 2, 2): sides of what may lie on it."""
    if not len(cover):
        return False
    points = np.concatenate(list(loops))
    size = float(np.hypot(*(points.max(axis=0) - points.min(axis=0))))
    if size <= 0.0:
        return False
    found = covered(hatched(loops, Pattern(35.0, size / PROBES), 0.0), cover)
    return bool(np.hypot(*(found[:, 1] - found[:, 0]).T).sum() > size / PROBES)


def covered(strokes: Floats, cover: Floats) -> Floats:
    """What of strokes (n, 2, 2) is covered: (k, 2, 2). cover (m, 2, 2): sides of loops, anticlockwise, mm on paper."""
    return inside(strokes, cover, winding=True)


def joint_borders(loops: Sequence[Floats], cover: Sequence[Floats], near: float) -> list[Floats]:
    """The borders (n, 2) of what covers a face inside it, as lines as long as can be, without what lies on its border.

    loops, cover (k, 2): borders of the face, and of what lies on it; near: of its border, mm
    """
    sides = sides_of(loops)
    found: list[list[Floats]] = []
    for loop in cover:
        lines: list[list[Floats]] = []
        for side in sides_of([loop]):
            for a, b in inside(_split(side, sides[:, 0], near), sides, winding=True):
                if _distance(0.5 * (a + b), sides) <= near:
                    continue
                if lines and np.hypot(*(lines[-1][-1] - a)) <= 1e-9:
                    lines[-1].append(b)
                else:
                    lines.append([a, b])
        if len(lines) > 1 and np.hypot(*(lines[-1][-1] - lines[0][0])) <= 1e-9:
            lines[0] = [*lines.pop(), *lines[0][1:]]
        found += lines
    return [np.array(line) for line in found]


def _split(side: Floats, corners: Floats, near: float) -> Floats:
    """A side (2, 2) as pieces (k, 2, 2) that end at the corners (n, 2) on it: from there it may go along a border."""
    way = side[1] - side[0]
    along = (corners - side[0]) @ way / max(float(way @ way), 1e-300)
    off = np.hypot(*(corners - side[0] - along[:, None] * way).T)
    at = np.unique(np.concatenate([[0.0, 1.0], along[(off <= near) & (along > 0.0) & (along < 1.0)]]))
    points = side[0] + at[:, None] * way
    return np.stack([points[:-1], points[1:]], axis=1)


def _distance(point: Floats, sides: Floats) -> float:
    start, way = sides[:, 0], sides[:, 1] - sides[:, 0]
    along = np.clip(((point - start) * way).sum(axis=1) / np.maximum((way * way).sum(axis=1), 1e-300), 0.0, 1.0)
    return float(np.hypot(*(point - start - along[:, None] * way).T).min())
