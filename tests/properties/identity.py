"""Exact comparison of drawings: as bytes, and line by line."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hlr import Drawing, Line
from hlr.drawing.saving import render
from hlr.tables.line_classes import EdgeClass

FORMATS = ("json", "svg", "pdf")


def as_bytes(drawing: Drawing, kind: str = "json") -> bytes:
    """The file, without the times that differ from run to run."""
    if kind != "json":
        return render(drawing, kind)
    document = json.loads(render(drawing, kind))
    del document["timings"]
    return json.dumps(document).encode()


def everything(drawing: Drawing) -> bytes:
    """All formats, one after another: they differ in what they round and how they order lines."""
    return b"\n".join(as_bytes(drawing, kind) for kind in FORMATS)


def renumbered(drawing: Drawing, order: Sequence[int], faces: Sequence[np.ndarray] | None = None) -> Drawing:
    """The drawing with its parts numbered as before they were reordered: order[i] is the old number of the new part i.

    faces: per new part the old number of each of its faces, where those were renumbered too. Notes are left out: they
    name the first few parts that have defects.
    """

    def old(line: Line) -> Line:
        face = line.face if line.face is None or faces is None else int(faces[line.part][line.face])
        return replace(line, part=order[line.part], face=face)

    def key(line: Line) -> tuple[int, ...]:
        kind = EdgeClass[line.kind.upper()]
        return line.part, kind, *(-1 if i is None else i for i in (line.edge, line.face))

    parts = {old: part for old, part in zip(order, drawing.parts, strict=True)}
    lines = sorted(map(old, drawing.lines), key=key)  # stable: within a part the order of lines stays
    return replace(drawing, parts=tuple(parts[i] for i in range(len(parts))), lines=tuple(lines), notes=())


def without(drawing: Drawing, kind: str) -> Drawing:
    """The drawing without its lines of a class."""
    return replace(drawing, lines=tuple(line for line in drawing.lines if line.kind != kind))


def ownerless(drawing: Drawing) -> Counter[tuple[str, bool, bytes, bytes]]:
    """Every line as it lies on paper and in the model, and how often, whatever part it belongs to."""
    return Counter((line.kind, line.visible, line.points.tobytes(), line.points3.tobytes()) for line in drawing.lines)


def identities(drawing: Drawing) -> list[tuple[str, bool, int, int | None, int | None, int]]:
    """Class, visibility, part, edge, face and number of points of every line, in order."""
    return [(x.kind, x.visible, x.part, x.edge, x.face, len(x.points)) for x in drawing.lines]
