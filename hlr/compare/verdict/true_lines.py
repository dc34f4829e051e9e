"""The model behind a drawing, meshed finely: its triangles, and all edges and outlines, whether they are seen or not.

Millimetres on the paper of the drawing, x right, y up, z toward the viewer. In perspective as well all lines of sight
are parallel here, straight lines straight and planes planar. Of the stages of a drawing only the mesh is used: what
judges visibility must not share its faults.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.compare.verdict.turning import turning_edges
from hlr.drawing.drawing import Drawing
from hlr.image.camera import Camera
from hlr.request.accuracy import ANGLE
from hlr.request.defaults import CREASE
from hlr.scene.build import build
from hlr.scene.scene import Scene
from hlr.tables.line_classes import INTERIOR, EdgeClass

Bools = npt.NDArray[np.bool_]

MESH_SHARE = 0.1
"""Of the tolerance: chord error of the mesh on paper."""

MOST_TRIANGLES = 3_000_000
"""About; a coarser mesh is taken for larger models."""


@dataclass(frozen=True, slots=True, eq=False)
class TrueLines:
    """What can be drawn of a model, and what can hide it.

    points      (n, 3)
    triangles   (t, 3), part (t,) of each
    start, end  (m, 3) edges of the mesh that lie on edges or outlines of the model
    kind        (m,) number of the line class of each
    error_mm    how far the mesh may lie off the surfaces
    per_mm      millimetres on paper of one in the model
    parts       names
    """

    points: Floats
    triangles: Ints
    part: Ints
    start: Floats
    end: Floats
    kind: npt.NDArray[np.int64]
    error_mm: float
    per_mm: float
    parts: tuple[str, ...]

    @staticmethod
    def of(source: Any, drawing: Drawing, tolerance_mm: float) -> TrueLines | None:
        """Mesh an opened source for the camera of its drawing. None: the camera stands inside the model."""
        view = drawing.view
        camera = Camera(view.name, view.direction, view.right, view.up, view.eye, view.target, view.fov, view.distance)
        per_model = drawing.unit * drawing.scale
        own = drawing.accuracy.deflection * per_model
        wanted = tolerance_mm * MESH_SHARE
        # A mesh that is finer by a factor has about as many times the triangles.
        most = MOST_TRIANGLES / max(drawing.counters.get("triangles", 0), 1)
        error = max(wanted, own / max(most, 1.0)) if own > 0.0 else wanted
        scene = build(source.mesh(error / per_model, ANGLE), _crease(drawing), error / per_model)
        if len(scene.points) and float(camera.ahead(scene.points).min()) <= 0.0 and camera.eye is not None:
            return None
        image = camera.project(scene.points) * (per_model, per_model, -per_model)
        image[:, :2] -= drawing.origin
        edges, kind = _drawn(scene, image, error)
        return TrueLines(
            image,
            scene.triangles,
            scene.triangle_part,
            image[edges[:, 0]],
            image[edges[:, 1]],
            kind,
            error,
            drawing.scale,
            tuple(part.name for part in scene.parts.labels),
        )


def _crease(drawing: Drawing) -> float:
    return CREASE if drawing.request is None else drawing.request.options.crease


def _drawn(scene: Scene, image: Floats, error_mm: float) -> tuple[Ints, npt.NDArray[np.int64]]:
    """(m, 2), (m,) the mesh edges that are edges of the model or lie along its outlines, and their line classes.

    An outline runs where the surface turns away from the viewer: between a triangle that faces him and one that does
    not. On a fine mesh that is as near to the true outline as the mesh is to the surface.
    """
    kind = scene.edge_kind.astype(np.int64)
    surface = np.isin(kind, (INTERIOR, EdgeClass.SMOOTH, EdgeClass.SEAM))
    kind[turning_edges(scene, image, error_mm) & surface] = EdgeClass.OUTLINE
    drawn = kind != INTERIOR
    return scene.edges[drawn], kind[drawn]
