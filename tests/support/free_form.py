"""Shapes whose surfaces are B-splines, as converters of STEP and IGES write them; and how much is drawn of them."""

from __future__ import annotations

from collections import Counter

import cadquery as cq
import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

import hlr


def as_free_form(shape: cq.Shape) -> cq.Shape:
    return cq.Shape.cast(BRepBuilderAPI_NurbsConvert(shape.wrapped).Shape())


def with_more_knots(shape: cq.Shape, degree: int) -> cq.Shape:
    """With B-splines of at least this degree, each with another knot both ways."""
    found = cq.Shape.cast(BRepBuilderAPI_NurbsConvert(shape.wrapped, True).Shape())
    for face in found.Faces():
        surface = BRep_Tool.Surface_s(face.wrapped)
        surface.IncreaseDegree(max(degree, surface.UDegree()), max(degree, surface.VDegree()))
        low_u, high_u, low_v, high_v = surface.Bounds()
        surface.InsertUKnot(low_u + 0.37 * (high_u - low_u), 1, 1e-9, True)
        surface.InsertVKnot(low_v + 0.61 * (high_v - low_v), 1, 1e-9, True)
    return found


def lengths(drawing: hlr.Drawing) -> dict[tuple[str, bool], float]:
    """How long the lines of each kind are together, millimetres on paper."""
    found: Counter[tuple[str, bool]] = Counter()
    for line in drawing.lines:
        found[line.kind, line.visible] += float(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum())
    return dict(found)
