"""Distance of written lines of meshes to the mesh's own edges: creases, boundaries and contours."""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.written import Written
from hlr.pipeline.session import Session
from hlr.request.accuracy import MEASURED_EDGE_ON
from hlr.request.options import Options
from hlr.tables.line_classes import INTERIOR


def mesh_errors(opened: Any, drawing: Drawing, drawn: Written, paper: Paper) -> tuple[Floats, list[str]]:
    """(n,) the largest distance, mm on paper, of each line of a mesh without B-rep, and the lines' names.

    Intersection lines are left out.
    """
    assert drawing.request is not None
    deflection = drawing.accuracy.deflection
    options = Options(crease=drawing.request.options.crease)
    scene, _ = Session(opened, [], options).scene_at(deflection)
    bare = ~scene.has_faces
    wanted = np.array([bare[x.part] and x.kind != "intersection" for x in drawing.lines], bool)
    mine = np.flatnonzero(wanted[drawn.line]) if len(wanted) else np.zeros(0, np.int64)
    if len(mine) == 0:
        return np.zeros(0), []
    corner = scene.points[scene.triangles]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    sight = paper.sight(corner[:, 0])
    ahead = (normal * sight).sum(axis=1) / np.linalg.norm(sight, axis=1)
    side = np.linalg.norm(corner - np.roll(corner, 1, axis=1), axis=2).max(axis=1)
    # A triangle whose image has next to no height (twice the area over a side) is edge-on: rounding decides its facing.
    edge_on = np.abs(ahead) <= MEASURED_EDGE_ON * deflection * side
    first, count = scene.offsets[:-1], np.diff(scene.offsets)
    faced = np.flatnonzero(count > 0)
    some = np.zeros(len(scene.edges), np.int64)
    some[faced] = np.add.reduceat((ahead > 0.0)[scene.incident].astype(np.int64), first[faced])
    folds = (some > 0) & (some < count)
    folds[faced] |= np.logical_or.reduceat(edge_on[scene.incident], first[faced])
    edge = np.flatnonzero(folds | (scene.edge_kind != INTERIOR))
    ends, _ = paper.chords(*scene.points[scene.edges[edge].T])
    good = np.isfinite(ends).all(axis=1)
    part = np.array([x.part for x in drawing.lines], np.int32)
    line = drawn.line[mine]
    off, _ = _kernel.nearest(
        np.ascontiguousarray(drawn.points[mine]),
        np.ascontiguousarray(part[line]),
        np.ascontiguousarray(ends[good]),
        np.ascontiguousarray(scene.edge_part[edge][good], np.int32),
        np.inf,
    )
    starts = np.flatnonzero(np.append(True, line[1:] != line[:-1]))
    of = [drawing.lines[i] for i in line[starts].tolist()]
    return np.maximum.reduceat(off, starts), [f"{drawing.parts[x.part].name}, {x.kind}" for x in of]
