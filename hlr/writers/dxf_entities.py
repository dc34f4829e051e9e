"""The lines of a drawing as entities of DXF: LINE, LWPOLYLINE, CIRCLE, ARC, ELLIPSE and SPLINE; in R12 LINE, POLYLINE,
CIRCLE and ARC.

An entity has a type, and tags: pairs of a group code and a value, a line of text each. The tags stand in subclasses,
which R12 does not name.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees, hypot, tau

import numpy as np
import numpy.typing as npt

from hlr.drawing.chords import chords
from hlr.drawing.curve import WHOLE, Arc, Bezier, Curve, raised
from hlr.drawing.drawing import Drawing
from hlr.drawing.lines import STRAIGHT, curve_of, held
from hlr.errors import WriteError
from hlr.request.accuracy import DIGITS
from hlr.tables.line_classes import names
from hlr.writers.dxf_layers import Key
from hlr.writers.dxf_text import clean
from hlr.writers.number import NOT_FINITE

APPLICATION = "HLR"
"""Whose extended data an entity carries: texts "class=sharp", "visible=yes", "part=0", "name=bolt", "edge=7"."""

PLACES = 6
"""Decimals of lengths: nanometres."""

FINE_PLACES = 12
"""Decimals of angles and ratios."""

FLATTEST = 1e-6
"""Ratio of the axes: DXF has no flatter ellipse."""

CUBIC = 3

CLOSED, DASHES_RUN_ON = 1, 128
"""Flags of a polyline: the last point leads to the first; dashes do not start anew at each corner."""

Flat = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Target:
    """Where entities go. places: tags that put an entity on its layer; modern: not R12; first: the first handle; owner:
    the handle of the model space."""

    places: dict[Key, str]
    modern: bool
    first: int
    owner: str


@dataclass(frozen=True, slots=True)
class Shape:
    """An entity without its layer: its type, the subclasses with their tags; vertices of a POLYLINE follow as tags."""

    type: str
    subclasses: tuple[tuple[str, str], ...]
    vertices: tuple[str, ...] = ()


def entities(drawing: Drawing, target: Target) -> Iterator[str]:
    """Each line as text, in the order of the drawing. Raises WriteError where a point is not finite."""
    columns = held(drawing.lines).columns()
    points, data = columns["points"], columns["data"]
    if not (np.isfinite(points).all() and np.isfinite(data).all()):
        raise WriteError(NOT_FINITE)
    at, of = columns["offsets"].tolist(), columns["data_offsets"].tolist()
    kinds, seen, forms = (columns[name].tolist() for name in ("kind", "visible", "form"))
    known, tolerance = _Known(drawing), drawing.accuracy.used * DIGITS
    for i, ties in enumerate(columns["ties"].tolist()):
        flat = points[at[i] : at[i + 1]]
        curve = None if forms[i] <= STRAIGHT else curve_of(forms[i], data[of[i] : of[i + 1]])
        shape = _shape(curve, flat, target.modern, tolerance)
        layer, told = target.places[ties[0], kinds[i], seen[i]], known.tags(kinds[i], seen[i], ties)
        if target.modern:
            tags = "".join([f"100\n{name}\n{inside}" for name, inside in shape.subclasses])
            yield f"0\n{shape.type}\n5\n{target.first + i:X}\n330\n{target.owner}\n100\nAcDbEntity\n{layer}{tags}{told}"
            continue
        yield f"0\n{shape.type}\n{layer}{''.join([inside for _, inside in shape.subclasses])}{told}"
        if shape.vertices:
            yield "".join([f"0\nVERTEX\n{layer}{tags}" for tags in shape.vertices]) + f"0\nSEQEND\n{layer}"


def _shape(curve: Curve | None, flat: Flat, modern: bool, tolerance: float) -> Shape:
    """The entity of a line. tolerance: millimetres by which it may differ from the line."""
    if curve is None:
        return _straight(flat, modern, tolerance)
    if isinstance(curve, Arc):
        long, short = curve.radii
        if long - short <= WHOLE * long:
            return _circle(curve)
        if modern and short >= FLATTEST * long:
            return _ellipse(curve)
        return _straight(chords(curve, tolerance), modern, tolerance)
    return _spline(curve) if modern else _straight(chords(curve, tolerance), modern, tolerance)


def _straight(flat: Flat, modern: bool, tolerance: float) -> Shape:
    """A LINE where the points are on one, else a polyline."""
    if len(flat) > 2 and not _on_a_line(flat, tolerance):
        return _polyline(flat, modern)
    (x0, y0), (x1, y1) = _rounded(flat[[0, -1]])
    return Shape("LINE", (("AcDbLine", f"10\n{x0}\n20\n{y0}\n30\n0.0\n11\n{x1}\n21\n{y1}\n31\n0.0\n"),))


def _on_a_line(flat: Flat, tolerance: float) -> bool:
    """Whether the points lie in order on the line from the first to the last."""
    way = flat[-1] - flat[0]
    length = hypot(*way.tolist())
    if length == 0.0:
        return False
    way = way / length
    off = flat - flat[0]
    along = off @ way
    across = off[:, 0] * way[1] - off[:, 1] * way[0]
    return bool(np.abs(across).max() <= tolerance and (np.diff(along) >= 0.0).all())


def _polyline(flat: Flat, modern: bool) -> Shape:
    corners = _rounded(flat)
    flags = DASHES_RUN_ON
    if len(corners) > 3 and corners[0] == corners[-1]:
        corners, flags = corners[:-1], flags | CLOSED
    if modern:
        listed = "".join([f"10\n{x}\n20\n{y}\n" for x, y in corners])
        return Shape("LWPOLYLINE", (("AcDbPolyline", f"90\n{len(corners)}\n70\n{flags}\n{listed}"),))
    vertices = tuple([f"10\n{x}\n20\n{y}\n30\n0.0\n" for x, y in corners])
    return Shape("POLYLINE", (("", f"66\n1\n10\n0.0\n20\n0.0\n30\n0.0\n70\n{flags}\n"),), vertices)


def _circle(arc: Arc) -> Shape:
    """A CIRCLE, or an ARC, which runs counter-clockwise."""
    x, y = arc.centre.tolist()
    centre = f"10\n{rounded_length(x)}\n20\n{rounded_length(y)}\n30\n0.0\n40\n{rounded_length(arc.radii[0])}\n"
    if arc.whole:
        return Shape("CIRCLE", (("AcDbCircle", centre),))
    turn = np.arctan2(arc.axes[0, 1], arc.axes[0, 0])
    start, end = (_fine(degrees(turn + t) % 360.0) for t in _counter_clockwise(arc))
    return Shape("ARC", (("AcDbCircle", centre), ("AcDbArc", f"50\n{start}\n51\n{end}\n")))


def _ellipse(arc: Arc) -> Shape:
    """An ELLIPSE, which runs counter-clockwise from its long axis."""
    x, y = arc.centre.tolist()
    ax, ay = arc.axes[0].tolist()
    long, short = arc.radii
    start, end = (0.0, tau) if arc.whole else (t % tau for t in _counter_clockwise(arc))
    tags = (
        f"10\n{rounded_length(x)}\n20\n{rounded_length(y)}\n30\n0.0\n11\n{_fine(ax)}\n21\n{_fine(ay)}\n31\n0.0\n"
        f"40\n{_fine(short / long)}\n41\n{_fine(start)}\n42\n{_fine(end)}\n"
    )
    return Shape("ELLIPSE", (("AcDbEllipse", tags),))


def _counter_clockwise(arc: Arc) -> tuple[float, float]:
    """The angles from the first axis at which the arc starts and ends when it runs counter-clockwise."""
    (ax, ay), (bx, by) = arc.axes.tolist()
    start, end = arc.angles.tolist()
    if ax * by < ay * bx:
        start, end = -start, -end
    return (start, end) if start <= end else (end, start)


def _spline(chain: Bezier) -> Shape:
    """The Bezier curves as one cubic B-spline: each knot inside counts three times, so that it is the same curve.

    Quadratic curves become cubic ones: some programs only come near to others.
    """
    control = _rounded((chain if chain.degree == CUBIC else raised(chain)).points)
    pieces = (len(control) - 1) // CUBIC
    knots = [0.0, *(float(k) for k in range(pieces + 1) for _ in range(CUBIC)), float(pieces)]
    tags = f"70\n8\n71\n{CUBIC}\n72\n{len(knots)}\n73\n{len(control)}\n74\n0\n"
    tags += "".join([f"40\n{k}\n" for k in knots])
    tags += "".join([f"10\n{x}\n20\n{y}\n30\n0.0\n" for x, y in control])
    return Shape("SPLINE", (("AcDbSpline", tags),))


def _rounded(flat: Flat) -> list[list[float]]:
    # Adding zero turns -0.0 into 0.0.
    listed: list[list[float]] = (np.round(flat, PLACES) + 0.0).tolist()
    return listed


def rounded_length(value: float) -> float:
    """As a DXF file has it, in its unit."""
    return round(value, PLACES) + 0.0


def _fine(value: float) -> float:
    return round(value, FINE_PLACES) + 0.0


class _Known:
    """What is known of lines, as extended data."""

    def __init__(self, drawing: Drawing) -> None:
        self.classes = names()
        self.parts = [f"1000\npart={k}\n1000\n{clean(f'name={part.name}')}\n" for k, part in enumerate(drawing.parts)]

    def tags(self, kind: int, visible: bool, ties: list[int]) -> str:
        """Of one line. ties: part, edge, face, second part; -1 for none."""
        part, *rest = ties
        told = "".join(
            [f"1000\n{name}={n}\n" for name, n in zip(("edge", "face", "other"), rest, strict=True) if n >= 0]
        )
        seen = "yes" if visible else "no"
        own = f"1001\n{APPLICATION}\n1000\nclass={self.classes[kind]}\n1000\nvisible={seen}\n"
        return f"{own}{self.parts[part]}{told}"
