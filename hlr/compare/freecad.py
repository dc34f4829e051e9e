"""The other side of `hlr compare --against freecad`: an installed FreeCAD draws the model, in a process of its own.

It runs without its user interface, with preferences of its own that nobody has changed, in a temporary folder, and is
ended with all that it started when its time is over.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from hlr.common.keywords import record_of, shown
from hlr.compare.compare import compare
from hlr.compare.comparison import Comparison
from hlr.compare.reading.choice import Choice
from hlr.errors import OptionError, SourceError
from hlr.pipeline.draw import draw_views
from hlr.request.defaults import COMPARE_TOLERANCE_MM
from hlr.request.directions import axes, directed
from hlr.request.options import Chosen, View
from hlr.source import open_source
from hlr.source.model import is_source
from hlr.source.selection import open_selected

if TYPE_CHECKING:
    from hlr.common.types import Progress

TIME_LIMIT_S = 120.0

_LONGEST_S = 1e6

VARIABLE = "HLR_FREECAD"
"""Of the environment: the command to run, where it is not on the path."""

_COMMANDS = ("freecadcmd", "FreeCADCmd", "freecad.cmd")

_READ = (".step", ".stp", ".iges", ".igs", ".brep", ".brp")
"""Endings of files that FreeCAD reads itself; any other model goes over as BREP."""

_TEMPLATE = '<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210"/>'

_SCRIPT = """
import json, os, signal, time
import FreeCAD, Part, TechDraw

with open(os.environ["HLR_JOB"]) as file:
    job = json.load(file)
if hasattr(signal, "alarm"):
    signal.alarm(job["seconds"])  # should hlr be killed, nobody else ends this process
shape = Part.Shape()
shape.read(job["model"])
document = FreeCAD.newDocument("compared")
model = document.addObject("Part::Feature", "Model")
model.Shape = shape
page = document.addObject("TechDraw::DrawPage", "Page")
template = document.addObject("TechDraw::DrawSVGTemplate", "Template")
template.Template = job["template"]
page.Template = template
view = document.addObject("TechDraw::DrawViewPart", "View")
view.Source = [model]
view.Direction = tuple(job["direction"])
view.XDirection = tuple(job["right"])
view.ScaleType = "Custom"
view.Scale = job["scale"]
view.HardHidden = True
view.CoarseView = job["coarse"]
page.addView(view)
started = time.time()
document.recompute()
# From 0.21 on hidden lines are removed in another thread. It tells its result through Qt's queue of events, which
# somebody has to work through: without a window FreeCAD has none.
if FreeCAD.Version()[:2] != ["0", "20"]:
    from PySide import QtCore
    events = QtCore.QCoreApplication.instance() or QtCore.QCoreApplication([])
    while not view.getVisibleEdges() and time.time() - started < job["seconds"]:
        events.processEvents()
        time.sleep(0.02)
seconds = time.time() - started
lines = len(view.getVisibleEdges()) + len(view.getHiddenEdges())
answer = {
    "svg": TechDraw.viewPartAsSvg(view) if lines else "",
    "seconds": seconds,
    "version": ".".join(FreeCAD.Version()[:2]),
}
with open(job["answer"], "w") as file:
    json.dump(answer, file)
