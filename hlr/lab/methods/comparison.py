"""Times the visible-surface methods on scenes of given numbers of polygons, and on a model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hlr.common.types import Progress
from hlr.errors import OptionError
from hlr.image.camera import Camera
from hlr.lab.methods.polygons import Polygons, polygons_of
from hlr.lab.methods.report import model_name, scene_name
from hlr.lab.methods.table import METHODS
from hlr.lab.methods.testbed import COUNTS, polygons
from hlr.lab.methods.timing import TRIALS, Scenery, Timing, Trial, label, measure
from hlr.lab.methods.viewport import SCREEN, Screen, checked_size, viewport
from hlr.request.check import checked, checked_views
from hlr.request.defaults import METHODS_LIMIT_S, METHODS_SIZE
from hlr.request.options import Options, Parameter, View

MOST = 10_000_000
"""Polygons of a scene: more do not fit into memory."""


def compare_methods(  # noqa: PLR0913 - one for each thing a user may ask
    source: Any = None,
    *,
    counts: Sequence[int] | None = None,
    crossing: Sequence[int] = (),
    view: View = "iso",
    size: tuple[int, int] = METHODS_SIZE,
    limit: float = METHODS_LIMIT_S,
    methods: Sequence[str] = (),
    only: Sequence[str] = (),
    hide: Sequence[str] = (),
    var: str | None = None,
    parameters: Mapping[str, Parameter] | None = None,
    annotations: bool = False,
    hidden_objects: bool = False,
    progress: Progress | None = None,
) -> list[Timing]:
    """Time every method on every scene.

    source  a model to time as well, meshed with a deflection of a two-thousandth of its size; None: no model
    counts  numbers of polygons of the scenes; None: COUNTS without a source, and only the model with one
    crossing  numbers of polygons of the scenes in which polygons pass through one another
    limit   seconds of processor time for each method and scene
    methods names of the methods to time: "method", or "method, variant"; None: all

    only, hide, var, parameters, annotations, hidden_objects  which parts of the source, as of a drawing (`hlr.Options`)

    Raises OptionError, SourceError, ViewError.

    >>> import hlr
    >>> (timing,) = hlr.methods(counts=[10], size=(64, 64), methods=["z-buffer"])
    >>> timing.method, timing.count, timing.seconds > 0
    ('z-buffer', 10, True)
    """
    chosen = checked(
        Options(
            only=tuple(only),
            hide=tuple(hide),
            var=var,
            parameters=parameters,
            annotations=annotations,
            hidden_objects=hidden_objects,
        )
    )
    if source is None and (only or hide or var is not None or parameters or annotations or hidden_objects):
        raise OptionError(
            "only, hide, var, parameters, annotations and hidden_objects choose parts of a model: name one"
        )
    size = checked_size(size)
    if not limit > 0.0:
        raise OptionError(f"a limit of {limit!r} seconds leaves no time: give a positive number")
    if counts is None:
        counts = COUNTS if source is None else ()
    for count in (*counts, *crossing):
        if not 1 <= count <= MOST:
            raise OptionError(f"a scene of {count:,} polygons cannot be made: give 1 to {MOST:,}")
    trials = _trials(methods)
    sceneries: list[Scenery] = []
    if source is not None:
        sceneries.append(_of_model(source, view, size, chosen, progress))
    for count, crosses in [*((c, False) for c in counts), *((c, True) for c in crossing)]:
        sceneries.append(_scenery(scene_name(count, crosses), polygons(count, size, crosses), SCREEN, size))
    return measure(sceneries, limit, trials, progress)


def _trials(methods: Sequence[str]) -> Sequence[Trial]:
    if not methods:
        return TRIALS
    known = {label(t): t for t in (*((m, "") for m in METHODS), *((m, v) for m, vs in METHODS.items() for v in vs))}
    unknown = [m for m in methods if m not in known]
    if unknown:
        raise OptionError(f"no method is called {unknown[0]!r}: use {'; '.join(known)}")
    return [known[m] for m in dict.fromkeys(methods)]


def _scenery(name: str, own: Polygons, camera: Camera | Screen, size: tuple[int, int]) -> Scenery:
    return Scenery(name, len(own), own.kernel, viewport(camera, own.points, size))


def _of_model(source: Any, view: View, size: tuple[int, int], options: Options, progress: Progress | None) -> Scenery:

    from hlr.pipeline.session import Session

    view = checked_views([view], options)[0]
    session = Session(source, [view], options, progress)
    model = polygons_of(session.scene_by_size())
    return _scenery(model_name(session.source.name, len(model)), model, session.cameras[0], size)
