"""OpenCASCADE's own curves of a source's edges, and the distance of drawn lines from them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.drawing.chords import bezier_pieces, evenly
from hlr.drawing.curve import Arc
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line
from hlr.source.cad.shapes import sub_shapes
from hlr.source.transforms import transform_points
from support.measures import distances

Floats = npt.NDArray[np.float64]

DENSE = 600
"""Samples per edge, and per line a tenth of that."""


def true_curves(source: Any) -> dict[tuple[str, int], Any]:
    """A function from a part's name and an edge's index to (n, 3) points of OpenCASCADE's curve of the edge."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GeomAbs import GeomAbs_CurveType
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    edges = [sub_shapes(root, TopAbs_ShapeEnum.TopAbs_EDGE) for root in source.prototypes.shapes]
    parts = {part.name: part for part in source.parts}
    known: dict[tuple[str, int], Any] = {}

    def at(name: str, edge: int) -> Any:
        if (name, edge) not in known:
            part = parts[name]
            curve = BRepAdaptor_Curve(TopoDS.Edge_s(edges[part.prototype][edge]))
            # A straight line is its two ends; a helix of many turns is one B-spline.
            counts = {GeomAbs_CurveType.GeomAbs_Line: 2, GeomAbs_CurveType.GeomAbs_BSplineCurve: 8 * DENSE}
            count = counts.get(curve.GetType(), DENSE)
            places = np.linspace(curve.FirstParameter(), curve.LastParameter(), count)
            values = [curve.Value(float(t)) for t in places]
            known[name, edge] = transform_points(np.array([(p.X(), p.Y(), p.Z()) for p in values]), part.transform)
        return known[name, edge]

    return at


def on_paper(drawing: Drawing, points: np.ndarray) -> np.ndarray:
    """Project points of the model (n, 3) to paper (n, 2), as the exchange format describes it."""
    view, origin = drawing.view, np.array(drawing.origin)
    axes = np.array([view.right, view.up]).T
    factor = drawing.unit * drawing.scale
    if view.eye is None:
        return points @ axes * factor - origin
    away = points - np.array(view.eye)
    depth = -(away @ np.array(view.direction))
    with np.errstate(all="ignore"):
        return away @ axes * (view.distance / depth)[:, None] * factor - origin


def samples(line: Line, count: int = DENSE // 10) -> np.ndarray:
    """(n, 2) points along a line as drawn."""
    if line.curve is None:
        t = np.linspace(0.0, 1.0, max(2, count // len(line.points)))[:, None]
        return np.concatenate([a + (b - a) * t for a, b in zip(line.points, line.points[1:], strict=False)])
    return evenly(line.curve, count if isinstance(line.curve, Arc) else max(count, 8 * bezier_pieces(line.curve)))


def bends_without_curve(line: Line, accuracy: float) -> bool:
    """Whether a line is a polyline: it has no curve, and its points are not in order on the line between its ends."""
    if line.curve is not None:
        return False
    way = line.points[-1] - line.points[0]
    size = float(np.hypot(*way))
    if size == 0.0:
        return True
    arms = line.points - line.points[0]
    along, aside = arms @ way / size, arms @ (way[::-1] * [-1, 1]) / size
    return bool(np.abs(aside).max() > 1e-6 * accuracy or np.diff(along).min() < -1e-6 * accuracy)


def distance(points: np.ndarray, path: np.ndarray) -> float:
    """Largest distance of points to a polyline."""
    return float(distances(points, np.stack([path[:-1], path[1:]], axis=1)).max())


def measured(drawing: Drawing, true: Any) -> tuple[float, float, Counter[str], str]:
    """Largest distance of curves and of polylines, in accuracies; numbers of lines by form; the worst line."""
    accuracy = drawing.accuracy.used
    worst = {"curve": 0.0, "polyline": 0.0}
    forms: Counter[str] = Counter()
    where = ""
    for line in drawing.lines:
        if line.edge is None:
            continue
        straight = line.curve is None and len(line.points) == 2
        forms["straight" if straight else type(line.curve).__name__.replace("NoneType", "polyline")] += 1
        try:
            path = on_paper(drawing, true(drawing.parts[line.part].name, line.edge))
        except Exception:  # no curve in space
            forms["without curve"] += 1
            continue
        path = path[np.isfinite(path).all(axis=1)]
        off = distance(samples(line), path) / accuracy
        key = "polyline" if line.curve is None and not straight else "curve"
        if off > worst[key]:
            worst[key] = off
            if key == "curve":
                where = f"{drawing.parts[line.part].name} {line.edge}"
    return worst["curve"], worst["polyline"], forms, where


def file_curves(source: Any) -> tuple[Callable[[str, int], Any], Callable[[str, int], float]]:
    """Two functions of part name and edge number, for an opened B-rep: its curve's points, and its tolerance."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS

    curves = true_curves(source)
    edges = [sub_shapes(root, TopAbs_ShapeEnum.TopAbs_EDGE) for root in source.prototypes.shapes]
    parts = {part.name: part for part in source.parts}

    def true(name: str, edge: int) -> Floats | None:
        try:
            return np.asarray(curves(name, edge))
        except Exception:  # no curve in space
            return None

    def slack(name: str, edge: int) -> float:
        part = parts[name]
        own = TopoDS.Edge_s(edges[part.prototype][edge])
        ends = [end for end in (TopExp.FirstVertex_s(own), TopExp.LastVertex_s(own)) if not end.IsNull()]
        # A curve need not end exactly at its vertices, but lines do, because neighbouring edges meet there.
        stated = max(BRep_Tool.Tolerance_s(own), *map(BRep_Tool.Tolerance_s, ends), 0.0)
        return abs(float(np.linalg.det(part.transform[:3, :3]))) ** (1 / 3) * stated

    return true, slack
