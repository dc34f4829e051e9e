"""Where edges and outlines lie when they are compared with the triangles of the faces that they bound.

The kernel compares them polygon by polygon (`kernel/visibility/src/scan/own_faces.rs`). Edges without triangles, which
are added to the image and never drawn, give it their places.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.distinct import distinct
from hlr.common.types import Floats, Ints
from hlr.image.image import Image, OwnFaces
from hlr.scene.scene import TrueSurfaces
from hlr.tables.line_classes import INTERIOR, where


@dataclass(frozen=True, slots=True)
class Grazing:
    """Stretches of edges, each with one of the faces that its edge bounds; sorted by edge, then by parameter.

    edge (k,), range (k, 2): parameters from the edge's first to its second vertex; face (k,) numbered through all parts
    off (k, 2, 3): how both ends are moved off that face before the stretch is compared with it, model units
    lift (k, 2, 3): how both ends are moved before the stretch is compared with everything else, model units; summed
    over the faces of a stretch, and used only where the stretch is not the whole edge
    beside (k,) uint8, dented (k,) bool: as in OwnFaces
    """

    edge: Ints
    range: Floats
    face: Ints
    off: Floats
    lift: Floats
    beside: npt.NDArray[np.uint8]
    dented: npt.NDArray[np.bool_]


def with_own_faces(image: Image, surfaces: TrueSurfaces, grazing: Grazing) -> Image:
    """The image with these own faces; unchanged where it has no silhouettes, or where there are no stretches."""
    if image.silhouettes is None or len(grazing.edge) == 0:
        return image
    head = np.ones(len(grazing.edge), bool)
    head[1:] = (np.diff(grazing.edge) != 0) | (np.diff(grazing.range, axis=0) != 0.0).any(axis=1)
    first = np.flatnonzero(head)
    edge, span = grazing.edge[first], grazing.range[first]
    ends = image.edges[edge]
    # Stretches that are not the whole edge get points of their own.
    share = span[:, :, None]
    points = image.points[ends[:, :1]] * (1.0 - share) + image.points[ends[:, 1:]] * share
    lifts = np.add.reduceat(grazing.lift, first)
    parted = np.flatnonzero((span != (0.0, 1.0)).any(axis=1))
    of = np.cumsum(head) - 1
    n, m = len(image.points), len(image.edges)
    line = edge.copy()
    line[parted] = m + np.arange(len(parted), dtype=np.int32)
    more = len(parted) + len(of)
    place = np.concatenate([points[parted], points[of]]).reshape(-1, 3)
    moved = np.concatenate([lifts[parted], grazing.off]).reshape(-1, 3)
    which = np.concatenate([edge[parted], edge[of]])
    sheet = _sheets(image, surfaces)
    own = OwnFaces(
        edge=edge,
        range=_on_paper(image, edge, span),
        line=line,
        beside=np.ascontiguousarray(grazing.beside[first]),
        dented=np.logical_or.reduceat(grazing.dented, first),
        offsets=np.append(first, len(of)).astype(np.int32),
        face=np.ascontiguousarray(grazing.face, np.int32),
        off=m + len(parted) + np.arange(len(of), dtype=np.int32),
        first=surfaces.first,
        sheet=sheet,
    )
    old = image.silhouettes
    return replace(
        image,
        points=np.concatenate([image.points, place]),
        edges=np.concatenate([image.edges, n + np.arange(2 * more, dtype=np.int32).reshape(-1, 2)]),
        offsets=np.concatenate([image.offsets, np.full(more, image.offsets[-1], np.int32)]),
        edge_part=np.concatenate([image.edge_part, image.edge_part[which]]),
        edge_group=np.concatenate([image.edge_group, image.edge_group[which]]),
        edge_kind=np.concatenate([image.edge_kind, np.full(more, INTERIOR, np.uint8)]),
        edge_curved=np.concatenate([image.edge_curved, np.zeros(more, bool)]),
        silhouettes=replace(
            old,
            lift=np.concatenate([old.lift, moved]),
            hidden=np.concatenate([old.hidden, np.zeros(more, bool)]),
            number=np.concatenate([old.number, np.full(more, -1, np.int32)]),
            own=own,
        ),
    )


def _sheets(image: Image, surfaces: TrueSurfaces) -> Ints:
    """(f,) the same number for all faces that join smoothly."""
    face = surfaces.first[image.triangle_part] + image.triangle_face
    count = np.diff(image.offsets)
    tangent = np.flatnonzero(where(lambda row: row.tangent)[image.edge_kind] & (count == 2))
    pair = np.stack([face[image.incident[image.offsets[tangent] + k]] for k in (0, 1)], axis=1)
    key = distinct(pair[:, 0].astype(np.int64) << 32 | pair[:, 1])
    pair = np.stack([key >> 32, key & 0xFFFFFFFF], axis=1).astype(np.int32)
    sheet = np.arange(len(surfaces.number), dtype=np.int32)
    if len(pair):
        joined = np.asarray(_kernel.edge_components(np.ascontiguousarray(pair), len(sheet)), np.int32)
        sheet[pair.ravel()] = np.repeat(joined, 2) + np.int32(len(sheet))
    return np.unique(sheet, return_inverse=True)[1].astype(np.int32)


def _on_paper(image: Image, edges: Ints, t: Floats) -> Floats:
    """Parameters (k, 2) along edges in space, as parameters of their images."""
    if image.camera.eye is None:
        return np.ascontiguousarray(t)
    a, b = (image.camera.ahead(image.points[image.edges[edges, k]])[:, None] for k in (0, 1))
    return np.asarray(t * b / (t * b + (1.0 - t) * a))
