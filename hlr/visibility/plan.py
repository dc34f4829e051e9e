"""What an image and a request call for: which edges are drawn, where culling is safe, what needs tolerance."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hlr import _kernel
from hlr.image.image import Image
from hlr.request.accuracy import CONTACT_SPARE, MESH_CONTACT, MOST_LIFT
from hlr.request.drawing_effects import LEGIBILITY
from hlr.request.effect import Facts, Planner
from hlr.request.options import Options
from hlr.tables.line_classes import by_number, counted, goes_on

DRAWN, OUTLINE = 1, 2
"""Roles of an edge: drawn; drawn where it is a contour of the mesh."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What the stages after it are told.

    visibility_input  for the kernel: the role of each edge (DRAWN, OUTLINE, both, or 0), and how near to each group
                      counts as touching it
    step              radians: a crease of a mesh is drawn as a circle where its vertices are less than this apart; 0:
                      never
    fill              visible faces are painted
    contact           whether the contact tolerance applies
    divide            points are divided by their distance from the eye
    crossings, piercings, pyramid: which steps the visibility pass takes
    every_curve       all curves are looked up, needed or not, to measure what that costs
    """

    visibility_input: _kernel.VisibilityInput
    step: float
    fill: bool
    contact: bool
    divide: bool
    crossings: bool
    piercings: bool
    pyramid: bool
    every_curve: bool


MOST_STEP = 45.0
"""Degrees between neighbouring vertices of a circle: an octagon is never one."""


def decide(image: Image, options: Options, planner: Planner) -> Plan:
    """Instructions for one view of a scene; planner: knows what was decided before."""
    tolerances = image.placement.tolerances
    visibility_input = _kernel.VisibilityInput(
        image.groups,
        image.triangle_group,
        image.edge_group,
        image.edge_curved,
        image.edge_kind,
        None if image.silhouettes is None else image.silhouettes.hidden,
        goes_on(),
        [row.drawn(options) for row in by_number()],
        image.camera.scaled(1.0),
        (tolerances.contact, tolerances.contact_planar, MESH_CONTACT),
        tolerances.rounding,
    )
    counts = visibility_input.counts()
    with planner.deciding():
        near = visibility_input.coming_near(MOST_LIFT * tolerances.deflection, CONTACT_SPARE)
    facts = Facts(
        groups=counts.faced,
        culled=counts.culled,
        convex=image.convex,
        perspective=image.camera.eye is not None,
        meeting=near,
        unsound=counts.unsound,
        edges=counts.edges,
    )
    loose = Facts(meeting=near, unsound=counts.unsound_not_culled)
    view = Facts(pictorial=image.camera.pictorial)
    planner.state(view, "hidden lines", *[row.title for row in counted()], "circles of meshes", "colours", LEGIBILITY)
    planner.state(facts, "back-face culling")
    touch = planner.on("contact tolerance", loose)
    sought = image.walks.bent()
    sought += 0 if image.silhouettes is None else len(image.silhouettes.curves.kind)
    every = planner.on("exact curves", Facts(bent=sought))
    return Plan(
        visibility_input=visibility_input,
        contact=touch,
        # Where the surface folds by more than the crease angle, an edge is drawn, and the figure has corners.
        step=math.radians(min(options.crease, MOST_STEP)) if options.circles else 0.0,
        fill=planner.on("fill"),
        divide=planner.on("perspective divide", facts),
        crossings=planner.on("crossing search", facts),
        piercings=planner.on("piercing search", facts),
        pyramid=planner.on("depth pyramid", facts),
        every_curve=every and planner.forced,
    )
