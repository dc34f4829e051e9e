"""Sheets and wings for nearly edge-on views, with faces and edges sampled finely by OpenCASCADE's own evaluation."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.source.cad.occt_collections import new_collection

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Grid:
    """A face bounded by lines of constant parameter: points and unit normals (m, n, 3)."""

    points: Floats
    normals: Floats

    def triangles(self) -> Ints:
        m, n = self.points.shape[:2]
        at = np.arange(m * n, dtype=np.int32).reshape(m, n)
        a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
        return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])

    def outline(self, direction: Floats) -> tuple[Floats, Floats]:
        """Points on grid lines where N . D changes its sign, with unit tangents of the outline; off the borders."""
        f = self.normals @ direction
        gradient = np.stack(np.gradient(f), axis=-1)
        ways = np.stack(
            [np.gradient(self.points, axis=0), np.gradient(self.points, axis=1)], axis=-2
        )  # per cell, along both parameters
        points, tangents = [], []
        for axis in (0, 1):
            one = [slice(1, -2), slice(1, -1)] if axis == 0 else [slice(1, -1), slice(1, -2)]
            two = [slice(2, -1), slice(1, -1)] if axis == 0 else [slice(1, -1), slice(2, -1)]
            i, j = tuple(one), tuple(two)
            hit = (f[i] < 0) != (f[j] < 0)
            share = (f[i] / np.where(hit, f[i] - f[j], 1.0))[hit][:, None]
            a, b = self.points[i][hit], self.points[j][hit]
            points.append(a + share * (b - a))
            g, w = gradient[i][hit], ways[i][hit]
            tangent = -g[:, 1:] * w[:, 0] + g[:, :1] * w[:, 1]
            size = np.linalg.norm(tangent, axis=1, keepdims=True)
            tangents.append(tangent / np.maximum(size, 1e-300))
        return np.concatenate(points), np.concatenate(tangents)


def faces(shape: Any, cells: int) -> list[Grid]:
    """All faces on a grid; each must be bounded by lines of constant parameter."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.TopAbs import TopAbs_FACE, TopAbs_REVERSED
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    out = []
    explorer = TopExp_Explorer(wrapped(shape), TopAbs_FACE)
    while explorer.More():
        face = TopoDS.Face_s(explorer.Current())
        explorer.Next()
        out.append(sampled(BRepAdaptor_Surface(face), face.Orientation() == TopAbs_REVERSED, cells))
    return out


def sampled(surface: Any, reversed_: bool, cells: int) -> Grid:
    from OCP.gp import gp_Pnt, gp_Vec

    us = np.linspace(surface.FirstUParameter(), surface.LastUParameter(), cells + 1)
    vs = np.linspace(surface.FirstVParameter(), surface.LastVParameter(), cells + 1)
    points, normals = np.empty((cells + 1, cells + 1, 3)), np.empty((cells + 1, cells + 1, 3))
    p, du, dv = gp_Pnt(), gp_Vec(), gp_Vec()
    for i, u in enumerate(us):
        for j, v in enumerate(vs):
            surface.D1(u, v, p, du, dv)
            points[i, j] = p.Coord()
            normals[i, j] = du.Crossed(dv).Coord()
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-300)
    return Grid(points, -normals if reversed_ else normals)


