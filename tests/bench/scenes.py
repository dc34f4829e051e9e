"""Scenes for the benchmarks, built with OpenCASCADE: thousands of parts in well under a second each."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

DEFLECTION = 0.1
ANGLE = 0.5
PITCH = 10.0
CELL = 20.0


def plate(n: int) -> Any:
    """n x n holes of 5 mm, 10 mm apart, through a plate 6 mm thick: one planar face with n * n inner wires."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pln, gp_Pnt, gp_Vec

    side = n * PITCH
    face = BRepBuilderAPI_MakeFace(gp_Pln(), 0.0, side, 0.0, side)
    for i in range(n):
        for j in range(n):
            centre = gp_Pnt((i + 0.5) * PITCH, (j + 0.5) * PITCH, 0.0)
            hole = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(centre, gp_Dir(0, 0, -1)), 2.5)).Edge()
            face.Add(BRepBuilderAPI_MakeWire(hole).Wire())
    return BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, 6)).Shape()


def assembly(count: int, seed: int = 1) -> Any:
    """Boxes and cylinders, each somehow turned, one per cell of a cube of cells. They do not touch."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    rng = random.Random(seed)
    n = _cells(count)
    parts = []
    for i in range(count):
        move = _placement(rng, (i % n, i // n % n, i // (n * n)))
        if rng.random() < 0.5:
            a, b, c = (4 + 7 * rng.random() for _ in range(3))
            part = BRepPrimAPI_MakeBox(gp_Pnt(-a / 2, -b / 2, -c / 2), a, b, c).Shape()
        else:
            length, radius = 4 + 8 * rng.random(), 2 + 4 * rng.random()
            axis = gp_Ax2(gp_Pnt(0, 0, -length / 2), gp_Dir(0, 0, 1))
            part = BRepPrimAPI_MakeCylinder(axis, radius, length).Shape()
        parts.append(part.Moved(move))
    return compound(parts)


def tori(count: int, seed: int = 1) -> Any:
    """Rings apart from one another: everything curved, next to no edges, contours few among many triangles."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeTorus

    rng = random.Random(seed)
    n = _cells(count)
    return compound(
        [
            BRepPrimAPI_MakeTorus(5 + 2 * rng.random(), 1.5 + rng.random())
            .Shape()
            .Moved(_placement(rng, (i % n, i // n % n, i // (n * n))))
            for i in range(count)
        ]
    )


def filleted(width: float, depth: float, height: float, radius: float) -> Any:
    """A box with all its edges rounded."""
    from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.TopAbs import TopAbs_EDGE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    box = BRepPrimAPI_MakeBox(width, depth, height).Shape()
    rounded, edges, known = BRepFilletAPI_MakeFillet(box), TopExp_Explorer(box, TopAbs_EDGE), set()
    while edges.More():
        if edges.Current().TShape() not in known:
            known.add(edges.Current().TShape())
            rounded.Add(radius, TopoDS.Edge_s(edges.Current()))
        edges.Next()
    return rounded.Shape()


def box() -> Any:
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox

    return BRepPrimAPI_MakeBox(30, 20, 10).Shape()


def sphere() -> Any:
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeSphere

    return BRepPrimAPI_MakeSphere(20).Shape()


def compound(parts: list[Any]) -> Any:
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    whole, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(whole)
    for part in parts:
        builder.Add(whole, part)
    return whole


def _cells(count: int) -> int:
    """ceil(count ** (1/3)), also where the root of a cube is not exact in floating point."""
    n = round(count ** (1 / 3))
    return n if n**3 >= count else n + 1


def _placement(rng: random.Random, cell: tuple[int, int, int]) -> Any:
    """A location at the cell, turned by three angles drawn at random."""
    from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
    from OCP.TopLoc import TopLoc_Location

    move = gp_Trsf()
    move.SetTranslation(gp_Vec(*(CELL * c for c in cell)))
    for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        turn = gp_Trsf()
        turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(*axis)), 2 * math.pi * rng.random())
        move.Multiply(turn)
    return TopLoc_Location(move)


SCENES: dict[str, Callable[[], Any]] = {
    "plate20": lambda: plate(20),
    "asm1000": lambda: assembly(1000),
    "asm4000": lambda: assembly(4000),
    "asm16000": lambda: assembly(16000),
    "tori250": lambda: tori(250),
    "box": box,
    "filleted box": lambda: filleted(30, 20, 10, 3),
    "sphere": sphere,
}
FINE = {"tori250": 0.02}
"""Scenes meshed with another deflection than DEFLECTION: tori250 to a million triangles."""


def make(name: str) -> Any:
    """A scene by name, or the shape of a STEP or BREP file."""
    if name in SCENES:
        return SCENES[name]()
    from support.referee.reference import read_shape

    return read_shape(name)


def solids(folder: Path) -> list[str]:
    """The STEP and BREP files of a folder that hold a solid."""
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer

    endings = {".step", ".stp", ".brep", ".brp"}
    files = sorted(path for path in folder.iterdir() if path.suffix.lower() in endings)
    return [str(path) for path in files if TopExp_Explorer(make(str(path)), TopAbs_SOLID).More()]


def deflection(name: str) -> float:
    return FINE.get(name, DEFLECTION)
