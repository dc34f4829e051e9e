"""The paths on a page of PDF, as PDFium gives them: each with its pen, the layers that it is in, and its points."""

from __future__ import annotations

import ctypes
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from hlr.compare.lines.sketch import MOST_PIECES, Pair, Sketch, Trait
from hlr.errors import SourceError

Matrix = tuple[float, float, float, float, float, float]
"""x' = a x + c y + e, y' = b x + d y + f, as PDF has it."""

MOST_OBJECTS = 2_000_000
DEEPEST = 20
"""Forms within forms."""

LONGEST_NAME = 2_000
"""Bytes of a layer's name."""

_WORDS = {1: "texts", 3: "pictures", 4: "shadings"}
"""By PDFium's number of a type."""

_PATH, _FORM = 2, 5
_LINE, _CURVE, _MOVE = 0, 1, 2


@dataclass(frozen=True, slots=True)
class Path:
    """A path. to_page: from its coordinates to points on the page.

    stroked, filled   how it is drawn
    width, cap, join  of the pen
    dashes            lengths of dashes and gaps by turns; empty: none
    """

    handle: Any
    to_page: Matrix
    stroked: bool
    filled: bool
    width: float
    cap: int
    join: int
    dashes: tuple[float, ...]

    def layers(self) -> list[str]:
        """The names of the layers (optional content groups) that it is in, from the outside in."""
        from pypdfium2 import raw

        read = raw.FPDFPageObjMark_GetParamBlobValue
        found = []
        for number in range(raw.FPDFPageObj_CountMarks(self.handle)):
            mark = raw.FPDFPageObj_GetMark(self.handle, number)
            text, size = ctypes.create_string_buffer(LONGEST_NAME), ctypes.c_ulong()
            buffer = ctypes.cast(text, read.argtypes[2])
            if read(mark, b"Name", buffer, LONGEST_NAME, size) and size.value <= LONGEST_NAME:
                name = text.raw[: size.value]
                wide = name.startswith(b"\xfe\xff")
                found.append(name[2:].decode("utf-16-be", "replace") if wide else name.decode("latin-1"))
        return found

    def draw(self, sketch: Sketch, trait: Trait, to_paper: Matrix) -> None:
        """Add it to a sketch, each part of it without a gap as a line."""
        from pypdfium2 import raw

        a, b, c, d, e, f = to_paper
        x, y = ctypes.c_float(), ctypes.c_float()
        first: Pair = (0.0, 0.0)
        row: list[Pair] = []
        controls: list[Pair] = []
        begun = False
        for number in range(raw.FPDFPath_CountSegments(self.handle)):
            segment = raw.FPDFPath_GetPathSegment(self.handle, number)
            raw.FPDFPathSegment_GetPoint(segment, x, y)
            point = (a * x.value + c * y.value + e, b * x.value + d * y.value + f)
            kind = raw.FPDFPathSegment_GetType(segment)
            if kind == _MOVE:
                _lift(sketch, row)
                first, row, begun = point, [point], False
                continue
            if not begun:
                sketch.begin(trait)
                begun = True
            if kind == _LINE:
                row.append(point)
            else:
                controls.append(point)
                if len(controls) == 3:
                    start = row[-1]
                    _lift(sketch, row)
                    sketch.cubic(start, *controls)
                    row, controls = [controls[-1]], []
            if raw.FPDFPathSegment_GetClose(segment):
                row.append(first)
        _lift(sketch, row)


def _lift(sketch: Sketch, row: list[Pair]) -> None:
    if len(row) > 1:
        sketch.polyline(row)


def paths_of(page: Any, left_out: Counter[str], name: str) -> Iterator[Path]:
    """All paths of a page, also those of forms; what else is there is counted. name: of the file, for errors."""
    from pypdfium2 import raw

    identity: Matrix = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    tops = (raw.FPDFPage_GetObject(page.raw, n) for n in range(raw.FPDFPage_CountObjects(page.raw)))
    waiting: list[tuple[Iterator[Any], Matrix]] = [(tops, identity)]
    count = points = 0
    while waiting:
        handle = next(waiting[-1][0], None)
        if handle is None:
            waiting.pop()
            continue
        count += 1
        if count > MOST_OBJECTS or points > MOST_PIECES or len(waiting) > DEEPEST:
            raise SourceError(f"{name} has too many lines, or forms within forms: it is refused")
        kind, to_page = raw.FPDFPageObj_GetType(handle), after(waiting[-1][1], _matrix(handle))
        if kind == _FORM:
            inside = (raw.FPDFFormObj_GetObject(handle, n) for n in range(raw.FPDFFormObj_CountObjects(handle)))
            waiting.append((inside, to_page))
        elif kind == _PATH:
            points += raw.FPDFPath_CountSegments(handle)
            yield _path(handle, to_page)
        else:
            left_out[_WORDS.get(kind, "other objects")] += 1


def _path(handle: Any, to_page: Matrix) -> Path:
    from pypdfium2 import raw

    fill, stroke, width = ctypes.c_int(), ctypes.c_int(), ctypes.c_float()
    raw.FPDFPath_GetDrawMode(handle, fill, stroke)
    raw.FPDFPageObj_GetStrokeWidth(handle, width)
    count = max(raw.FPDFPageObj_GetDashCount(handle), 0)
    dashes = (ctypes.c_float * count)()
    if count:
        raw.FPDFPageObj_GetDashArray(handle, dashes, count)
    cap, join = raw.FPDFPageObj_GetLineCap(handle), raw.FPDFPageObj_GetLineJoin(handle)
    return Path(handle, to_page, bool(stroke.value), bool(fill.value), width.value, cap, join, tuple(dashes))


def _matrix(handle: Any) -> Matrix:
    from pypdfium2 import raw

    found = raw.FS_MATRIX()
    raw.FPDFPageObj_GetMatrix(handle, found)
    return found.a, found.b, found.c, found.d, found.e, found.f


def after(outer: Matrix, inner: Matrix) -> Matrix:
    """First inner, then outer."""
    a, b, c, d, e, f = outer
    p, q, r, s, t, u = inner
    return a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, a * t + c * u + e, b * t + d * u + f
