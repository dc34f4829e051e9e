"""Surfaces of faces as flat records, from which the kernel evaluates points and normals.

A record is a kind and a run of numbers:

    ::

        plane, cylinder, cone, sphere, torus   origin, x, y, z directions, then the radii (cone: radius, half angle)
        revolution   a point of the axis, its direction, the kind of the curve, its numbers (`hlr.source.geometry`)
        extrusion    the direction, the kind of the curve, its numbers
        spline       degrees u, v; pole counts u, v; periods u, v (0: none); knots u, v with repetition; poles
                     (x, y, z, w), v fastest
        offset       the distance, the kind of the basis, the basis's numbers

The parameters are OpenCASCADE's own: the tessellation's (u, v) are used with them as they are. What can only be had
with other parameters is UNKNOWN, and its outline stays that of the mesh.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import IntEnum
from typing import Any

import numpy as np

from hlr.source.geometry import curve_record
from hlr.source.model import SurfaceRecords


class SurfaceKind(IntEnum):
    """What a record's numbers mean; the kernel's `surface.rs` has the same list."""

    UNKNOWN = 0
    PLANE = 1
    CYLINDER = 2
    CONE = 3
    SPHERE = 4
    TORUS = 5
    REVOLUTION = 6
    EXTRUSION = 7
    SPLINE = 8
    OFFSET = 9


class FaceSurfaces:
    """The surfaces under a list of faces, each packed when it is first asked for."""

    def __init__(self, faces: Sequence[Any]) -> None:
        """faces: TopoDS_Face; records are in the frame of the face before its placement, as its triangulation is."""
        self._faces = faces
        self._known: dict[int, tuple[SurfaceKind, list[float]]] = {}

    def records(self, numbers: Sequence[int]) -> SurfaceRecords:
        """The records of the faces with these numbers, in this order."""
        found = [self._record(number) for number in numbers]
        offsets = np.zeros(len(found) + 1, np.int32)
        np.cumsum([len(data) for _, data in found], out=offsets[1:])
        return SurfaceRecords(
            kind=np.array([kind for kind, _ in found], np.uint8),
            offsets=offsets,
            data=np.array([value for _, data in found for value in data], np.float64),
        )

    def _record(self, number: int) -> tuple[SurfaceKind, list[float]]:
        known = self._known.get(number)
        if known is None:
            known = self._known[number] = _of_face(self._faces[number])
        return known


_UNKNOWN: tuple[SurfaceKind, list[float]] = (SurfaceKind.UNKNOWN, [])


def _of_face(face: Any) -> tuple[SurfaceKind, list[float]]:
    from OCP.BRep import BRep_Tool
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    surface = BRep_Tool.Surface_s(TopoDS.Face(face.Located(TopLoc_Location(), False)))
    if surface is None:
        return _UNKNOWN
    try:
        kind, data = _of_surface(surface)
    except Exception:  # OpenCASCADE's exceptions derive from Exception alone: what it cannot tell is not known
        return _UNKNOWN
    return (kind, data) if all(map(math.isfinite, data)) else _UNKNOWN


def _of_surface(surface: Any) -> tuple[SurfaceKind, list[float]]:
    name = type(surface).__name__
    while name == "Geom_RectangularTrimmedSurface":
        surface = surface.BasisSurface()
        name = type(surface).__name__
    match name:
        case "Geom_Plane":
            return SurfaceKind.PLANE, _frame(surface.Position())
        case "Geom_CylindricalSurface":
            return SurfaceKind.CYLINDER, [*_frame(surface.Position()), surface.Radius()]
        case "Geom_ConicalSurface":
            return SurfaceKind.CONE, [*_frame(surface.Position()), surface.RefRadius(), surface.SemiAngle()]
        case "Geom_SphericalSurface":
            return SurfaceKind.SPHERE, [*_frame(surface.Position()), surface.Radius()]
        case "Geom_ToroidalSurface":
            return SurfaceKind.TORUS, [*_frame(surface.Position()), surface.MajorRadius(), surface.MinorRadius()]
        case "Geom_BSplineSurface":
            return SurfaceKind.SPLINE, _spline(surface)
        case "Geom_BezierSurface":
            return SurfaceKind.SPLINE, _bezier(surface)
        case "Geom_SurfaceOfRevolution":
            place, direction = surface.Location(), surface.Direction()
            axis = [place.X(), place.Y(), place.Z(), direction.X(), direction.Y(), direction.Z()]
            return _swept(SurfaceKind.REVOLUTION, axis, surface.BasisCurve())
        case "Geom_SurfaceOfLinearExtrusion":
            direction = surface.Direction()
            return _swept(SurfaceKind.EXTRUSION, [direction.X(), direction.Y(), direction.Z()], surface.BasisCurve())
        case "Geom_OffsetSurface":
            kind, data = _of_surface(surface.BasisSurface())
            return (SurfaceKind.OFFSET, [surface.Offset(), float(kind), *data]) if kind else _UNKNOWN
    return _UNKNOWN


def _swept(kind: SurfaceKind, along: list[float], curve: Any) -> tuple[SurfaceKind, list[float]]:
    curve_kind, _, _, values = curve_record(curve, curve.FirstParameter(), curve.LastParameter())
    return (kind, [*along, float(curve_kind), *values.tolist()]) if curve_kind else _UNKNOWN


def _frame(axes: Any) -> list[float]:
    place = axes.Location()
    directions = (axes.XDirection(), axes.YDirection(), axes.Direction())
    return [place.X(), place.Y(), place.Z(), *(c for d in directions for c in (d.X(), d.Y(), d.Z()))]


def _spline(surface: Any) -> list[float]:
    periods = [0.0, 0.0]
    if surface.IsUPeriodic() or surface.IsVPeriodic():
        surface = surface.Copy()
        u0, u1, v0, v1 = surface.Bounds()
        if surface.IsUPeriodic():
            periods[0] = u1 - u0
            surface.SetUNotPeriodic()
        if surface.IsVPeriodic():
            periods[1] = v1 - v0
            surface.SetVNotPeriodic()
    knots = [
        [knot for i in range(1, count + 1) for knot in [value(i)] * multiplicity(i)]
        for count, value, multiplicity in (
            (surface.NbUKnots(), surface.UKnot, surface.UMultiplicity),
            (surface.NbVKnots(), surface.VKnot, surface.VMultiplicity),
        )
    ]
    return [
        *(float(n) for n in (surface.UDegree(), surface.VDegree(), surface.NbUPoles(), surface.NbVPoles())),
        *periods,
        *knots[0],
        *knots[1],
        *_poles(surface),
    ]


def _bezier(surface: Any) -> list[float]:
    u, v = surface.UDegree(), surface.VDegree()
    knots = [*[0.0] * (u + 1), *[1.0] * (u + 1), *[0.0] * (v + 1), *[1.0] * (v + 1)]
    return [float(u), float(v), u + 1.0, v + 1.0, 0.0, 0.0, *knots, *_poles(surface)]


def _poles(surface: Any) -> list[float]:
    rational = surface.IsURational() or surface.IsVRational()
    pole, weight = surface.Pole, surface.Weight
    out: list[float] = []
    for i in range(1, surface.NbUPoles() + 1):
        for j in range(1, surface.NbVPoles() + 1):
            out += (*pole(i, j).Coord(), weight(i, j) if rational else 1.0)
    return out