"""
"""What FreeCAD runs."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """What FreeCAD drew. svg: the fragment of the view; seconds: of its recompute; version: of FreeCAD."""

    svg: str
    seconds: float
    version: str


@shown(Choice)
def compare_with_freecad(
    model: Any,
    view: View = "iso",
    *,
    scale: float | None = None,
    coarse: bool = False,
    tolerance_mm: float = COMPARE_TOLERANCE_MM,
    time_limit_s: float = TIME_LIMIT_S,
    progress: Progress | None = None,
    **choice: Unpack[Chosen],
) -> Comparison:
    """What differs between FreeCAD's drawing of a model, which is the first, and the one of hlr.

    model         as of `hlr.draw`; it needs surfaces: FreeCAD draws no meshes
    view          as of `hlr.draw`
    scale         paper to model, of both; None: the one at which `hlr.draw` puts the view on a page
    coarse        by FreeCAD's coarse view, which is faster
    tolerance_mm  as of `compare`
    time_limit_s  seconds that FreeCAD may take
    progress      called with the name of each stage and the fraction done, 0 to 1
    choice        only, hide, var, parameters, annotations, hidden_objects: as of `hlr.draw`

    Raises OptionError where no FreeCAD is installed, SourceError where it does not draw the model.

    >>> from hlr.compare.freecad import compare_with_freecad
    >>> compare_with_freecad("part.step", "front").summary  # doctest: +SKIP
    'same: 140 mm of lines'
    """
    _command()
    chosen = record_of(Choice, choice, "compare_with_freecad")
    options = chosen.options()
    if progress is not None:
        progress("source", 0.0)
    source = open_selected(model, chosen)
    if scale is None:
        scale = draw_views(source, [view], options, progress)[0].scale
    if progress is not None:
        progress("FreeCAD", 0.0)
    theirs = model if _is_read(model) and not (chosen.only or chosen.hide) else source
    drawn = drawn_by_freecad(theirs, view, scale=scale, coarse=coarse, time_limit_s=time_limit_s)
    with tempfile.TemporaryDirectory(prefix="hlr-") as folder:
        path = Path(folder) / f"FreeCAD {drawn.version}{', coarse' if coarse else ''}.svg"
        path.write_text(drawn.svg)
        return compare(path, source, tolerance_mm=tolerance_mm, view=view, scale=scale, progress=progress)


def drawn_by_freecad(
    model: Any, view: View, *, scale: float = 1.0, coarse: bool = False, time_limit_s: float = TIME_LIMIT_S
) -> Drawn:
    """Have an installed FreeCAD draw one view of a model; arguments and errors as of `compare_with_freecad`."""
    command = _command()
    if not math.isfinite(time_limit_s) or time_limit_s <= 0.0:
        raise OptionError(f"the time limit is {time_limit_s!r}: give a positive number of seconds")
    _, direction, up = directed(view)
    right, _ = axes(direction, up)
    name = _name(model)
    with tempfile.TemporaryDirectory(prefix="hlr-") as made:
        folder = Path(made)
        job = {
            "model": str(_file_for_freecad(model, name, folder)),
            "template": str(folder / "template.svg"),
            "answer": str(folder / "answer.json"),
            "direction": direction,
            "right": right,
            "scale": scale,
            "coarse": coarse,
            "seconds": math.ceil(min(time_limit_s, _LONGEST_S)) + 1,
        }
        (folder / "template.svg").write_text(_TEMPLATE)
        (folder / "job.json").write_text(json.dumps(job))
        (folder / "draw.py").write_text(_SCRIPT)
        _run([command, str(folder / "draw.py")], folder, name, time_limit_s)
        try:
            answer = json.loads((folder / "answer.json").read_text())
        except (OSError, ValueError):
            raise SourceError(f"FreeCAD ended without a drawing of {name}: it cannot read or draw the model") from None
    if not answer["svg"]:
        raise SourceError(f"FreeCAD drew no line of {name}: the view is empty there")
    return Drawn(answer["svg"], float(answer["seconds"]), str(answer["version"]))


def _command() -> str:
    """The command that runs FreeCAD. Raises OptionError where there is none."""
    said = os.environ.get(VARIABLE)
    found = shutil.which(said) if said else next(filter(None, map(shutil.which, _COMMANDS)), None)
    if found is None:
        where = f"{VARIABLE} names {said}, which cannot be run" if said else f"no {_COMMANDS[0]} is on the path"
        raise OptionError(f"FreeCAD is not installed: {where}; install it, or name its command in {VARIABLE}")
    return found


def _is_read(model: Any) -> bool:
    """Whether FreeCAD reads the model itself."""
    return isinstance(model, str | os.PathLike) and Path(model).suffix.lower() in _READ


def _name(model: Any) -> str:
    if isinstance(model, str | os.PathLike):
        return Path(model).name
    return str(model.name) if is_source(model) else "the model"


def _file_for_freecad(model: Any, name: str, folder: Path) -> Path:
    """A file of the model that FreeCAD reads. Raises SourceError for a mesh."""
    if _is_read(model):
        from hlr.source.file_checks import check_readable

        check_readable(Path(model))
        return Path(model).resolve()
    source: Any = open_source(model)
    if not hasattr(source, "shape"):
        raise SourceError(f"{name} is a mesh, of which FreeCAD draws no lines: give a model with surfaces")
    from OCP.BRepTools import BRepTools

    path = folder / "model.brep"
    BRepTools.Write_s(source.shape(), str(path))
    return path


def _run(command: list[str], folder: Path, name: str, time_limit_s: float) -> None:
    """Run FreeCAD in a process group of its own. Raises SourceError where it crashes or takes too long."""
    # FreeCAD brings a Python of its own, which an environment of this one would mislead.
    inherited = {name: value for name, value in os.environ.items() if not name.startswith(("VIRTUAL_ENV", "PYTHON"))}
    own = {"HLR_JOB": str(folder / "job.json"), "FREECAD_USER_HOME": str(folder), "QT_QPA_PLATFORM": "offscreen"}
    with _started(command, {**inherited, **own}, folder) as process:
        try:
            code = process.wait(time_limit_s)
        except subprocess.TimeoutExpired:
            raise SourceError(
                f"FreeCAD did not draw {name} in {time_limit_s:g} s: give it more time, or take its coarse view"
            ) from None
    if code < 0:
        raise SourceError(f"FreeCAD crashed while it drew {name} (signal {-code})")


@contextlib.contextmanager
def _started(command: list[str], environment: dict[str, str], folder: Path) -> Iterator[subprocess.Popen[bytes]]:
    """A process in a group of its own, all of which is ended at the end."""
    try:
        process = subprocess.Popen(
            command,
            env=environment,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
    except OSError as error:
        raise OptionError(f"FreeCAD cannot be run: {command[0]}: {error.strerror}") from None
    try:
        yield process
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
