"""What the first stages tell the planner: how the source was read and meshed, and which faces needed another mesher."""

from __future__ import annotations

import numpy as np

from hlr.request.effect import Facts, Planner
from hlr.scene.scene import Scene
from hlr.source.model import Source, Tessellation
from hlr.tables.readers import holds_meshes, is_brep


def note_reading(planner: Planner, source: Source) -> None:
    """Decide on the readers, and state what reading took."""
    count = len(source.names())
    meshes = 0 if is_brep(source.kind) else count
    if is_brep(source.kind) and holds_meshes(source.kind):
        meshes = sum([not info.faces and not info.edges for info in source.infos()])
    planner.state(Facts(kind=source.kind), "B-rep reader", "mesh reader")
    if meshes < count:
        planner.spent("B-rep reader", brep_parts=count - meshes)
    if meshes:
        planner.spent("mesh reader", mesh_parts=meshes)


def note_meshing(planner: Planner, scene: Scene) -> None:
    """State what meshing took. The mesher treats planar and curved faces alike: they are counted apart here."""
    surfaces = scene.true_surfaces
    if surfaces is None:
        curved = planar = triangles = bent = 0
    else:
        planar, triangles, faces = surfaces.planar_faces, len(scene.triangles), len(surfaces.planar)
        if not scene.has_faces.all():
            # A mesh beside B-reps has one face, of which nothing is known.
            meshes = ~scene.has_faces
            faces -= int(np.diff(surfaces.first, append=faces)[meshes].sum())
            triangles -= int(np.count_nonzero(meshes[scene.triangle_part]))
        curved, bent = faces - planar, 0 if planar else triangles
        if curved and planar:
            face = surfaces.first[scene.triangle_part] + scene.triangle_face
            bent = triangles - int(np.count_nonzero(surfaces.planar[face]))
    facts = Facts(curved=curved, planar=planar, faces=surfaces is not None)
    planner.state(facts, "meshing of curved faces", "triangulation of planar faces")
    planner.spent("meshing of curved faces", curved_triangles=bent)
    planner.spent("triangulation of planar faces", planar_triangles=triangles - bent)


def note_touching(planner: Planner, scene: Scene, meshed: Tessellation) -> None:
    """State how many parts are meshed more finely where they may touch others, and how many of their faces."""
    faces = scene.true_surfaces is not None
    touching = int(np.count_nonzero(meshed.touching))
    facts = Facts(touching=touching, through=len(scene.through_themselves), parts=len(scene.parts), faces=faces)
    planner.state(facts, "finer mesh where parts touch")
    planner.spent(
        "finer mesh where parts touch", touching_parts=touching, touching_faces=int(meshed.touching.sum(dtype=np.int64))
    )


def note_rescue(planner: Planner, scene: Scene, meshed: Tessellation) -> None:
    """State what became of the faces that the kernel could not mesh."""
    failed = meshed.rescued + meshed.lost
    planner.state(Facts(failed=failed, faces=scene.true_surfaces is not None), "rescue of faces")
    planner.spent("rescue of faces", rescued_faces=meshed.rescued, lost_faces=meshed.lost)
