"""What a model is made of, and what is wrong with it: source -> tessellate -> scene, and a report."""

from __future__ import annotations

from typing import Any

from hlr.common.types import Progress
from hlr.drawing.model_info import ModelInfo, PartReport
from hlr.request.accuracy import ANGLE, SMALL_DRAWING
from hlr.request.check import check_crease
from hlr.scene.build import build
from hlr.source import open_source


def info(
    source: Any,
    *,
    crease: float = 30.0,
    progress: Progress | None = None,
    var: str | None = None,
    annotations: bool = False,
) -> ModelInfo:
    """Parts, faces, edges, triangles, closedness and defects of a source, meshed at a two-thousandth of its size.

    source       as of `hlr.draw`
    crease       degrees: where a mesh without B-rep folds more than this, an edge is counted
    progress     as of `hlr.draw`
    var          the variable of a script, instead of what it shows
    annotations  count the faces of annotation in STEP files as well

    Raises SourceError, OptionError.

    >>> import hlr
    >>> model = hlr.info("part.step")
    >>> part = model.parts[0]
    >>> part.name, part.solids, part.faces, part.edges, part.closed, part.defects
    ('part', 1, 7, 15, True, ())
    """
    check_crease(crease)
    tell = progress or (lambda _stage, _done: None)
    tell("source", 0.0)
    opened = open_source(source, var, annotations)
    bounds = opened.bounds()
    size = float(((bounds[1] - bounds[0]) ** 2).sum() ** 0.5)
    tell("tessellate", 0.0)
    deflection = size / SMALL_DRAWING
    scene = build(opened.mesh(deflection, ANGLE, progress), crease, deflection)
    solids = {i.name: i.solids for i in opened.infos()}
    parts = tuple(
        PartReport(
            name=p.name,
            color=p.color,
            solids=solids.get(p.name, 0),
            faces=p.faces,
            edges=p.edges,
            triangles=p.triangles,
            closed=p.closed,
            oriented=p.oriented,
            defects=p.defects,
        )
        for p in scene.parts
    )
    low, high = ((float(c[0]), float(c[1]), float(c[2])) for c in bounds)
    notes = (*opened.notes, *scene.notes)
    return ModelInfo(opened.name, opened.kind, opened.frame.unit, (low, high), parts, notes)
