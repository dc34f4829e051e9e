"""Small models for the referee, built in code; each has one thing that makes hidden-line removal hard."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import cadquery as cq
import numpy as np
from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert
from OCP.BRepTools import BRepTools


def box() -> cq.Workplane:
    """In front, top and right view every hidden line lies under a visible one."""
    return cq.Workplane().box(30, 20, 10)


def bracket() -> cq.Workplane:
    """Counterbores, a boss, fillets: planes, cylinders and tangent edges."""
    return (
        cq.Workplane()
        .box(80, 60, 10)
        .faces(">Z")
        .workplane()
        .rect(60, 40, forConstruction=True)
        .vertices()
        .cboreHole(5, 9, 4)
        .faces(">Z")
        .workplane()
        .circle(15)
        .extrude(30)
        .faces(">Z")
        .workplane()
        .hole(18)
        .edges("|Z")
        .fillet(3)
    )


def ball_in_ring() -> cq.Workplane:
    """A torus fused with a sphere: outlines that end on a curved intersection edge."""
    return cq.Workplane(obj=cq.Solid.makeTorus(20, 6)).union(cq.Workplane().sphere(15))


def cone_and_cylinder() -> cq.Workplane:
    """Outlines that are straight generators, ending on circles."""
    return cq.Workplane(obj=cq.Solid.makeCone(10, 3, 20)).union(
        cq.Workplane("YZ").circle(4).extrude(18).translate((0, 0, 8))
    )


def shaft_in_bore() -> cq.Workplane:
    """Contact of equal radii: two tessellations of one cylinder pierce one another though the surfaces only touch."""
    bearing = cq.Workplane().box(30, 30, 20).faces(">Z").workplane().hole(12)
    shaft = cq.Workplane().workplane(offset=-20).circle(6).extrude(40)
    return cq.Workplane(obj=cq.Compound.makeCompound([bearing.val(), shaft.val()]))


def touching_boxes() -> cq.Workplane:
    """Glued faces, partly overlapping: nothing may leak through the contact."""
    boxes = [
        cq.Solid.makeBox(10, 10, 10),
        cq.Solid.makeBox(10, 10, 10, cq.Vector(10, 3, 2)),
        cq.Solid.makeBox(6, 6, 6, cq.Vector(2, 2, 10)),
    ]
    return cq.Workplane(obj=cq.Compound.makeCompound(boxes))


def clash() -> cq.Workplane:
    """Parts inside one another: visibility changes where an edge pierces a face."""
    bar = cq.Workplane().box(40, 6, 6).rotate((0, 0, 0), (1, 1, 1), 25)
    rod = cq.Workplane().circle(5).extrude(30).translate((3, 0, -15))
    return cq.Workplane(obj=cq.Compound.makeCompound([bar.val(), rod.val(), cq.Solid.makeBox(12, 12, 12)]))


def horn() -> cq.Workplane:
    """A circle swept along a curve in space: outlines on a freeform face that hides itself."""
    path = cq.Workplane("XZ").spline([(0, 0), (4, 10), (12, 8), (10, -2)], tangents=[(0, 1), (-1, -1)])
    return cq.Workplane("XY").circle(1.8).sweep(path)


def spindle() -> cq.Workplane:
    """A valid solid whose one face passes through itself: no check of topology finds that."""
    path = cq.Workplane("XZ").spline([(0, 0), (4, 10), (12, 8), (10, -2)], tangents=[(0, 1), (-1, -1)])
    return cq.Workplane("XY").circle(2.8).sweep(path)


def vase() -> cq.Workplane:
    """A closed B-spline of revolution, seam and all, of one NURBS face per side."""
    profile = cq.Workplane("XZ").moveTo(8, 0).spline([(12, 8), (5, 18), (9, 26)], includeCurrent=True)
    solid = profile.lineTo(0, 26).lineTo(0, 0).close().revolve(360, (0, 0, 0), (0, 1, 0)).val()
    return cq.Workplane(obj=cq.Shape.cast(BRepBuilderAPI_NurbsConvert(solid.wrapped).Shape()))


def thin_walls() -> cq.Workplane:
    """An open shell 0.2 mm thick: the contact tolerance must not make the back of a wall visible."""
    return cq.Workplane().box(40, 30, 20).edges("|Z").fillet(4).faces(">Z").shell(-0.2)


MODELS: dict[str, Callable[[], cq.Workplane]] = {
    model.__name__: model
    for model in (
        box,
        bracket,
        ball_in_ring,
        cone_and_cylinder,
        shaft_in_bore,
        touching_boxes,
        clash,
        horn,
        spindle,
        vase,
        thin_walls,
    )
}


def shape(name: str) -> Any:
    return MODELS[name]().val().wrapped


def save(name: str, folder: Path, suffix: str = ".brep") -> Path:
    """Write a model as B-rep, or meshed as .stl, .obj, .ply and whatever else trimesh writes."""
    path = folder / f"{name}{suffix}"
    if suffix == ".brep":
        BRepTools.Write_s(shape(name), str(path))
    else:
        import trimesh

        vertices, faces = MODELS[name]().val().tessellate(0.05, 0.3)
        trimesh.Trimesh(np.array([v.toTuple() for v in vertices]), np.array(faces), process=False).export(path)
    return path
