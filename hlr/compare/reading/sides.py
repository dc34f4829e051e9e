"""The two sides of a comparison: each is read into straight pieces. A format that can be compared is a row here."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from hlr.compare.lines.pieces import Floats, Pieces
from hlr.compare.lines.sketch import About, Sketch, Trait
from hlr.compare.reading.stated_view import page_by, stated_by
from hlr.compare.reading.svg import read_svg
from hlr.drawing.curve import Arc, raised
from hlr.drawing.drawing import Drawing
from hlr.drawing.sheet import views_of_parts
from hlr.errors import SourceError
from hlr.source.file_checks import check_readable
from hlr.source.model import Source
from hlr.tables.entry import listed
from hlr.tables.line_classes import LINE_CLASSES
from hlr.tables.readers import is_model

MOST_BYTES = 1 << 29
"""Of a file."""


@dataclass(frozen=True, slots=True)
class Behind:
    """The model of which a side was drawn.

    source         opened
    drawing        knows its camera and its scale
    matrix, shift  what lies at (x, y) in it lies at matrix @ (x, y) + shift on the side
    to_suit        whether its lines were chosen to suit the other side
    """

    source: Source
    drawing: Drawing
    matrix: Floats = field(default_factory=lambda: np.eye(2))
    shift: Floats = field(default_factory=lambda: np.zeros(2))
    to_suit: bool = False


@dataclass(frozen=True, slots=True)
class DrawnPage:
    """A page of a document that was drawn to be compared, and the models behind its views, by their names."""

    drawing: Drawing
    behind: Mapping[str, Behind]


@dataclass(frozen=True, slots=True)
class Side:
    """One of two drawings: its name, its lines in pieces and as read, what else is known of it, its model or models."""

    title: str
    pieces: Pieces
    about: About
    sketch: Sketch
    behind: Behind | None = None
    behind_views: Mapping[str, Behind] = field(default_factory=dict)


def is_drawing(given: Any) -> bool:
    """Whether this is a drawing, or the file of one, and not a model that is still to be drawn."""
    if isinstance(given, str | os.PathLike):
        return Path(given).suffix.lower() in _READERS or not is_model(os.fspath(given))
    return isinstance(given, Drawing | DrawnPage)


def side_of(given: Any, tolerance_mm: float) -> Side:
    """Read a side: a Drawing, or the path of a file. Raises SourceError where it cannot be read."""
    if isinstance(given, DrawnPage):
        return _side_of_page(given, tolerance_mm)
    sketch = Sketch()
    if isinstance(given, Drawing):
        title = f"{given.source}, {given.view.name}"
        about = _read_drawing(given, sketch)
        return Side(title, sketch.pieces(tolerance_mm, title), about, sketch)
    path = _path(given)
    about = _READERS[path.suffix.lower()](path, sketch)
    return Side(path.name, sketch.pieces(tolerance_mm, path.name), about, sketch)


def _side_of_page(page: DrawnPage, tolerance_mm: float) -> Side:
    """A page that shows one view alone has its model as any drawing has."""
    side = side_of(page.drawing, tolerance_mm)
    if side.about.views:
        return replace(side, behind_views=page.behind)
    return replace(side, behind=next(iter(page.behind.values()), None))


def _path(given: Any) -> Path:
    if not isinstance(given, str | os.PathLike):
        raise SourceError(f"{given!r} cannot be compared: give a drawing, or the path of its file")
    if os.fspath(given) == "":
        raise SourceError("the name of a side is empty: name a drawing or a model")
    path = Path(given)
    check_readable(path)
    if path.suffix.lower() not in _READERS:
        drawings = listed(_READERS, "or")
        raise SourceError(f"{path.name} cannot be compared: give a drawing ({drawings}), or a model such as part.step")
    if path.stat().st_size > MOST_BYTES:
        raise SourceError(f"{path.name} has more than {MOST_BYTES >> 20} MiB: it is refused")
    return path


def _read_json(path: Path, sketch: Sketch) -> About:
    from hlr.writers.loading import load

    return _read_drawing(load(path), sketch)


def _read_drawing(drawing: Drawing, sketch: Sketch) -> About:
    parts = tuple(part.name for part in drawing.parts)
    views = () if drawing.sheet is None else tuple(view.name for view in drawing.sheet.views)
    of_parts = views_of_parts(parts, views)
    for line in drawing.lines:
        edge = -1 if line.edge is None else line.edge
        view = of_parts[line.part] if views else -1
        sketch.begin(Trait(LINE_CLASSES[line.kind].number, int(line.visible), line.part, edge, view))
        curve = line.curve
        if curve is None:
            sketch.polyline(line.points)
        elif isinstance(curve, Arc):
            centre, (long, short), angles = curve.centre.tolist(), curve.axes.tolist(), curve.angles.tolist()
            sketch.arc(tuple(centre), (tuple(long), tuple(short)), tuple(angles))
        else:
            points = [(x, y) for x, y in (curve if curve.degree == 3 else raised(curve)).points.tolist()]
            for k in range(0, len(points) - 1, 3):
                sketch.cubic(*points[k : k + 4])
    if drawing.sheet is not None:
        scales = {view.scale for view in drawing.sheet.views}
        return About(parts, scales.pop() if len(scales) == 1 else None, views, page=page_by(drawing))
    return About(parts, drawing.scale, views, stated=stated_by(drawing.view, drawing.section, drawing.window))


def _read_dxf(path: Path, sketch: Sketch) -> About:
    from hlr.compare.reading.dxf import read_dxf

    return read_dxf(path, sketch)


def _read_pdf(path: Path, sketch: Sketch) -> About:
    from hlr.compare.reading.pdf import read_pdf

    return read_pdf(path, sketch)


_READERS: dict[str, Callable[[Path, Sketch], About]] = {
    ".svg": read_svg,
    ".json": _read_json,
    ".dxf": _read_dxf,
    ".pdf": _read_pdf,
}
"""What reads a file with this ending: it adds the lines to the sketch, and returns what else is known."""
