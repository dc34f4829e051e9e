"""What this scene and this request call for: which edges are drawn, where culling is safe, what needs tolerance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.plan.options import Options
from hlr.scene.groups import touching
from hlr.scene.scene import INTERIOR, Scene
from hlr.source.model import EdgeClass, Floats
from hlr.tolerance import Tolerances
from hlr.view.camera import Camera

DRAWN = 1
OUTLINE = 2


@dataclass(frozen=True, slots=True)
class Plan:
    """The kernel's instructions.

    role    (e,) uint8: DRAWN, OUTLINE (drawn where it is a contour), both, or 0
    cull    (g,) bool: faces turned away are not looked at
    sound   (g,) bool: no piercing search of a group against itself
    delta   (g,) float64: contact tolerance in view depth
    cap     (g,) float64: the most that is allowed against this group: half its thickness, in view depth
    drawn_kind (6,) bool: per EdgeClass, whether source edges of that class are drawn as such
    step    radians: creases of meshes are circles where neighbouring vertices are less than this apart; 0: never
    """

    role: npt.NDArray[np.uint8]
    cull: npt.NDArray[np.bool_]
    sound: npt.NDArray[np.bool_]
    delta: Floats
    cap: Floats
    drawn_kind: npt.NDArray[np.bool_]
    step: float


MOST_STEP = 45.0
"""Degrees between neighbouring vertices of a circle: an octagon is never one."""


def decide(scene: Scene, camera: Camera, options: Options, tolerances: Tolerances) -> Plan:
    """Instructions for one view of a scene."""
    kind = scene.edge_kind
    role = np.zeros(len(kind), np.uint8)
    drawn_kind = np.zeros(len(EdgeClass), bool)
    drawn_kind[[EdgeClass.SHARP, EdgeClass.BOUNDARY, EdgeClass.OUTLINE]] = True
    drawn_kind[EdgeClass.SMOOTH] = options.smooth
    drawn_kind[EdgeClass.SEAM] = options.seam
    drawn_kind[EdgeClass.INTERSECTION] = options.intersections
    tied = kind != INTERIOR
    role[tied] = np.where(drawn_kind[kind[tied]], DRAWN, 0)
    may_fold = scene.edge_curved & ((kind == INTERIOR) | (kind == EdgeClass.SMOOTH) | (kind == EdgeClass.SEAM))
    role[may_fold] |= OUTLINE
    if scene.silhouettes is not None:
        role[scene.silhouettes.hidden] = 0
    delta, cap = _contact(scene, camera, tolerances)
    return Plan(
        role=role,
        cull=scene.groups.cull,
        sound=scene.groups.sound,
        delta=delta,
        cap=cap,
        drawn_kind=drawn_kind,
        # Where the surface folds by more than the crease angle, an edge is drawn, and the figure has corners.
        step=math.radians(min(options.crease, MOST_STEP)) if options.circles else 0.0,
    )


def _contact(scene: Scene, camera: Camera, tolerances: Tolerances) -> tuple[Floats, Floats]:
    groups = scene.groups
    delta = touching(groups, tolerances.contact, tolerances.contact_planar)
    delta = np.where(groups.tight, tolerances.rounding, delta)
    used: npt.NDArray[np.bool_] = np.isfinite(groups.low[:, 0])
    # Half a part's thickness at most, or the far side of a thin sheet would show through. An open sheet has none: only
    # what a file rounds is forgiven there.
    cap = np.where(groups.closed, 0.5 * groups.extent, np.maximum(0.5 * groups.extent, tolerances.rounding))
    if camera.eye is None or camera.distance is None:
        return delta, cap
    # Depth in perspective is -distance^2 / z. Its slope at the group's centre, or, where the group surrounds the eye,
    # halfway to its far end: a slope taken near the eye would let everything beyond show through.
    corners = [groups.low, groups.high]
    reach = [
        np.where(used.reshape(-1, 1), np.stack([corners[i][:, 0], corners[j][:, 1], corners[k][:, 2]], axis=1), 0.0)
        for i in (0, 1)
        for j in (0, 1)
        for k in (0, 1)
    ]
    ahead = np.stack([camera.ahead(c) for c in reach])
    z = np.maximum(np.maximum(ahead.mean(axis=0), 0.5 * ahead.max(axis=0)), camera.distance * 1e-3)
    slope = camera.distance / z
    return np.asarray(delta * slope * slope), np.asarray(cap * slope * slope)
