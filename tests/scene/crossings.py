"""Models whose parts cross, touch, or pass through themselves."""

from __future__ import annotations

import cadquery as cq
import numpy as np

from support import meshes
from support.models import box, solids

THROUGH = "the surface passes through itself"


CROSSING = ((20, 20, 20), (0, 0, 0)), ((8, 6, 60), (0, 1, 0))


def assembly(*solids_):
    out = cq.Assembly()
    for i, solid in enumerate(solids_):
        out.add(solid if isinstance(solid, cq.Workplane) else cq.Workplane(obj=solid), name=f"part{i}")
    return out


def across(radius, other, half=25, turn=0):
    """Two cylinders at right angles, the first turned about its own axis."""
    along_x = cq.Workplane("YZ").workplane(offset=-half).circle(radius).extrude(2 * half)
    along_x = along_x.rotate((0, 0, 0), (1, 0, 0), turn)
    return assembly(along_x, cq.Workplane().workplane(offset=-half).circle(other).extrude(2 * half))


def bore(angle):
    block = cq.Workplane().box(30, 30, 20).faces(">Z").workplane().hole(10)
    shaft = cq.Workplane(obj=cq.Solid.makeCylinder(5, 40, cq.Vector(0, 0, -20)))
    return assembly(block, shaft.rotate((0, 0, 0), (0, 0, 1), angle))


def bored(body, x, turn):
    """The body with a bore along z, and a shaft in it that is turned about its own axis."""

    def cylinder(length):
        return cq.Workplane(obj=cq.Solid.makeCylinder(5, length, cq.Vector(x, 0, -length / 2)))

    return assembly(body.cut(cylinder(80)), cylinder(50).rotate((x, 0, 0), (x, 0, 1), turn))


WEDGE = [(-15, -10), (15, -10), (15, 14), (-15, 6)]

BORED = {
    "box": (lambda: cq.Workplane().box(30, 30, 20), 0),
    "disc": (lambda: cq.Workplane().circle(15).extrude(20), 0),
    "wedge": (lambda: cq.Workplane("XZ").polyline(WEDGE).close().extrude(30).translate((0, 15, 0)), 0),
    "rod": (lambda: cq.Workplane("YZ").circle(15).extrude(60).translate((-30, 0, 0)), 0),
    "cone": (lambda: cq.Workplane(obj=cq.Solid.makeCone(20, 9, 20)), 0),
    "ball": (lambda: cq.Workplane().sphere(15), 0),
    "ring": (lambda: cq.Workplane(obj=cq.Solid.makeTorus(14, 9)), 14),
    "strip": (lambda: cq.Workplane().box(300, 11, 20), 0),
}


def oblique():
    """A stack turned out of all axes: coordinates are rounded, and contact planes are not quite one."""
    return assembly(
        *(
            cq.Workplane().box(10, 10, 10).translate((3 * k, k, 10 * k)).rotate((0, 0, 0), (1, 2, 3), 33)
            for k in range(4)
        )
    )


def tube(n, turn, radius=5.0, height=10.0):
    """A closed cylinder of n facets."""
    t = (np.arange(n) + turn) * 2 * np.pi / n
    rings = [np.stack([radius * np.cos(t), radius * np.sin(t), np.full(n, z)], axis=1) for z in (0.0, height)]
    points = np.concatenate([*rings, [[0, 0, 0], [0, 0, height]]])
    i = np.arange(n)
    j = (i + 1) % n
    faces = [(i, j, j + n), (i, j + n, i + n), (j, i, 0 * i + 2 * n), (i + n, j + n, 0 * i + 2 * n + 1)]
    return points, np.concatenate([np.stack(f, axis=1) for f in faces]).astype(np.int32)


TOUCHING = {
    "shaft in its bore": lambda: bore(0),
    "shaft in its bore, turned": lambda: bore(17),
    "stack": lambda: solids(((10, 10, 10), (0, 0, 0)), ((6, 6, 10), (0, 0, 10)), ((10, 10, 10), (10, 0, 0))),
    "oblique stack": oblique,
    "coplanar": lambda: solids(((10, 10, 10), (0, 0, 0)), ((10, 10, 10), (4, 0, 0))),
    "copies": lambda: solids(((10, 10, 10), (0, 0, 0)), ((10, 10, 10), (0, 0, 0))),
    "edge on edge": lambda: solids(((10, 10, 10), (0, 0, 0)), ((10, 10, 10), (10, 10, 0))),
    "edge on a face": lambda: assembly(
        cq.Workplane().box(20, 20, 10),
        cq.Workplane().box(6, 6, 6).rotate((0, 0, 0), (1, 0, 0), 45).translate((0, 0, 5 + 18**0.5)),
    ),
    "ball on a plate": lambda: assembly(cq.Workplane().box(20, 20, 10), cq.Workplane().sphere(5).translate((0, 0, 10))),
    "balls": lambda: assembly(cq.Workplane().sphere(5), cq.Workplane().sphere(5).translate((10, 0, 0))),
    "apart": lambda: solids(((10, 10, 10), (0, 0, 0)), ((10, 10, 10), (11, 11, 11))),
    "inside": lambda: solids(((10, 10, 10), (0, 0, 0)), ((4, 4, 4), (0, 0, 0))),
}


def eight(radius=1.2, n=96, m=24):
    """A closed tube along a figure of eight, in one plane: it runs through itself where that crosses."""
    u = np.arange(n) * (2 * np.pi / n)
    centre = np.stack([8 * np.sin(u), 8 * np.sin(u) * np.cos(u), 0 * u], axis=-1)
    along = np.stack([8 * np.cos(u), 8 * np.cos(2 * u), 0 * u], axis=-1)
    up = np.tile([0.0, 0.0, 1.0], (n, 1))
    out = np.cross(along / np.linalg.norm(along, axis=1)[:, None], up)
    v = np.arange(m) * (2 * np.pi / m)
    ring = np.cos(v)[None, :, None] * out[:, None] + np.sin(v)[None, :, None] * up[:, None]
    return meshes.grid(centre[:, None] + radius * ring, around=True, along=True)


def overlapping_boxes():
    return [cq.Solid.makeBox(10, 10, 10), cq.Solid.makeBox(10, 10, 10, cq.Vector(5, 5, 5))]


def bent(*removed):
    mesh = box((10, 10, 10))
    mesh.update_faces([i not in removed for i in range(12)])
    return mesh
