"""The scene, meshed finely enough for every view: with a size to fit into, the true scale is known only afterwards."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter

import numpy as np

from hlr.common.clock import Clock, lap
from hlr.common.types import Progress
from hlr.image.camera import Camera
from hlr.image.outlines import with_silhouettes
from hlr.image.placement import Placed
from hlr.image.transparency import glass_of, opacity_of, without_glass
from hlr.linework.curves import EdgeCurveLookup
from hlr.request.drawing_effects import BREP_KINDS, DRAWING
from hlr.request.effect import Facts, Planner
from hlr.request.options import Options
from hlr.scene.build import build
from hlr.scene.scene import Scene
from hlr.source.model import Look, Meshed, Source


@dataclass(frozen=True, slots=True)
class Staged:
    """A scene before a camera: with its outlines, at its scale; and what was decided on the way."""

    camera: Camera
    at: Placed
    planner: Planner
    outlined: Scene | None = field(default=None, repr=False)


def meshed_scene(
    opened: Source,
    cameras: list[Camera],
    placed: list[Placed],
    options: Options,
    tell: Progress,
    clock: Clock,
) -> tuple[Scene, EdgeCurveLookup, list[Placed]]:
    """The scene, the curves of its edges, and the scale and tolerances of every view."""
    scene, curves, views = staged(opened, cameras, placed, options, tell, clock, Planner(DRAWING, options))
    return scene, curves, [view.at for view in views]


def staged(
    opened: Source,
    cameras: list[Camera],
    placed: list[Placed],
    options: Options,
    tell: Progress,
    clock: Clock,
    planner: Planner,
) -> tuple[Scene, EdgeCurveLookup, list[Staged]]:
    """The same with the outlines of each view, where they had to be found to know the scale."""
    _opened(planner, opened)
    for _ in range(2):
        finest = min(at.tolerances.deflection for at in placed)
        started = perf_counter()
        meshed = opened.mesh(finest, placed[0].tolerances.angle, tell)
        started = lap(clock, "tessellate", started)
        tell("scene", 0.0)
        scene = build(meshed, options.crease, finest, planner)
        _surfaces(planner, scene)
        lap(clock, "scene", started)
        views = [_fitted(scene, c, at, options, planner.fork()) for c, at in zip(cameras, placed, strict=True)]
        placed = [view.at for view in views]
        if min(at.tolerances.deflection for at in placed) > 0.8 * finest:
            break
    for view in views:
        _rescued(view.planner, scene, meshed)
    return scene, meshed.edge_curves, views


def _fitted(scene: Scene, camera: Camera, at: Placed, options: Options, planner: Planner) -> Staged:
    """Outlines of curved faces reach beyond their mesh, by less than the accuracy: they are what has to fit."""
    if options.fit is None:
        return Staged(camera, at, planner)
    on = scene.true_surfaces
    curved = on is not None and bool(on.curved.any() or (np.diff(scene.chains.offsets) > 1).any())
    outlined = with_silhouettes(scene, camera, at.tolerances, options.threads, planner)
    fitted = at.fitted(camera, options, outlined.points, curved)
    # At another scale they are traced anew: finer, or less fine.
    same = fitted.tolerances.deflection == at.tolerances.deflection
    return Staged(camera, fitted, planner, outlined if same else None)


def _opened(planner: Planner, opened: Source) -> None:
    """What reading the source took."""
    brep = opened.kind in BREP_KINDS
    facts, count = Facts(kind=opened.kind), len(opened.names())
    planner.on("B-rep reader", facts)
    planner.on("mesh reader", facts)
    planner.spent("B-rep reader" if brep else "mesh reader", **{"brep_parts" if brep else "mesh_parts": count})


def _surfaces(planner: Planner, scene: Scene) -> None:
    """What meshing took. The mesher makes no difference between planar and curved faces: they are told apart here."""
    on = scene.true_surfaces
    if on is None:
        curved = planar = triangles = bent = 0
    else:
        planar, triangles = int(np.count_nonzero(on.planar)), len(scene.triangles)
        curved, bent = len(on.planar) - planar, 0 if planar else triangles
        if curved and planar:
            face = on.first[scene.triangle_part] + scene.triangle_face
            bent = triangles - int(np.count_nonzero(on.planar[face]))
    facts = Facts(curved=curved, planar=planar, faces=on is not None)
    planner.on("meshing of curved faces", facts)
    planner.on("triangulation of planar faces", facts)
    planner.spent("meshing of curved faces", curved_triangles=bent)
    planner.spent("triangulation of planar faces", planar_triangles=triangles - bent)


def _rescued(planner: Planner, scene: Scene, meshed: Meshed) -> None:
    """What became of the faces that the kernel could not mesh."""
    failed = meshed.rescued + meshed.lost
    planner.on("rescue of faces", Facts(failed=failed, faces=scene.true_surfaces is not None))
    planner.spent("rescue of faces", rescued_faces=meshed.rescued, lost_faces=meshed.lost)


def seen_through(scene: Scene, looks: Mapping[str, Look], view: Staged, options: Options) -> Staged:
    """The view in which what is transparent hides nothing, where that is asked for."""
    least = min(map(opacity_of, looks.values()), default=1.0)
    if not view.planner.on("seeing through glass", Facts(opacity=least)):
        return view
    glass = glass_of(scene, looks)
    view.planner.spent("seeing through glass", glass_triangles=int(glass.sum()))
    outlined = view.outlined or with_silhouettes(scene, view.camera, view.at.tolerances, options.threads, view.planner)
    return replace(view, outlined=without_glass(outlined, glass))
