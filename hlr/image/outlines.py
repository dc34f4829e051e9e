"""Outlines of the true surfaces, added to an image as lines of their own before the visibility pass.

The kernel traces them and adds them (`kernel/linework/src/silhouette`). It counts what lies in front of a line on the
tessellation. The true outline runs in and out of its own facets, by up to their deflection; so it is moved outward by
a little more than that, square to the line of sight, before it is compared with them: its own facets are then beside
it and cannot hide it, while everything else still does. The corners of the triangles that it runs over are points of
the surface and tell how far: where the surface is convex, no corner stands out beyond the outline, and hardly any
lift is needed; where it is a saddle, the lift is the bulge of the facets.

::

        \\   true surface        the outline o, moved along the normal to x, has its own facets on one side
         o   x
        /|                      what bends the other way (concave along the sight) lies within its own body: hidden
       / |

An outline, and an edge whose face is seen nearly edge-on, is compared with the triangles of that face as if it lay off
the face by more than they do, on the side that is seen (`kernel/visibility/src/scan/own_faces.rs`).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Ints
from hlr.image.image import Image, Silhouettes
from hlr.request.accuracy import OUTLINE_CHORD, OUTLINE_LIFT, OUTLINE_SPARE, OWN_LIFT
from hlr.request.effect import Facts, Planner
from hlr.scene.scene import TrueSurfaces
from hlr.source.model import Curves
from hlr.tables.line_classes import INTERIOR, LINE_CLASSES, EdgeClass, goes_on, where


def outlined(image: Image, planner: Planner) -> Image:
    """The image with the outlines of its true surfaces; those faces' mesh contours are outlines no longer.

    An image that has its outlines already, and one that needs none, stays as it is.
    """
    surfaces = image.true_surfaces
    if image.silhouettes is not None:
        return image
    curved = 0 if surfaces is None else surfaces.curved_faces
    wanted = planner.on("outlines", Facts(curved=curved, faces=surfaces is not None))
    if not wanted or surfaces is None:
        return image
    with planner.timed("outlines"):
        found = _with_outlines(image, surfaces)
    planner.spent("outlines", outlines=len(found.walks) - len(image.walks))
    return found


def _with_outlines(image: Image, surfaces: TrueSurfaces) -> Image:
    face = image.all_faces()
    deflection = image.placement.tolerances.deflection
    mesh = image.mesh()
    on, found = _traced(image, mesh, surfaces, face, OUTLINE_CHORD * deflection)
    shown = _kernel.outlined(
        found,
        mesh,
        on,
        (image.edge_kind, image.edge_part, image.edge_group, image.edge_curved, image.triangle_group),
        surfaces.first,
        image.groups,
        image.convex,
        (_borders(), _tangent(), EdgeClass.OUTLINE, INTERIOR),
        image.camera.scaled(1.0),
        (OUTLINE_SPARE * deflection, OUTLINE_LIFT * deflection, OWN_LIFT * deflection),
    )
    source = found.source
    return replace(
        image,
        crossed=None,
        points=shown.points,
        edges=shown.edges,
        offsets=shown.offsets,
        edge_part=shown.part,
        edge_group=shown.group,
        edge_kind=shown.kind,
        edge_curved=shown.curved,
        silhouettes=Silhouettes(
            lift=shown.lift,
            hidden=shown.hidden,
            own=shown.own(),
            first=surfaces.first,
            number=shown.number,
            curves=Curves(found.curve_kind, found.curve_range, found.curve_offsets, found.curve_values),
            source=np.where(source >= 0, image.walks.index[source], -1).astype(np.int32),
        ),
        walks=image.walks.merged(shown.walks(EdgeClass.OUTLINE, len(image.edges))),
    )


def _traced(
    image: Image,
    mesh: _kernel.Mesh,
    surfaces: TrueSurfaces,
    face: Ints,
    chord: float,
) -> tuple[_kernel.TrueSurfaces, _kernel.Outlines]:
    """The surfaces as the kernel takes them, and the outlines that it traces on them.

    mesh: of the image; face (t,): numbered through all parts; chord: chord error, model units
    """
    kind = image.edge_kind
    on = surfaces.of(_kernel.traced_faces(mesh, face, kind, _tangent_borders(), surfaces.curved), face)
    crossed = np.zeros((0, 2), np.int32) if image.crossed is None else image.crossed
    return on, _kernel.silhouettes(mesh, on, kind, goes_on(), crossed, image.walks, image.camera.scaled(1.0), chord)


@LINE_CLASSES.derived
def _borders() -> npt.NDArray[np.bool_]:
    """(256,) by the class of an edge: it bounds faces."""
    return where(lambda row: row.border)


@LINE_CLASSES.derived
def _tangent() -> npt.NDArray[np.bool_]:
    """(256,) by the class of an edge: faces join smoothly there."""
    return where(lambda row: row.tangent)


@LINE_CLASSES.derived
def _tangent_borders() -> npt.NDArray[np.bool_]:
    """(256,) by the class of an edge: it bounds faces that join smoothly."""
    return where(lambda row: row.border and row.tangent)
