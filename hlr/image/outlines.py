"""Outlines of the true surfaces, added to an image as lines of their own before the visibility pass.

The kernel counts what lies in front of a line on the tessellation. The true outline runs in and out of its own facets,
by up to their deflection; so it is moved outward by a little more than that, square to the line of sight, before it is
compared with them: its own facets are then beside it and cannot hide it, while everything else still does. The corners
of the triangles that it runs over are points of the surface and tell how far: where the surface is convex, no corner
stands out beyond the outline, and hardly any lift is needed; where it is a saddle, the lift is the bulge of the facets.

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
from hlr.common.types import Floats, Ints
from hlr.image.image import Image, OwnFaces, Silhouettes
from hlr.image.own_faces import Grazing, with_own_faces
from hlr.request.accuracy import OUTLINE_CHORD, OUTLINE_LIFT, OUTLINE_SPARE, OWN_LIFT
from hlr.request.effect import Facts, Planner
from hlr.scene.chains import merge_chains
from hlr.scene.scene import Chains, TrueSurfaces
from hlr.source.model import Curves
from hlr.tables.line_classes import EdgeClass, goes_on, where


def outlined(image: Image, threads: int, planner: Planner) -> Image:
    """The image with the outlines of its true surfaces; those faces' mesh contours are outlines no longer.

    An image that has its outlines already, and one that needs none, stays as it is.
    """
    surfaces = image.true_surfaces
    if image.silhouettes is not None:
        return image
    curved = 0 if surfaces is None else int(np.count_nonzero(surfaces.curved))
    wanted = planner.on("outlines", Facts(curved=curved, faces=surfaces is not None))
    if not wanted or surfaces is None:
        return image
    with planner.timed("outlines"):
        found = _with_outlines(image, surfaces, threads)
    planner.spent("outlines", outlines=len(found.chains.kind) - len(image.chains.kind))
    return found


def _with_outlines(image: Image, surfaces: TrueSurfaces, threads: int) -> Image:
    face = image.all_faces()
    smooth = goes_on()[image.edge_kind]
    deflection = image.placement.tolerances.deflection
    found = _traced(image, surfaces, face, smooth, OUTLINE_CHORD * deflection, threads)
    image = replace(image, edge_curved=_untraced(image, face, found.traced & surfaces.curved))
    return _with_lines(image, surfaces, found, deflection)


def _traced(
    image: Image,
    surfaces: TrueSurfaces,
    face: Ints,
    smooth: npt.NDArray[np.bool_],
    chord: float,
    threads: int,
) -> _kernel.Outlines:
    """The outlines as the kernel traces them.

    face (t,): numbered through all parts; smooth (e,) bool: the surface goes on; chord: chord error, model units
    """
    wanted = surfaces.curved.copy()
    # Planar faces that a curved face joins smoothly are traced as well: the curved face may fold over against them.
    bent = where(lambda row: row.border and row.tangent)[image.edge_kind]
    bent[: len(bent)] &= np.diff(image.offsets) == 2
    first = image.offsets[:-1][bent]
    one, two = face[image.incident[first]], face[image.incident[first + 1]]
    wanted[one[surfaces.curved[two]]] = True
    wanted[two[surfaces.curved[one]]] = True
    # Where several chains share a mesh edge, any of them gives the curve of the fold.
    source = np.full(len(image.edges), -1, np.int32)
    tied = np.flatnonzero(image.chains.index >= 0)
    count = np.diff(image.chains.offsets)
    of_chain = np.full(len(count), -1, np.int32)
    of_chain[tied] = tied
    source[image.chains.edges] = np.repeat(of_chain, count)
    return _kernel.silhouettes(
        image.mesh(), surfaces.of(wanted, face), smooth, source, image.camera.scaled(1.0), chord, threads=threads
    )


def _untraced(image: Image, face: Ints, traced: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """(e,) bool: edges at which a mesh contour is still an outline, because no face there has been traced."""
    known = np.zeros(len(image.edges), bool)
    faced = np.diff(image.offsets) > 0
    if len(image.incident):
        known[faced] = np.logical_or.reduceat(traced[face][image.incident], image.offsets[:-1][faced])
    # A traced face has its own outline: mesh edges, also those beside a planar face, no longer stand for it.
    return image.edge_curved & ~known


def _with_lines(image: Image, surfaces: TrueSurfaces, found: _kernel.Outlines, deflection: float) -> Image:
    offsets, face, source = found.offsets, found.face, found.source
    n, m = len(image.points), len(offsets) - 1
    count = np.diff(offsets)
    # Each pair of neighbouring points of one outline becomes an edge.
    inner = np.ones(len(found.points), bool)
    inner[offsets[1:] - 1] = False
    start = np.flatnonzero(inner).astype(np.int32)
    line = np.repeat(np.arange(m, dtype=np.int32), count)[start]
    lines = np.stack([start + n, start + n + 1], axis=1).astype(np.int32)
    part = (np.searchsorted(surfaces.first, face, side="right") - 1).astype(np.int32)
    # All triangles of a face are in one group.
    group_of_face = np.zeros(len(surfaces.number), np.int32)
    group_of_face[surfaces.first[image.triangle_part] + image.triangle_face] = image.triangle_group
    group = group_of_face[face]
    inside_out = np.repeat(found.concave & ~image.groups.cull[group], count)
    outward = np.where(inside_out, -1.0, 1.0)[:, None] * found.normals
    distance = _lift(found.rise, deflection)
    lift = outward * distance[:, None]
    walks = Chains(
        offsets=(offsets - np.arange(m + 1)).astype(np.int32),
        edges=np.arange(len(lines), dtype=np.int32) + np.int32(len(image.edges)),
        reversed=np.zeros(len(lines), bool),
        kind=np.full(m, EdgeClass.OUTLINE, np.uint8),
        part=part,
        index=np.full(m, -1, np.int32),
        other=np.full(m, -1, np.int32),
        face=(face - surfaces.first[part]).astype(np.int32),
        straight=np.zeros(m, bool),
    )
    hidden = np.asarray(found.concave & image.groups.cull[group])
    shown = replace(
        image,
        points=np.concatenate([image.points, found.points]),
        edges=np.ascontiguousarray(np.concatenate([image.edges, lines])),
        offsets=np.concatenate([image.offsets, np.full(len(lines), image.offsets[-1], np.int32)]),
        edge_part=np.concatenate([image.edge_part, part[line]]),
        edge_group=np.ascontiguousarray(np.concatenate([image.edge_group, group[line]])),
        edge_kind=np.concatenate([image.edge_kind, np.full(len(lines), EdgeClass.OUTLINE, np.uint8)]),
        edge_curved=np.concatenate([image.edge_curved, np.zeros(len(lines), bool)]),
        silhouettes=Silhouettes(
            lift=np.concatenate([np.zeros((n, 3)), lift]),
            hidden=np.concatenate([np.zeros(len(image.edges), bool), hidden[line]]),
            own=OwnFaces.none(),
            number=np.concatenate([np.full(len(image.edges), -1, np.int32), line]),
            curves=Curves(found.curve_kind, found.curve_range, found.curve_offsets, found.curve_values),
            source=np.where(source >= 0, image.chains.index[source], -1).astype(np.int32),
        ),
        chains=merge_chains(image.chains, walks),
    )
    grazing = found.grazing
    # The edges that bound faces. Outlines follow below, without those that their own body hides anyway.
    bare = where(lambda row: row.border)[image.edge_kind[grazing.edge]]
    if image.convex and not bare.any():
        # For one convex body culling alone decides: no edge needs its own faces.
        return shown
    closed = image.groups.cull[image.edge_group[grazing.edge[bare]]]
    # Only the outer side of a closed body is seen; of an open one, the side that faces the viewer.
    side = np.where(closed | grazing.front[bare], 1.0, -1.0)[:, None, None]
    beside = np.where(closed, grazing.beside[bare], np.uint8(0))
    # Beside the end of an outline the edge is moved like the outline: what touches the face there has facets too. It is
    # also moved toward the viewer: off its curved face it might lie in the plane of the other face.
    rise = grazing.rise[bare]
    turns = ((beside == 1) & (rise >= 0.0).all(axis=1))[:, None, None]
    ends = image.points[image.edges[grazing.edge[bare]]]
    toward = image.camera.toward(ends.reshape(-1, 3)).reshape(ends.shape)
    off = grazing.normals[bare] * _lift(rise, deflection)[:, :, None] + OUTLINE_SPARE * deflection * toward
    lift_there = np.where(turns, off, 0.0)
    free = np.flatnonzero(~hidden[line]).astype(np.int32)
    stretches = Grazing(
        edge=np.concatenate([grazing.edge[bare], free + np.int32(len(image.edges))]),
        range=np.concatenate([grazing.range[bare], np.tile([0.0, 1.0], (len(free), 1))]),
        face=np.concatenate([grazing.face[bare], face[line[free]]]),
        off=np.concatenate(
            [
                OWN_LIFT * deflection * side * grazing.normals[bare],
                # At least as far as from all other triangles: those of its own face may stand out by more.
                (outward * np.maximum(distance, OWN_LIFT * deflection)[:, None])[lines[free] - n],
            ]
        ),
        lift=np.concatenate([lift_there, np.zeros((len(free), 2, 3))]),
        beside=np.concatenate([beside, np.zeros(len(free), np.uint8)]),
        dented=np.concatenate([grazing.dented[bare], np.zeros(len(free), bool)]),
    )
    return with_own_faces(shown, surfaces, stretches)


def _lift(rise: Floats, deflection: float) -> Floats:
    """How far points are moved where triangles stand out by `rise`; both in model units."""
    return np.asarray(np.minimum(rise + OUTLINE_SPARE * deflection, OUTLINE_LIFT * deflection))
