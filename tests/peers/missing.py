"""The other half of the truth: is everything drawn that is plainly to be seen?

The ray test judges lines that are there, so an empty drawing would pass it, and so would a contour that is wrongly
called hidden (half of its ring is blocked by its own body). Here the edges of the reference mesh are asked instead:
where one is sharp, a border or an outline, and free toward the viewer, a visible line has to run nearby.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from peers.exchange import Exchange
from peers.judge import RING, RayCaster
from peers.reference import Floats, Reference
from scipy.spatial import cKDTree

SHARP = np.cos(np.radians(45))
"""Well over the crease angle of 30 degrees and the turn of a tessellated fillet, so that there is no arguing."""
NEAR = 1 / 500
"""A visible line this near will do; in diagonals, like SPACING."""
SPACING = 1 / 2000
WELD = 1e-7
FREE = 3
"""Rays that must be free besides the point's own: an outline has half of its ring before its own body."""
PLACES = 5000
"""Places asked, picked at random by length; most of them will not be free."""
STEP = 1 / 200
"""Beside an outline there is no surface within this depth."""
GRAZING = 1e-3
"""Triangles nearer to edge-on than this face neither way."""


@dataclass(frozen=True)
class Missing:
    """Places that were asked, and those where no visible line was near."""

    asked: int
    places: Floats


class Edges:
    """Edges of a reference mesh with the normals on both sides; borders have the same one twice."""

    def __init__(self, reference: Reference) -> None:
        size = reference.diagonal
        _, first, number = np.unique(
            np.round(reference.points / (WELD * size)), axis=0, return_index=True, return_inverse=True
        )
        points = reference.points[first]
        corners = number.ravel()[reference.triangles]
        normals = np.cross(
            points[corners[:, 1]] - points[corners[:, 0]],
            points[corners[:, 2]] - points[corners[:, 0]],
        )
        length = np.linalg.norm(normals, axis=1)
        flat = length <= size**2 * 1e-14
        normals = normals / np.where(flat, 1.0, length)[:, None]
        sides = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
        owner = np.tile(np.arange(len(corners)), 3)
        order = np.lexsort((sides[:, 1], sides[:, 0]))
        sides, owner = sides[order], owner[order]
        starts = np.flatnonzero(np.r_[True, (sides[1:] != sides[:-1]).any(axis=1)])
        counts = np.diff(np.r_[starts, len(sides)])
        # Where three meet, or one has no area, what is an outline or a border is a matter of opinion.
        plain = (counts <= 2) & ~flat[owner[starts]] & ~flat[owner[starts + counts - 1]]
        starts, counts = starts[plain], counts[plain]
        self.start, self.end = points[sides[starts, 0]], points[sides[starts, 1]]
        self.left, self.right = normals[owner[starts]], normals[owner[starts + counts - 1]]
        self.border = counts == 1

    def sharp(self) -> np.ndarray:
        """Drawn from everywhere."""
        return np.asarray(np.sum(self.left * self.right, axis=1) < SHARP)

    def outlines(self, direction: Floats) -> np.ndarray:
        """One side turned to the viewer, the other away."""
        one, other = self.left @ direction, self.right @ direction
        return np.asarray((one * other < 0) & (np.minimum(abs(one), abs(other)) > GRAZING))


def missing(drawing: Exchange, edges: Edges, caster: RayCaster) -> Missing:
    """Orthographic views only."""
    camera, size = drawing.camera, caster.measure
    axes = np.stack([camera.right, camera.up], axis=1)
    sharp = edges.sharp()
    chosen = np.flatnonzero(sharp | edges.border | edges.outlines(camera.direction))
    start, end = edges.start[chosen], edges.end[chosen]
    length = np.linalg.norm((end - start) @ axes, axis=1)
    start, end, sharp, length = (each[length > 0] for each in (start, end, sharp[chosen], length))
    rng = np.random.default_rng(1)
    if not len(length):
        return Missing(0, np.zeros((0, 3)))
    picked = rng.choice(len(length), PLACES, p=length / length.sum())
    places = start[picked] + rng.uniform(0.0, 1.0, PLACES)[:, None] * (end - start)[picked]
    blocked = caster.blocked_each(places, camera)
    asked = ~blocked[:, 0] & (blocked.sum(axis=1) <= RING - FREE)
    # A dent of the tessellation faces away too, and faces that were never joined have borders; but beside these the
    # surface goes on.
    asked &= sharp[picked] | (caster.open_around(places, camera, size * STEP) >= FREE)
    places = places[asked]
    drawn = _dense(drawing, axes, size * SPACING)
    if not len(places) or not len(drawn):
        return Missing(len(places), places)
    distance, _ = cKDTree(drawn).query(places @ axes, distance_upper_bound=size * NEAR)
    return Missing(len(places), places[~np.isfinite(distance)])


def _dense(drawing: Exchange, axes: Floats, spacing: float) -> Floats:
    """Points all along the visible lines, on the image plane."""
    found = [np.zeros((0, 2))]
    for line in drawing.lines:
        if line.visible:
            flat = line.points3 @ axes
            along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(flat, axis=0), axis=1))]
            wanted = np.linspace(0.0, along[-1], int(along[-1] / spacing) + 2)
            found.append(np.stack([np.interp(wanted, along, flat[:, k]) for k in (0, 1)], axis=1))
    return np.concatenate(found)