def edges(shape: Any, count: int) -> Iterator[tuple[Floats, Floats]]:
    """Points and unit tangents of all edges that are drawn: tangent edges and seams are not."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GeomAbs import GeomAbs_C0
    from OCP.gp import gp_Pnt, gp_Vec
    from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS

    table = new_collection("ancestor_map")
    TopExp.MapShapesAndAncestors_s(wrapped(shape), TopAbs_EDGE, TopAbs_FACE, table)
    for i in range(1, table.Extent() + 1):
        edge = TopoDS.Edge_s(table.FindKey(i))
        if BRep_Tool.Degenerated_s(edge):
            continue
        around = list(table.FindFromIndex(i))
        if len(around) == 2:
            one, two = (TopoDS.Face_s(f) for f in around)
            if one.IsSame(two) or BRep_Tool.Continuity_s(edge, one, two) != GeomAbs_C0:
                continue
        curve = BRepAdaptor_Curve(edge)
        points, tangents = np.empty((count, 3)), np.empty((count, 3))
        p, d = gp_Pnt(), gp_Vec()
        for k, t in enumerate(np.linspace(curve.FirstParameter(), curve.LastParameter(), count)):
            curve.D1(t, p, d)
            points[k], tangents[k] = p.Coord(), d.Coord()
        yield points, tangents / np.maximum(np.linalg.norm(tangents, axis=1, keepdims=True), 1e-300)


def wrapped(shape: Any) -> Any:
    return getattr(shape, "wrapped", shape)


def views(grids: Sequence[Grid], sines: Sequence[float]) -> Iterator[tuple[str, Vector]]:
    """Directions at angles of these sines to the tangent plane at points of each face, along and across."""
    for number, grid in enumerate(grids, 1):
        m, n = (k - 1 for k in grid.points.shape[:2])
        for place in ((0.5, 0.5), (0.0, 0.5), (0.5, 0.0), (1.0, 1.0)):
            i, j = round(place[0] * m), round(place[1] * n)
            normal = grid.normals[i, j]
            i0, j0 = min(i, m - 1), min(j, n - 1)
            along = grid.points[i0 + 1, j0] - grid.points[i0, j0]
            along = along - (along @ normal) * normal
            along /= np.linalg.norm(along)
            across = np.cross(normal, along)
            for turn in (0.0, 35.0, 90.0, 125.0):
                a = math.radians(turn)
                flat = math.cos(a) * along + math.sin(a) * across
                for sine in sines:
                    for side in (1.0, -1.0):
                        d = math.sqrt(1 - sine * sine) * flat + side * sine * normal
                        yield f"face {number} at {place}, {turn:.0f} degrees, sine {side * sine}", tuple(d.tolist())


def bezier(poles: npt.ArrayLike) -> Any:
    """A face on a Bezier surface; poles (m, n, 3)."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.Geom import Geom_BezierSurface
    from OCP.gp import gp_Pnt

    p = np.asarray(poles, float)
    array = new_collection("point_net", 1, p.shape[0], 1, p.shape[1])
    for i in range(p.shape[0]):
        for j in range(p.shape[1]):
            array.SetValue(i + 1, j + 1, gp_Pnt(*p[i, j].tolist()))
    return BRepBuilderAPI_MakeFace(Geom_BezierSurface(array), 1e-7).Face()


