"""Records of jobs and of measured results, exchanged between the study and its processes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from hlr.request.options import Parameter, View

ACCURACIES = (2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005)
"""Millimetres on paper."""

PIXELS = (512, 1024, 2048, 4096, 8192)
"""Along the longer side of the depth buffer."""

PREDICATES = (0.5, 0.05, 0.005)
"""Accuracies at which the kinds of arithmetic are compared."""

HLR, POLY, EXACT, ZBUFFER = "hlr", "OCCT PolyAlgo", "OCCT exact", "z-buffer"
WHO = (HLR, POLY, EXACT, ZBUFFER)

STAGES = ("source", "tessellate", "scene", "plan", "visibility", "linework", "write")
"""Of every contestant, where it has them: read, triangulate, prepare, decide, hide, gather the lines, write an SVG."""

TIMED = STAGES[1:-1]
"""The stages that count as a contestant's time: from the shape in memory to the lines in memory."""


@dataclass(frozen=True, slots=True)
class Job:
    """One measurement.

    work      one of `WHO`, or "look" (size and scale), "truth" (the lines with which all are compared), "judge",
              "arithmetic", "reached"
    source    path of the model
    view      a name, or a direction from the object toward the viewer
    setting   accuracy in millimetres, or pixels of the depth buffer
    scale     paper : model; None: as large as fits into `fit`
    fit       (width, height) millimetres
    folder    where lines are kept for the judge; name: their file name
    runs      how often a contestant draws; fewer if that would take too long
    limit     seconds of processor time for all runs together
    only, hide, var, parameters, annotations, hidden_objects   which parts, as for a drawing (`hlr.Options`)
    """

    work: str
    source: str
    view: View = "iso"
    setting: float = 0.0
    scale: float | None = None
    fit: tuple[float, float] | None = None
    folder: str = ""
    name: str = ""
    runs: int = 1
    limit: float = 60.0
    only: Sequence[str] = ()
    hide: Sequence[str] = ()
    var: str | None = None
    parameters: Mapping[str, Parameter] | None = None
    annotations: bool = False
    hidden_objects: bool = False

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


@dataclass(slots=True)
class Cost:
    """The cost of one stage.

    wall    seconds by the clock
    cpu     seconds of all processors together
    memory  at its peak, MB
    """

    wall: float = 0.0
    cpu: float = 0.0
    memory: float = 0.0


@dataclass(slots=True)
class Point:
    """One contestant at one setting.

    who       the contestant, one of `WHO`
    setting   accuracy in millimetres on paper, or pixels of the depth buffer
    runs      how often it was measured
    counts    lines, triangles and the like, by name
    accuracy  millimetres on paper that were asked for; for a depth buffer the size of a pixel; None: it has no setting
    failure   one sentence on why there are no figures; None: there are figures
    stages    cost of each stage by name, medians over `runs`
    errors    the judge's errors by name; millimetres on paper, shares as fractions
    reached   the errors that `hlr.lab.measure` found; only for drawings of hlr
    """

    who: str
    setting: float
    accuracy: float | None = None
    failure: str | None = None
    runs: int = 0
    stages: dict[str, Cost] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    errors: dict[str, float] = field(default_factory=dict)
    reached: dict[str, Any] = field(default_factory=dict)

    @property
    def seconds(self) -> float:
        """Clock seconds from the shape in memory to the lines in memory."""
        return sum(self.stages[s].wall for s in TIMED if s in self.stages)

    @property
    def processor(self) -> float:
        """The same in seconds of all processors together, which other programs on the machine hardly affect."""
        return sum(self.stages[s].cpu for s in TIMED if s in self.stages)

    @property
    def memory(self) -> float:
        """Peak memory in MB after reading."""
        return max((self.stages[s].memory for s in TIMED if s in self.stages), default=0.0)

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def point_of(data: dict[str, Any]) -> Point:
    """The record that `as_dict` gave."""
    return Point(**{**data, "stages": {name: Cost(**cost) for name, cost in data["stages"].items()}})


def label(who: str, setting: float) -> str:
    """The name of a contestant at a setting, for people."""
    if who == EXACT:
        return who
    return f"{who} at {setting:.0f} pixels" if who == ZBUFFER else f"{who} at {setting:g} mm"
