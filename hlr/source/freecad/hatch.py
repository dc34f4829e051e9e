"""How FreeCAD fills the faces that a section cuts: a colour, rows of a PAT file, or tiles of an SVG.

A hatch lies still on paper: its spacing does not follow the scale of the view. Its origin is the middle of the view.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice, pairwise
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.hatch_pattern import Row, Tiles
from hlr.source.freecad.document import Object
from hlr.source.freecad.properties import Properties
from hlr.source.freecad.template import safe_svg

TILE = 64.0
"""Units of a tile's SVG along each side; FreeCAD has ten of them to the millimetre."""

MOST_IN_TILE, CHORDS = 2_000, 12
"""Strokes of one tile, and those that a curve of it becomes."""


@dataclass(frozen=True, slots=True)
class Hatch:
    """The pattern of a hatch; width: of its lines, mm."""

    pattern: tuple[Row, ...] | Tiles
    color: str
    width: float


@dataclass(frozen=True, slots=True)
class CutFaces:
    """How cut faces are filled. color: empty where they are not; unknown: they have a pattern that cannot be drawn."""

    color: str = ""
    hatch: Hatch | None = None
    unknown: bool = False


def cut_faces(section: Object) -> CutFaces:
    """The filling that a section asks for."""
    values, view = section.values, section.view
    match values.count("CutSurfaceDisplay"):
        case 1:
            return CutFaces(_color(view, "CutSurfaceColor", 0xD3D3D300))
        case 2:
            return _hatched(_tiles(values), _color(view, "HatchColor", 0.0), 0.1)
        case 3:
            width = view.number("WeightPattern", 0.1)
            return _hatched(_rows(values), _color(view, "GeomHatchColor", 0.0), width)
    return CutFaces()


def _hatched(pattern: tuple[Row, ...] | Tiles | None, color: str, width: float) -> CutFaces:
    return CutFaces(unknown=True) if pattern is None else CutFaces(hatch=Hatch(pattern, color, width))


def _color(view: Properties, name: str, default: float) -> str:
    return f"#{int(view.number(name, default)) >> 8 & 0xFFFFFF:06x}"


def _placed(values: Properties) -> tuple[float, Floats, Floats]:
    """The scale of a pattern, its turn (2, 2) and its shift (2,)."""
    turn = math.radians(values.number("HatchRotation", 0.0))
    x, y, _ = values.vector("HatchOffset", (0.0, 0.0, 0.0))
    matrix = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    scale = values.number("HatchScale", 1.0)
    return scale if scale > 0.0 else 1.0, matrix, np.array([x, y])


def _rows(values: Properties) -> tuple[Row, ...] | None:
    """The pattern of a PAT file in the document; None where it is missing or none."""
    from ezdxf.tools.pattern import PatternFileCompiler

    text = (values.content("PatIncluded") or b"").decode("utf-8", "replace")
    own = _pattern_named(values.text("NameGeomPattern"), text)
    try:
        ((_, rows),) = PatternFileCompiler(f"*A,\n{own}").compile_pattern().items()
    except Exception:  # whatever a broken file makes the library raise
        return None
    scale, turn, shift = _placed(values)
    found = []
    for angle, base, offset, dashes in rows:
        along = turn @ np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
        place, step = (scale * turn @ np.array(pair, np.float64)[:2] for pair in (base, offset))
        spacing = abs(float(step[0] * along[1] - step[1] * along[0]))
        lengths = tuple(scale * float(each) for each in dashes)
        if not np.isfinite([*place, *step, *lengths]).all() or spacing == 0.0:
            return None
        found.append(Row(place + shift, along, step, lengths))
    return tuple(found) or None


def _pattern_named(name: str, text: str) -> str:
    """The rows of a pattern in a PAT file, without comments; empty where there is none of this name."""
    found, inside = [], False
    for line in (each.partition(";")[0].strip() for each in text.splitlines()):
        if line.startswith("*"):
            inside = line[1:].partition(",")[0].strip().upper() == name.strip().upper()
        elif line and inside:
            found.append(line)
    return "\n".join(found)


def _tiles(values: Properties) -> Tiles | None:
    """The tile of an SVG in the document; None where it is missing, none, or has too many strokes."""
    data = values.content("SvgIncluded")
    if not data:
        return None
    try:
        strokes = list(islice(_tile_strokes(safe_svg(data, lambda *_: None, Path(), "a hatch")), MOST_IN_TILE + 1))
    except Exception:  # whatever a broken file makes the library raise
        return None
    if not 0 < len(strokes) <= MOST_IN_TILE:
        return None
    scale, turn, shift = _placed(values)
    per = 0.1 * scale
    ends = per * np.array(strokes) * [1.0, -1.0] @ turn.T + shift
    return Tiles(ends, per * TILE * turn.T) if np.isfinite(ends).all() else None


def _tile_strokes(root: Element) -> Iterator[list[tuple[float, float]]]:
    """The strokes of an SVG, straight: ends in its own units, y down."""
    from svgelements import SVG, Close, Line, Move, Shape
    from svgelements import Path as SvgPath

    text = ElementTree.tostring(root, encoding="unicode")
    for shape in SVG.parse(io.StringIO(text), reify=True, width=TILE, height=TILE).elements():
        if not isinstance(shape, Shape) or shape.stroke is None or shape.stroke.value is None:
            continue
        for segment in abs(SvgPath(shape)):
            if isinstance(segment, Move) or segment.start is None or segment.end is None:
                continue
            count = 1 if isinstance(segment, Line | Close) else CHORDS
            points = [segment.point(k / count) for k in range(count + 1)]
            yield from ([(a.x, a.y), (b.x, b.y)] for a, b in pairwise(points))