def spline(heights: Callable[[float, float], float], size: float, poles: int) -> Any:
    """A face on a B-spline surface through points of a height field over a square."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.GeomAPI import GeomAPI_PointsToBSplineSurface
    from OCP.gp import gp_Pnt

    array = new_collection("point_net", 1, poles, 1, poles)
    for i, x in enumerate(np.linspace(-size / 2, size / 2, poles)):
        for j, y in enumerate(np.linspace(-size / 2, size / 2, poles)):
            array.SetValue(i + 1, j + 1, gp_Pnt(float(x), float(y), float(heights(x, y))))
    surface = GeomAPI_PointsToBSplineSurface(array).Surface()
    return BRepBuilderAPI_MakeFace(surface, 1e-7).Face()


def sewn(*shapes: Any) -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing

    sewing = BRepBuilderAPI_Sewing(1e-5)
    for shape in shapes:
        sewing.Add(shape)
    sewing.Perform()
    return cadquery(sewing.SewedShape())


def cadquery(shape: Any) -> Any:
    import cadquery as cq

    return cq.Shape.cast(shape)


def poles(width: float, depth: float, height: Callable[[float, float], float], count: int = 4) -> Floats:
    """Poles over a rectangle, u and v from 0 to 1."""
    at = np.linspace(0.0, 1.0, count)
    return np.array([[(width * u, depth * v, height(u, v)) for v in at] for u in at])


def patch(rise: float, fall: float) -> Any:
    """A bicubic patch bent by `rise` along and `fall` across."""
    return cadquery(bezier(poles(100, 60, lambda u, v: rise * 4 * u * (1 - u) + fall * 4 * v * (1 - v))))


def wavy() -> Any:
    return cadquery(bezier(poles(100, 60, lambda u, v: 6 * math.sin(7 * u) + 4 * math.cos(5 * v + 2 * u), 6)))


def knotted() -> Any:
    return cadquery(spline(lambda x, y: 0.002 * x * x - 0.0015 * y * y + 0.8 * math.sin(x / 9), 100.0, 12))


def ruled() -> Any:
    """Between a straight line and an arc of a parabola."""
    a = np.array([[(0, 0, 0), (50, 0, 0), (100, 0, 0)], [(0, 60, 0), (50, 75, 14), (100, 60, 3)]], float)
    return cadquery(bezier(a))


def twisted() -> Any:
    return cadquery(bezier(np.array([[(0, 0, 0), (0, 60, 5)], [(100, 0, 4), (100, 60, -3)]], float)))


def cylinder(degrees: float = 60.0) -> Any:
    import cadquery as cq

    r, a = 80.0, math.radians(degrees)
    ends = [cq.Vector(r * math.cos(k * a), r * math.sin(k * a), 0) for k in (0.0, 0.5, 1.0)]
    return prism(cq.Edge.makeThreePointArc(*ends))


def prism(edge: Any) -> Any:
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Vec

    return cadquery(BRepPrimAPI_MakePrism(edge.wrapped, gp_Vec(0, 0, 70)).Shape())


def cone() -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Ax3, gp_Cone

    return cadquery(BRepBuilderAPI_MakeFace(gp_Cone(gp_Ax3(), 0.3, 50.0), 0.2, 1.4, 5.0, 80.0).Face())


def smooth_pair() -> Any:
    """Two bicubic patches, tangent where they meet."""
    height = lambda u, v: 9 * 4 * u * (1 - u) - 5 * v * v  # noqa: E731
    one = poles(100, 60, height)
    two = one.copy()
    two[:, 0] = one[:, 3]
    two[:, 1] = 2 * one[:, 3] - one[:, 2]
    two[:, 2] = two[:, 1] + (0, 20, -6)
    two[:, 3] = two[:, 2] + (0, 18, -9)
    return sewn(bezier(one), bezier(two))


def sharp_pair() -> Any:
    """Two bicubic patches that meet at a slight angle."""
    height = lambda u, v: 9 * 4 * u * (1 - u) - 5 * v * v  # noqa: E731
    one = poles(100, 60, height)
    two = one.copy()
    two[:, 0] = one[:, 3]
    for k in (1, 2, 3):
        two[:, k] = one[:, 3] + (0, 20 * k, -3.0 * k - 5.0 * k * k / 9)
    return sewn(bezier(one), bezier(two))


def blade(closed: bool) -> Any:
    """Upper and lower side of a thin wing with sharp leading and trailing edges, swept and twisted."""
    upper, lower = np.empty((4, 4, 3)), np.empty((4, 4, 3))
    for i, u in enumerate(np.linspace(0, 1, 4)):
        chord, twist = 40 - 22 * u, math.radians(6 * u)
        for j, v in enumerate(np.linspace(0, 1, 4)):
            x = 18 * u + chord * v * math.cos(twist)
            z = 3.0 * u * u - chord * v * math.sin(twist)
            bulge = chord * v * (1 - v)
            upper[i, j] = (x, 110 * u, z + 0.30 * bulge)
            lower[i, j] = (x, 110 * u, z + 0.08 * bulge)
    top, bottom = bezier(upper), bezier(lower[:, ::-1])
    if not closed:
        return sewn(top, bottom)
    ends = [bezier(np.stack([lower[k], upper[k]])[:: 1 if k else -1]) for k in (0, 3)]
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid
    from OCP.BRepLib import BRepLib
    from OCP.TopoDS import TopoDS

    shell = sewn(top, bottom, *ends).wrapped
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell_s(shell)).Solid()
    BRepLib.OrientClosedSolid_s(solid)
    return cadquery(solid)


SHEETS: dict[str, Callable[[], Any]] = {
    "cylinder": cylinder,
    "cylinder of 150 degrees": lambda: cylinder(150.0),
    "cone": cone,
    "patch bent once": lambda: patch(12.0, 0.0),
    "patch bent twice": lambda: patch(12.0, 7.0),
    "saddle": lambda: patch(12.0, -7.0),
    "flat patch": lambda: patch(0.8, -0.3),
    "wavy patch": wavy,
    "spline": knotted,
    "ruled": ruled,
    "twisted": twisted,
    "smooth pair": smooth_pair,
    "sharp pair": sharp_pair,
    "blade, open": lambda: blade(False),
    "blade": lambda: blade(True),
}
