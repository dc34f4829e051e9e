"""OpenCASCADE's two hidden-line algorithms as contestants: timed stage by stage, their lines as polylines."""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr.image.camera import Camera
from hlr.lab.polylines import Polylines, gathered
from hlr.lab.rivals.opencascade import ExactAlgo, HiddenLines, PolyAlgo, forget_mesh, mark_tangent_edges, mesh
from hlr.lab.study.watch import Watch

CHORD_MM = 0.001
"""Chord error on paper of the exact algorithm's curves. The chords are made after the timing."""


def poly(shape: Any, camera: Camera, per_model: float, deflection: float, angle: float, watch: Watch) -> Polylines:
    """HLRBRep_PolyAlgo on OpenCASCADE's own mesh. deflection: model units; angle: radians."""
    forget_mesh(shape)
    watch("tessellate")
    mesh(shape, deflection, angle)
    rival, found = _hidden(PolyAlgo, shape, camera, watch)
    return gathered([(name, visible, points * per_model) for name, visible, points in rival.lines(found)])


def exact(shape: Any, camera: Camera, per_model: float, watch: Watch) -> Polylines:
    """HLRBRep_Algo on the B-rep itself."""
    rival, found = _hidden(ExactAlgo, shape, camera, watch)
    axes = np.stack([camera.right, camera.up], axis=1) * per_model
    lines = rival.lines(found, CHORD_MM / per_model)
    return gathered([(name, visible, points @ axes) for name, visible, points in lines])


def _hidden(
    algorithm: type[HiddenLines], shape: Any, camera: Camera, watch: Watch
) -> tuple[HiddenLines, list[tuple[str, bool, Any]]]:
    """An algorithm that has hidden the lines of a shape, and what it has found, stage by stage."""
    watch("scene")
    mark_tangent_edges(shape)
    watch("visibility")
    rival = algorithm(shape, camera.direction, camera.right)
    rival.hide()
    watch("linework")
    rival.extract()
    found = rival.compounds()
    watch.stop()
    return rival, found
