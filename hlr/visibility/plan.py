"""What an image and a request call for: which edges are drawn, where culling is safe, what needs tolerance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats
from hlr.image.camera import NEAR
from hlr.image.image import Image
from hlr.request.accuracy import CONTACT_SPARE, MOST_LIFT, Tolerances
from hlr.request.drawing_effects import LEGIBILITY
from hlr.request.effect import Facts, Planner
from hlr.request.options import Options
from hlr.scene.groups import contact_depths
from hlr.tables.line_classes import by_number, counted, goes_on

DRAWN = 1
OUTLINE = 2


@dataclass(frozen=True, slots=True)
class Plan:
    """The kernel's instructions.

    role    (e,) uint8: DRAWN, OUTLINE (drawn where it is a contour), both, or 0
    cull    (g,) bool: faces turned away from the viewer are skipped
    sound   (g,) bool: the group does not pass through itself, and is not searched for places where it does
    delta   (g,) float64: contact tolerance in view depth: what is hidden by less counts as touching
    cap     (g,) float64: upper limit of the tolerance against this group: half its thickness, in view depth
    drawn_kind  of each line class, whether source edges of that class are drawn as such
    step    radians: a crease of a mesh is drawn as a circle where its vertices are less than this apart; 0: never
    fill    visible faces are painted
    contact whether the contact tolerance applies
    divide  points are divided by their distance from the eye
    crossings, piercings, pyramid: which steps the visibility pass takes
    straight (c,) bool: per chain of the scene: it runs between two planes, so it has no curve to look up
    every_curve  all curves are looked up all the same, to measure what that costs
    """

    role: npt.NDArray[np.uint8]
    cull: npt.NDArray[np.bool_]
    sound: npt.NDArray[np.bool_]
    delta: Floats
    cap: Floats
    drawn_kind: list[bool]
    step: float
    fill: bool
    contact: bool
    divide: bool
    crossings: bool
    piercings: bool
    pyramid: bool
    straight: npt.NDArray[np.bool_]
    every_curve: bool


MOST_STEP = 45.0
"""Degrees between neighbouring vertices of a circle: an octagon is never one."""


def decide(image: Image, options: Options, planner: Planner) -> Plan:
    """Instructions for one view of a scene; planner: knows what was decided before."""
    tolerances = image.placement.tolerances
    # roles[edge_curved, edge_kind]: where a curved surface goes on across an edge, it may fold over there.
    roles = np.zeros((2, 256), np.uint8)
    roles[1, goes_on()] = OUTLINE
    drawn_kind = [row.drawn(options) for row in by_number()]
    roles[:, : len(drawn_kind)] |= DRAWN * np.array(drawn_kind, np.uint8)
    role = _kernel.edge_roles(image.edge_curved, image.edge_kind, roles.ravel())
    if image.silhouettes is not None:
        role[image.silhouettes.hidden] = 0
    delta, cap = _contact(image, tolerances)
    groups, used = image.groups, np.isfinite(image.groups.low[:, 0])
    faced = np.zeros(len(used), bool)
    faced[image.triangle_group] = True
    with planner.deciding():
        near = _coming_near(image, delta, MOST_LIFT * tolerances.deflection)
    facts = Facts(
        groups=int(np.count_nonzero(faced)),
        culled=int(np.count_nonzero(groups.cull)),
        convex=image.convex,
        perspective=image.camera.eye is not None,
        meeting=near,
        unsound=int(np.count_nonzero(used & ~groups.sound)),
        edges=int(np.count_nonzero(role)),
    )
    loose = Facts(meeting=near, unsound=int(np.count_nonzero(used & ~groups.sound & ~groups.cull)))
    straight = image.chains.straight
    view = Facts(pictorial=image.camera.pictorial)
    for name in ("hidden lines", *(row.title for row in counted()), "circles of meshes", "colours"):
        planner.on(name, view)
    planner.on("back-face culling", facts)
    planner.on(LEGIBILITY)
    touch = planner.on("contact tolerance", loose)
    sought = int(np.count_nonzero(~straight & (image.chains.index >= 0)))
    sought += 0 if image.silhouettes is None else len(image.silhouettes.curves.kind)
    every = planner.on("exact curves", Facts(bent=sought))
    return Plan(
        role=role,
        cull=image.groups.cull,
        sound=image.groups.sound,
        delta=delta,
        cap=cap,
        contact=touch,
        drawn_kind=drawn_kind,
        # Where the surface folds by more than the crease angle, an edge is drawn, and the figure has corners.
        step=math.radians(min(options.crease, MOST_STEP)) if options.circles else 0.0,
        fill=planner.on("fill"),
        divide=planner.on("perspective divide", facts),
        crossings=planner.on("crossing search", facts),
        piercings=planner.on("piercing search", facts),
        pyramid=planner.on("depth pyramid", facts),
        straight=straight,
        every_curve=every and planner.forced,
    )


def _coming_near(image: Image, delta: Floats, lift: float) -> int:
    """How many groups come within the contact tolerance of another: their boxes, grown by it, meet.

    The boxes lie along the model's axes in parallel views, where depth is a distance. In perspective it is not: there
    they are boxes around the images of the corners. lift: how far lines may be off their surfaces, model units.
    """
    groups, camera = image.groups, image.camera
    used = np.isfinite(groups.low[:, 0]).nonzero()[0]
    if len(used) < 2:
        return 0
    low, high = groups.low[used] - lift, groups.high[used] + lift
    most = CONTACT_SPARE * float(delta[used].max(initial=0.0))
    if camera.eye is None or camera.distance is None:
        return int(np.count_nonzero(_kernel.boxes_meet(low - 0.5 * most, high + 0.5 * most)))
    box = (low, high)
    corners = [
        np.stack([box[i][:, 0], box[j][:, 1], box[k][:, 2]], axis=1) for i in (0, 1) for j in (0, 1) for k in (0, 1)
    ]
    if min(float(camera.ahead(c).min(initial=np.inf)) for c in corners) <= NEAR * camera.distance:
        return len(used)
    seen = np.stack([camera.project(c) for c in corners])
    step = np.array([0.0, 0.0, 0.5 * most])
    return int(np.count_nonzero(_kernel.boxes_meet(seen.min(axis=0) - step, seen.max(axis=0) + step)))


def _contact(image: Image, tolerances: Tolerances) -> tuple[Floats, Floats]:
    """(g,) contact tolerance of each group, and (g,) its upper limit, both in view depth."""
    groups, camera = image.groups, image.camera
    delta = contact_depths(groups, tolerances.contact, tolerances.contact_planar)
    delta = np.where(groups.tight, tolerances.rounding, delta)
    used: npt.NDArray[np.bool_] = np.isfinite(groups.low[:, 0])
    # Half a part's thickness at most, or the far side of a thin sheet would show through. An open sheet may have no
    # thickness: it gets at least the rounding of its file.
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
