"""Measures all classes of error of one drawing."""

from __future__ import annotations

from time import perf_counter
from typing import Any

from hlr.drawing.drawing import Drawing
from hlr.drawing.reached import Errors, Reached, errors
from hlr.errors import OptionError
from hlr.lab.measure.edges import TrueEdges, edge_errors
from hlr.lab.measure.figures import shortest
from hlr.lab.measure.finer import Comparison, drawn_again, on_the_same_paper
from hlr.lab.measure.intersections import intersection_errors
from hlr.lab.measure.meshes import mesh_errors
from hlr.lab.measure.outlines import outline_errors
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.rays import Caster, labels
from hlr.lab.measure.written import written
from hlr.request.accuracy import MEASURED_FINENESS, under
from hlr.source import open_source

SAMPLES = 20_000
"""Default number of points judged by rays, and of outline points."""


def measured(
    source: Any,
    drawing: Drawing,
    *,
    samples: int = SAMPLES,
    finer: Drawing | None = None,
) -> Reached:
    """Measure how far a drawing is from the truth.

    source: what it was drawn from: a path, an object, or a source that is already open, which saves time.
    samples: how many points are judged by rays, and how many points of outlines are moved onto their surfaces.
    finer: a drawing of the same request at a finer accuracy; None: it is drawn here (`MEASURED_FINENESS`).

    Raises OptionError if the drawing does not hold its request, SourceError if the source cannot be read.
    """
    return ModelJudge(source, samples=samples, finer=finer).judge(drawing)


class ModelJudge:
    """Compares drawings of one model with the model itself; arguments as in `measured`."""

    def __init__(self, source: Any, *, samples: int = SAMPLES, finer: Drawing | None = None) -> None:
        self._source, self._samples, self._finer = source, samples, finer

    def judge(self, drawn: Drawing) -> Reached:
        """All classes of error of one drawing. Raises as `measured` does."""
        return _judged(self._source, drawn, self._samples, self._finer)


def _judged(source: Any, drawing: Drawing, samples: int, finer: Drawing | None) -> Reached:
    if drawing.request is None:
        raise OptionError("this drawing does not know what it was asked for: measure one that hlr.draw has made")
    started = perf_counter()
    asked = drawing.request.options
    opened = open_source(source, annotations=asked.annotations, hidden_objects=asked.hidden_objects)
    paper = Paper.of(drawing)
    forms = (written(drawing), written(drawing, cubic=True))
    meshes = Errors(None, why="the model is no mesh")
    edges = Errors(None, why="a mesh has no edges but its own")
    outlines = Errors(None, why="a mesh has no true surface")
    if hasattr(opened, "edge_shape"):
        wanted = sorted({(x.part, x.edge) for x in drawing.lines if x.edge is not None})
        edges = errors(*edge_errors(TrueEdges(opened, drawing, wanted, paper), drawing, forms))
        outlines = errors(*outline_errors(opened, drawing, forms[0], paper, samples))
    else:
        meshes = errors(*mesh_errors(opened, drawing, forms[0], paper))
    found = drawn_again(opened, drawing, MEASURED_FINENESS) if finer is None else finer
    deflection = drawing.accuracy.deflection / MEASURED_FINENESS
    if not isinstance(found, str):
        deflection = min(deflection, found.accuracy.deflection)
    caster = Caster.of(opened, drawing, paper, deflection)
    if isinstance(found, str):
        changes = grazing = lost = Errors(None, why=found)
        bound = None
    else:
        beside = Comparison(drawing, forms[0], on_the_same_paper(found, drawing))
        changes, grazing, bound = beside.changes(caster)
        # What the pen is too wide for is left out on purpose.
        whole = (
            drawn_again(opened, drawing, details=True) if drawing.counters.get("left_out") else "nothing is left out"
        )
        lost = beside.lost(
            under(drawing.accuracy.used), None if isinstance(whole, str) else on_the_same_paper(whole, drawing)
        )
    return Reached(
        accuracy=drawing.accuracy.used,
        edges=edges,
        outlines=outlines,
        meshes=meshes,
        intersections=intersection_errors(drawing, forms[0], caster, paper),
        changes=changes,
        grazing=grazing,
        bound=bound,
        lost=lost,
        short=shortest(drawing, forms[0]),
        labels=labels(drawing, forms[0], caster, samples),
        seconds=perf_counter() - started,
    )
