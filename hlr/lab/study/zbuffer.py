"""Hidden lines by a z-buffer, as a contestant: each edge is sampled against a depth image.

The depth image is the preview's (`kernel/preview/src/raster.rs`); this file has no z-buffer of its own.

::

      buffer   |   .   |   .   |   .   |        a sample is visible where its depth is no more than that of its pixel
      edge    -o---o---o---o---o---o---o        and a bias, which keeps faces from hiding their own edges: as
      visible  v   v   v   h   h   h   v        glPolygonOffset(1, 1), slope per pixel and the buffer's resolution

T. Saito, T. Takahashi, "Comprehensible rendering of 3-D shapes", SIGGRAPH 1990, for the idea; OpenGL 4.6, 14.6.5, for
the bias.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.drawing.chords import Index, numbered
from hlr.image.image import Image
from hlr.lab.polylines import Polylines
from hlr.lab.study.watch import Watch
from hlr.shading.lens import lens
from hlr.shading.scene import shaded_scene
from hlr.tables.line_classes import EdgeClass, goes_on
from hlr.visibility.plan import DRAWN

SAMPLE = 0.5
"""Pixels between two samples of an edge."""
FACTOR, UNITS = 1.0, 1.0
"""The arguments of glPolygonOffset: multiples of the depth slope, and of the smallest depth difference."""
DEPTH_BITS = 24
"""Bits of a usual depth buffer, which give its smallest depth difference."""
MARGIN = 2.0
"""Pixels left empty around the model."""


def hidden_lines(image: Image, role: npt.NDArray[np.uint8], pixels: int, watch: Watch) -> Polylines:
    """The image's drawn edges and the contours of its curved faces, cut where their visibility changes.

    role (e,) as in `hlr._kernel.VisibilityInput`; pixels along the longer side of the buffer; parallel views only.
    """
    watch("visibility")
    camera, per_model = image.camera, image.placement.per_model
    flat = image.projected()
    size = np.ptp(flat[:, :2], axis=0)
    scale = (pixels - 2.0 * MARGIN) / float(size.max())
    wide, high = (max(int(np.ceil(side * scale + 2.0 * MARGIN)), 1) for side in size)
    eye = lens(camera, image.points, scale, (wide, high))
    depth, triangle = shaded_scene(image, {}).model.maps(eye)
    normals = _normals(flat, image.triangles)
    allowed = depth + _bias(normals, scale, float(np.ptp(flat[:, 2])))[triangle]
    watch("linework")
    chains, offsets, kinds = _edges(image, role, normals)
    # In pixels, y down.
    picture = np.stack([flat[:, 0] * scale + eye.centre[0], eye.centre[1] - flat[:, 1] * scale, flat[:, 2]], axis=1)
    return _cut(picture[chains], flat[chains, :2] * per_model, offsets, kinds, allowed)


def _normals(flat: Floats, triangles: Ints) -> Floats:
    """(t, 3) normals in view space, not of unit length; z negative toward the viewer."""
    p, q, r = (flat[triangles[:, k]] for k in range(3))
    return np.cross(q - p, r - p)


def _bias(normals: Floats, scale: float, deep: float) -> Floats:
    """(t + 1,) the depth bias on each triangle's pixels; the last is for pixels without a triangle."""
    x, y, z = np.abs(normals).T
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.where(z > 0.0, np.maximum(x, y) / z, 0.0) / scale
    return np.append(FACTOR * slope + UNITS * deep / 2**DEPTH_BITS, 0.0)


def _edges(image: Image, role: npt.NDArray[np.uint8], normals: Floats) -> tuple[Index, Index, npt.NDArray[np.uint8]]:
    """Vertices of all polylines one after another, offsets (k + 1,) into them, and class numbers (k,)."""
    walks, kinds = [], []
    known = image.walks
    drawn = (role & DRAWN) != 0
    for i in range(len(known)):
        edges = known.edges[known.offsets[i] : known.offsets[i + 1]]
        if len(edges) and drawn[edges].all():
            ends = image.edges[edges]
            back = known.reversed[known.offsets[i] : known.offsets[i + 1]]
            walks.append(np.append(np.where(back, ends[:, 1], ends[:, 0]), ends[-1, 0 if back[-1] else 1]))
            kinds.append(int(known.kind[i]))
    smooth = goes_on()[image.edge_kind] & image.edge_curved
    for e in np.flatnonzero(smooth & _folds(image, normals[:, 2])):
        walks.append(image.edges[e])
        kinds.append(EdgeClass.OUTLINE)
    offsets = np.concatenate([[0], np.cumsum([len(walk) for walk in walks])]).astype(np.int64)
    joined = np.concatenate(walks) if walks else np.empty(0, np.int64)
    return joined.astype(np.int64), offsets, np.array(kinds, np.uint8)


def _folds(image: Image, facing: Floats) -> npt.NDArray[np.bool_]:
    """(e,) whether an edge is a contour or boundary: it joins a front and a back triangle, or has only one."""
    edge = np.repeat(np.arange(len(image.edges)), np.diff(image.offsets))
    toward = facing[image.incident] < 0.0
    ahead = np.bincount(edge, toward, len(image.edges))
    behind = np.bincount(edge, ~toward, len(image.edges))
    return (ahead > 0) & (behind > 0)


def _cut(picture: Floats, paper: Floats, offsets: Index, kinds: npt.NDArray[np.uint8], allowed: Floats) -> Polylines:
    """Cut polylines halfway between neighbouring samples of different visibility."""
    owner = np.repeat(np.arange(len(kinds)), np.diff(offsets))
    inner = owner[1:] == owner[:-1]
    reach = np.linalg.norm(np.diff(picture[:, :2], axis=0), axis=1)
    # Samples of the piece after each vertex; the last vertex of a polyline is a sample by itself.
    count = np.append(np.where(inner, np.maximum(np.ceil(reach / SAMPLE), 1.0), 1.0), 1.0).astype(np.int64)
    count = count[: len(picture)]
    vertex, step = numbered(count)
    t = (step / count[vertex])[:, None]
    next_one = np.minimum(vertex + 1, len(picture) - 1)
    at = picture[vertex] + (picture[next_one] - picture[vertex]) * t
    place = paper[vertex] + (paper[next_one] - paper[vertex]) * t
    column = np.clip(at[:, 0].astype(np.int64), 0, allowed.shape[1] - 1)
    row = np.clip(at[:, 1].astype(np.int64), 0, allowed.shape[0] - 1)
    visible = at[:, 2] <= allowed[row, column]
    line = owner[vertex]
    starts = np.append(True, line[1:] != line[:-1])[: len(line)]
    change = np.flatnonzero(~starts[1:] & (visible[1:] != visible[:-1]))
    middle = 0.5 * (place[change] + place[change + 1])
    # Kept are the vertices and the middle of each change, which is listed twice: as an end and as a beginning.
    corner = np.flatnonzero(step == 0)
    order = np.concatenate([corner, change + 0.4, change + 0.6])
    points = np.concatenate([place[corner], middle, middle])[np.argsort(order, kind="stable")]
    begins = np.concatenate([starts[corner], np.zeros(len(change), bool), np.ones(len(change), bool)])
    of = np.concatenate([corner, change, change + 1])
    order = np.argsort(order, kind="stable")
    begins, of = begins[order], of[order]
    first = np.flatnonzero(begins)
    return Polylines(points, np.append(first, len(points)).astype(np.int64), visible[of[first]], kinds[line[of[first]]])
