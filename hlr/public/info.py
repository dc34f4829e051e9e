"""`hlr.info`: what a model is made of, and its defects. The model is meshed, and nothing is drawn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hlr.common.types import Progress
from hlr.drawing.model_info import ModelInfo, PartReport
from hlr.pipeline.session import Session
from hlr.request.check import checked
from hlr.request.defaults import CREASE
from hlr.request.options import Options, Parameter


def info(
    source: Any,
    *,
    crease: float = CREASE,
    progress: Progress | None = None,
    var: str | None = None,
    parameters: Mapping[str, Parameter] | None = None,
    annotations: bool = False,
    hidden_objects: bool = False,
) -> ModelInfo:
    """Parts, faces, edges, triangles, closedness and defects of a source, meshed at a two-thousandth of its size.

    source       as of `hlr.draw`
    crease       degrees: where a mesh without B-rep folds more than this, an edge is counted
    progress     as of `hlr.draw`
    var          the variable of a script, instead of what it shows
    parameters   values for variables of a script, as of `hlr.Options`
    annotations  count the faces of annotation in STEP files as well
    hidden_objects  count the objects that a FreeCAD document hides as well

    Raises SourceError, OptionError.

    >>> import hlr
    >>> model = hlr.info("part.step")
    >>> part = model.parts[0]
    >>> part.name, part.solids, part.faces, part.edges, part.closed, part.defects
    ('part', 1, 7, 15, True, ())
    """
    options = Options(
        crease=crease, var=var, parameters=parameters, annotations=annotations, hidden_objects=hidden_objects
    )
    session = Session(source, [], checked(options), progress)
    source, scene = session.source, session.scene_by_size()
    solids = {i.name: i.solids for i in source.infos()}
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
    low, high = ((float(c[0]), float(c[1]), float(c[2])) for c in session.bounds)
    notes = (*source.notes, *scene.notes)
    return ModelInfo(source.name, source.kind, source.frame.unit, (low, high), parts, notes)
