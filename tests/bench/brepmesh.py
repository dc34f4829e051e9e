"""Meshing beside OpenCASCADE's BRepMesh at the same deflection: time, triangles, measured chord error, conformity.

    python -m bench.run --only meshing MODEL... [--share 5e-5]

share: of the model's diagonal, the deflection. Both mesh the same shapes in memory, on all cores, without triangles at
the beginning. Errors are distances between middles of triangles and of their sides and the true surface at the same
(u, v), in deflections, across the triangle: of the worst triangle, and of the median.
"""

from __future__ import annotations

import statistics
import time
from pathlib import Path

import numpy as np
from bench import scenes
from bench.pairs import times
from bench.table import Table, geometric_mean

from hlr import _kernel
from hlr.lab.rivals.opencascade import face_meshes, forget_mesh, mesh, triangle_count
from hlr.source import open_source
from hlr.source.cad.prototypes import binary_dump
from hlr.source.cad.shapes import make_compound, sub_shapes

ANGLE = 0.35
"""Radians."""
SHARES = np.array([(1 / 3, 1 / 3, 1 / 3), (0.5, 0.5, 0.0), (0.5, 0.0, 0.5), (0.0, 0.5, 0.5)])


def off(model, face, points, uv):
    """Errors of triangles of curved faces: face (m,) the underlying face; points and uv (m, 3, ..) of the corners."""
    used, which = np.unique(face, return_inverse=True)
    kind, offsets, data = model.surface_records(used.astype(np.int32))
    surfaces = _kernel.Surfaces(kind, offsets, data)
    normal = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    size = np.linalg.norm(normal, axis=1)
    keep = (size > 0) & (kind[which] > 1) & np.isfinite(uv).all(axis=(1, 2))
    worst = np.zeros(int(keep.sum()))
    for share in SHARES:
        place = np.ascontiguousarray((uv[keep] * share[:, None]).sum(axis=1))
        true = surfaces.points(which[keep].astype(np.int32), place)[:, 0]
        apart = ((true - points[keep, 0]) * normal[keep]).sum(axis=1) / size[keep]
        worst = np.maximum(worst, np.abs(apart))
    return worst


def ours(roots, deflection, runs):
    times = []
    for _ in range(runs):
        begin = time.perf_counter()
        model = _kernel.BrepModel(binary_dump(roots))
        meshed = model.mesh(deflection, ANGLE)
        times.append(time.perf_counter() - begin)
    found = meshed.parts(model.planar(1e-9))
    face = np.repeat(found.face_start[:-1], np.diff(found.triangle_start)) + found.triangle_face
    # In the frame of the part: bare roots have their faces where they stand, or moved by face_place.
    place = found.face_place[face]
    turned = np.einsum("mji,mkj->mki", place[:, :, :3], _corners(found) - place[:, None, :, 3])
    # Faces that are triangles already have no surface to be off.
    errors = off(model, found.face_shape[face], turned, found.uv[found.corner]) if len(found.uv) else np.empty(0)
    return statistics.median(times), len(found.triangles), errors, len(meshed.faults()), _open(found)


def _corners(found):
    return found.points[found.triangles]


def _open(found):
    """Sides with other than two triangles; borders of open parts among them."""
    count = 0
    for i in range(len(found.point_start) - 1):
        t = found.triangles[found.triangle_start[i] : found.triangle_start[i + 1]]
        ends = np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1)
        count += int((np.unique(ends, axis=0, return_counts=True)[1] != 2).sum()) if len(ends) else 0
    return count


def theirs(roots, deflection, runs):
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    everything = make_compound(roots)
    times = []
    for _ in range(runs):
        forget_mesh(everything)
        begin = time.perf_counter()
        mesh(everything, deflection, ANGLE)
        times.append(time.perf_counter() - begin)
    model = _kernel.BrepModel(binary_dump(roots))
    seen, number, empty = set(), 0, 0
    faces, points, uv = [], [], []
    for root in roots:
        for shape in sub_shapes(root, Kind.TopAbs_FACE):
            if shape.TShape() in seen:
                continue
            seen.add(shape.TShape())
            found = next(face_meshes(shape), None)
            if found is None:
                empty += 1
            elif found.triangulation.HasUVNodes():
                nodes = range(1, len(found.nodes) + 1)
                par = np.array([found.triangulation.UVNode(i).Coord() for i in nodes])
                points.append(found.nodes[found.triangles])
                uv.append(par[found.triangles])
                faces.append(np.full(len(found.triangles), number))
            number += 1
    count = sum(triangle_count(face) for root in roots for face in sub_shapes(root, Kind.TopAbs_FACE))
    forget_mesh(everything)
    errors = off(model, *(np.concatenate(x) for x in (faces, points, uv))) if faces else np.empty(0)
    return statistics.median(times), count, errors, empty


def table(models, share, runs):
    """One row for each scene or file."""
    headings = ["model", "ours s", "triangles", "worst", "median", "faults", "open"]
    headings += ["BRepMesh s", "triangles", "worst", "median", "empty", "ratio"]
    rows, results = [], []
    for name in models:
        source = open_source(scenes.make(name) if name in scenes.SCENES else Path(name))
        low, high = source.bounds()
        deflection = share * float(np.linalg.norm(high - low))
        roots = [
            root for root, counts in zip(source._prototypes.shapes, source._prototypes.counts, strict=True) if counts[0]
        ]
        a, b = ours(roots, deflection, runs), theirs(roots, deflection, runs)

        def told(errors, deflection=deflection):
            return (
                [f"{value / deflection:.2f}" for value in (errors.max(), np.median(errors))]
                if len(errors)
                else ["-"] * 2
            )

        row = [Path(name).name, f"{a[0]:.3f}", f"{a[1]:,}", *told(a[2]), str(a[3]), str(a[4])]
        rows.append([*row, f"{b[0]:.3f}", f"{b[1]:,}", *told(b[2]), str(b[3]), times(b[0] / a[0])])
        results.append(
            {"model": Path(name).name, "seconds": a[0], "triangles": a[1], "peer": b[0], "peer_triangles": b[1]}
        )
    faster = geometric_mean(r["peer"] / r["seconds"] for r in results)
    fewer = geometric_mean(r["triangles"] / max(r["peer_triangles"], 1) for r in results)
    remark = f"Geometric means: {faster:.1f} times as fast, {fewer:.2f} times the triangles."
    return Table(headings, rows, results, [remark])
