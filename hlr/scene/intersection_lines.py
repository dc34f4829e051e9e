"""Intersection lines: the segments in which meshes cross, chained per pair of faces, and the true curve of each."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr._kernel import MeshScene, PartTables
from hlr.scene.clash import Clashes
from hlr.scene.scene import IntersectionCurves, TrueSurfaces
from hlr.scene.walks import STRAIGHT_ON
from hlr.source.model import Curves
from hlr.tables.line_classes import EdgeClass


def intersection_lines(
    met: Clashes,
    found: MeshScene,
    tables: PartTables,
    surfaces: TrueSurfaces | None,
    first: int,
    deflection: float,
) -> tuple[_kernel.Walks, IntersectionCurves | None]:
    """The lines, and their curves where a face is curved.

    first: the number of the first segment among the edges of the scene; deflection: model units. Where two lines cross,
    as for two cylinders of one radius, each goes straight on.
    """
    # (t,) the face of each triangle, numbered through all parts.
    faces = (tables.face_start[:-1][found.triangle_part] + tables.triangle_face).astype(np.int32)
    pair = met.group
    bent: npt.NDArray[np.bool_] = np.zeros(len(pair), bool)
    if surfaces is not None:
        known = surfaces.number >= 0
        both = faces[met.triangle]
        bent = np.asarray(known[both].all(axis=1) & ~surfaces.planar[both].all(axis=1))
        # Only curves end where the face changes: planes have straight lines in common, on one face as on the next.
        pair = np.concatenate([pair, np.where(bent[:, None], both, -1)], axis=1)
    _, key = np.unique(pair, axis=0, return_inverse=True)
    offsets, order, backward = _kernel.chain(met.edges, key.ravel().astype(np.int32), met.points, STRAIGHT_ON)
    head = order[offsets[:-1]]
    parts = np.sort(found.group_part[met.group[head]], axis=1)
    curve, curves = None, None
    if surfaces is not None and bent.any():
        wanted = np.zeros(len(surfaces.number), bool)
        wanted[faces[met.triangle[bent]]] = True
        true = _kernel.intersection_curves(
            tables.points,
            found.triangles,
            surfaces.of(wanted, faces),
            (met.points, met.edges, met.triangle),
            (offsets, order, backward),
            deflection,
        )
        records = Curves(true.curve_kind, true.curve_range, true.curve_offsets, true.curve_values)
        curves, curve = (
            IntersectionCurves(records, true.rise, np.concatenate([tables.points, true.points])),
            true.number,
        )
    walks = _kernel.Walks(
        offsets,
        order + np.int32(first),
        backward,
        np.full(len(parts), EdgeClass.INTERSECTION, np.uint8),
        np.ascontiguousarray(parts[:, 0]),
        other=np.ascontiguousarray(parts[:, 1]),
        curve=curve,
        # Edges that are chained belong to one line.
        shallow=np.ascontiguousarray(met.shallow[head]),
    )
    return walks, curves
